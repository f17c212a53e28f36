#include "geometry/nearest_block.h"
#include "io/measured/parts.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

/// m. Models leave out mouldings and have errors of some centimetres, so this is more than for the sensors of a case.
constexpr double reach = 0.5;

std::string vector_text(const Vec3& v) {
  return fmt::format("({:.4g}, {:.4g}, {:.4g})", v.x(), v.y(), v.z());
}

[[noreturn]] void too_far(const MeasuredSensor& sensor, const std::string& file, const Assembly& assembly,
                          const NearestBlock& nearest) {
  const std::string place =
      fmt::format("{}:{}: sensor '{}' at {} m", file, sensor.row, shown(sensor.id), vector_text(sensor.position));
  if (nearest.block < 0) throw InputError("{}: there is no block to which it could belong. Give a bridge.", place);
  const Box box = block_box(assembly.blocks[std::size_t(nearest.block)]);
  throw InputError(
      "{} is {:.3g} m away from the nearest block, {}, which reaches from {} to {} m. It must be within {} m of a "
      "block. Correct its place, or move the origin of the measurements to that of the model.",
      place, nearest.distance, block_label(assembly, nearest.block), vector_text(box.low), vector_text(box.high),
      reach);
}

}  // namespace

std::vector<std::int64_t> place_sensors(const std::vector<MeasuredSensor>& sensors, const std::string& file,
                                        const Assembly& assembly) {
  std::vector<std::int64_t> blocks;
  for (const MeasuredSensor& sensor : sensors) {
    const NearestBlock nearest = nearest_block(assembly, sensor.position);
    if (nearest.distance > reach) too_far(sensor, file, assembly, nearest);
    blocks.push_back(nearest.block);
  }
  return blocks;
}

std::vector<std::int64_t> place_sensors(const Measured& measured, const Assembly& assembly) {
  return place_sensors(measured.sensors, path_in(measured.directory, "sensors.csv"), assembly);
}

}  // namespace voussoir
