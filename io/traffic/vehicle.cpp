#include "io/traffic/vehicle.h"

#include <algorithm>
#include <cmath>
#include <utility>

#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/shown.h"
#include "solver/base/suggestion.h"

namespace voussoir {

namespace {

/// Begin and end of the vehicle, in m.
std::pair<double, double> extent_along(const Vehicle& vehicle) {
  if (!vehicle.axles.empty()) return {vehicle.axles.front().x, vehicle.axles.back().x};
  std::vector<double> ends;
  for (const LoadStrip& strip : vehicle.strips)
    for (const double end : {strip.from, strip.to})
      if (std::isfinite(end)) ends.push_back(end);
  if (ends.empty()) return {0.0, 0.0};
  const auto [first, last] = std::minmax_element(ends.begin(), ends.end());
  return {*first, *last};
}

/// A formula of EN 1991-2 6.4.5: a / (sqrt(L) - 0.2) + b, between 1 and `most`.
double of_length(double a, double b, double most, double length) {
  const double root = std::sqrt(length) - 0.2;
  return root <= 0.0 ? most : std::clamp(a / root + b, 1.0, most);
}

void multiply_axle(Vehicle& vehicle, std::size_t axle, double factor) {
  vehicle.axles[axle].load *= factor;
  for (LoadPatch& patch : vehicle.patches)
    if (patch.axle == axle) patch.force *= factor;
}

/// The member of a list with that name; `what` it is, for the message.
template <class Named>
const Named& named(const Vehicle& vehicle, const std::vector<Named>& list, const std::string& name, const char* what) {
  std::vector<std::string> names;
  for (const Named& one : list) {
    if (one.name == name) return one;
    names.push_back(one.name);
  }
  if (names.empty())
    throw InputError("vehicle '{}' has no {}, but you asked for '{}'", vehicle.name, what, shown(name));
  throw InputError("vehicle '{}' has no {} '{}'{}", vehicle.name, what, shown(name), suggestion(name, names));
}

}  // namespace

const std::vector<std::string>& vehicle_kinds() {
  static const std::vector<std::string> words = {"road", "rail"};
  return words;
}

const std::vector<std::string>& factor_formulas() {
  static const std::vector<std::string> words = {"EN 1991-2 carefully maintained", "EN 1991-2 standard"};
  return words;
}

double axle_weight(const Vehicle& vehicle) {
  double sum = 0.0;
  for (const VehicleAxle& axle : vehicle.axles) sum += axle.load;
  return sum;
}

double vehicle_length(const Vehicle& vehicle) {
  const auto [first, last] = extent_along(vehicle);
  return last - first;
}

double vehicle_width(const Vehicle& vehicle) {
  double left = -std::numeric_limits<double>::infinity(), right = -left;
  const auto add = [&](double y, double width) {
    left = std::max(left, y + 0.5 * width);
    right = std::min(right, y - 0.5 * width);
  };
  for (const LoadPatch& patch : vehicle.patches) add(patch.y, patch.width);
  if (vehicle.patches.empty())
    for (const LoadStrip& strip : vehicle.strips) add(strip.y, strip.width);
  return std::max(0.0, left - right);
}

Vehicle turned(const Vehicle& vehicle) {
  const auto [first, last] = extent_along(vehicle);
  const double sum = first + last;
  Vehicle other = vehicle;
  for (VehicleAxle& axle : other.axles) axle.x = sum - axle.x;
  for (LoadPatch& patch : other.patches) {
    patch.x = sum - patch.x;
    patch.axle = vehicle.axles.size() - 1 - patch.axle;
  }
  for (LoadStrip& strip : other.strips) strip.from = sum - std::exchange(strip.to, sum - strip.from);
  std::reverse(other.axles.begin(), other.axles.end());
  std::reverse(other.patches.begin(), other.patches.end());
  std::reverse(other.strips.begin(), other.strips.end());
  for (VehicleVariant& variant : other.variants) std::reverse(variant.shares.begin(), variant.shares.end());
  return other;
}

double dynamic_factor(const DynamicFactor& factor, double span, double cover) {
  using Formula = DynamicFactor::Formula;
  if (factor.formula == Formula::value) return factor.value;
  if (!(span > 0.0 && std::isfinite(span)))
    throw InputError("dynamic factor '{}': the span is {} m. It must be above 0.", factor.name, span);
  if (!(cover >= 0.0 && std::isfinite(cover)))
    throw InputError("dynamic factor '{}': the cover is {} m. It must be 0 or more.", factor.name, cover);
  const double length = factor.determinant * span;
  // EN 1991-2 6.4.5.2, (6.4) and (6.5), as public programs have them: the first with its limits; those of the second,
  // 1.00 and 2.00, are not checked.
  const double phi = factor.formula == Formula::carefully_maintained ? of_length(1.44, 0.82, 1.67, length)
                                                                     : of_length(2.16, 0.73, 2.00, length);
  // EN 1991-2 6.4.5.4: smaller if the cover is more than 1.00 m. The formula was not checked against the source; ENV
  // 1991-3 6.4.3.4 states that it reduces the factor of arch bridges from 1.00 m of cover on.
  constexpr double least_cover = 1.0, per_metre = 10.0;
  return std::max(1.0, phi - std::max(0.0, cover - least_cover) / per_metre);
}

const DynamicFactor& factor_named(const Vehicle& vehicle, const std::string& name) {
  return named(vehicle, vehicle.factors, name, "dynamic factor");
}

Vehicle amplified(const Vehicle& vehicle, double factor) {
  Vehicle other = vehicle;
  for (VehicleAxle& axle : other.axles) axle.load *= factor;
  for (LoadPatch& patch : other.patches) patch.force *= factor;
  for (LoadStrip& strip : other.strips) strip.pressure *= factor;
  return other;
}

Vehicle amplified(const Vehicle& vehicle, double factor, std::size_t axle) {
  if (axle >= vehicle.axles.size())
    throw InputError("vehicle '{}' has {}; there is no axle {} (axles count from 0)", vehicle.name,
                     counted(vehicle.axles.size(), "axle"), axle);
  Vehicle other = vehicle;
  multiply_axle(other, axle, factor);
  return other;
}

Vehicle variant_named(const Vehicle& vehicle, const std::string& name) {
  const VehicleVariant& variant = named(vehicle, vehicle.variants, name, "variant");
  Vehicle other = vehicle;
  for (std::size_t axle = 0; axle < other.axles.size(); ++axle) multiply_axle(other, axle, variant.shares[axle]);
  other.title += ", " + variant.name;
  other.variants.clear();
  return other;
}

}  // namespace voussoir
