// Vehicles that cross a bridge: lorries, trains and load models as plain data.
#pragma once
#include <limits>
#include <string>
#include <vector>

namespace voussoir {

/// The frame of a vehicle: x backwards from its front, y to the left from its middle, both in m. Loads act downwards.
struct VehicleAxle {
  double x = 0.0;     // m
  double load = 0.0;  // N, of the whole axle
};

/// The load area of a wheel, or of a sleeper under an axle: a rectangle with a uniform pressure.
struct LoadPatch {
  double x = 0.0, y = 0.0;           // m, its middle
  double length = 0.0, width = 0.0;  // m, along and across
  double force = 0.0;                // N
  std::size_t axle = 0;              // index into Vehicle::axles
};

/// A uniform load over a strip. An infinite end: the strip has no end.
struct LoadStrip {
  double from = -std::numeric_limits<double>::infinity(), to = std::numeric_limits<double>::infinity();  // m
  double y = 0.0, width = 0.0;                                                                           // m
  double pressure = 0.0;                                                                                 // N/m2
};

/// A dynamic factor that may be chosen. The loads do not include it.
struct DynamicFactor {
  enum class Formula { value, carefully_maintained, standard };
  std::string name, clause;
  Formula formula = Formula::value;
  double value = 1.0;               // of Formula::value
  double determinant = 0.5;         // determinant length as a share of the span, of the other formulas
  bool critical_axle_only = false;  // it acts only on the most unfavourable axle
};

/// The same vehicle with other shares of its axle loads, for instance if axles lift off.
struct VehicleVariant {
  std::string name, clause;
  std::vector<double> shares;  // one for each axle
};

struct Vehicle {
  enum class Kind { road, rail };
  std::string name;  // of the file, without folder and ending
  std::string title, source;
  std::vector<std::string> not_checked;  // figures that were not checked against the source
  Kind kind = Kind::road;
  std::vector<VehicleAxle> axles;  // from the front backwards
  std::vector<LoadPatch> patches;  // of the axles
  std::vector<LoadStrip> strips;
  std::vector<DynamicFactor> factors;
  std::vector<VehicleVariant> variants;
};

/// "road" and "rail", in the order of Vehicle::Kind.
const std::vector<std::string>& vehicle_kinds();
/// Words of DynamicFactor::Formula, without the first.
const std::vector<std::string>& factor_formulas();

/// Weight of the axles, N, without uniform loads.
double axle_weight(const Vehicle& vehicle);
/// Length from the first axle to the last, m; without axles between the outermost finite ends of the strips.
double vehicle_length(const Vehicle& vehicle);
/// Width over wheels or sleepers, m; without axles over the strips.
double vehicle_width(const Vehicle& vehicle);

/// The vehicle in the opposite direction: mirrored along its length between the same first and last axle. Distances
/// across (y) do not change.
Vehicle turned(const Vehicle& vehicle);

/// The factor for a clear span and a cover over the crown, both in m. `cover` is measured to the top of the sleepers.
/// Throws InputError for a span that is not above 0 and for a negative cover, if the factor is a formula.
double dynamic_factor(const DynamicFactor& factor, double span, double cover);
/// The factor of that name. Throws InputError with a suggestion if the vehicle does not have it.
const DynamicFactor& factor_named(const Vehicle& vehicle, const std::string& name);
/// The vehicle with all loads multiplied.
Vehicle amplified(const Vehicle& vehicle, double factor);
/// The vehicle with the load of one axle (from 0) multiplied. Throws InputError if there is no such axle.
Vehicle amplified(const Vehicle& vehicle, double factor, std::size_t axle);

/// The vehicle with the axle loads of the variant of that name. The result itself has no variants. Throws InputError
/// with a suggestion if there is none.
Vehicle variant_named(const Vehicle& vehicle, const std::string& name);

/// Reads the text of the file of a vehicle. Throws InputError "FILE:LINE: …".
Vehicle parse_vehicle(const std::string& text, const std::string& file);
/// Names of the vehicles that come with the program, sorted.
std::vector<std::string> shipped_vehicles();
/// A vehicle of the program by its name, or a vehicle of the user by the path of its file (with a folder or the ending
/// .toml). Throws InputError with a suggestion if there is none.
Vehicle read_vehicle(const std::string& name_or_path);

}  // namespace voussoir
