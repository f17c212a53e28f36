#include "io/traffic/vehicle.h"
#include "tools/fuzz/answer.h"
#include "tools/fuzz/readers.h"

namespace voussoir::fuzz {

void read_vehicle(const std::string& bytes) {
  answer([&] {
    const Vehicle vehicle = parse_vehicle(bytes, "vehicle.toml");
    const Vehicle back = turned(vehicle);
    for (const LoadPatch& patch : back.patches)
      if (patch.axle >= back.axles.size()) std::abort();
    for (const DynamicFactor& factor : vehicle.factors)
      if (!(dynamic_factor(factor, 10.0, 1.0) > 0.0)) std::abort();
    for (const VehicleVariant& variant : vehicle.variants) variant_named(vehicle, variant.name);
  });
}

}  // namespace voussoir::fuzz
