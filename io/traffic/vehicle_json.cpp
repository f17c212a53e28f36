#include "io/traffic/vehicle_json.h"

#include <cmath>

namespace voussoir {

namespace {

using nlohmann::json;

json finite_or_null(double value) {
  return std::isfinite(value) ? json(value) : json();
}

json factor_json(const DynamicFactor& factor) {
  json object = {
      {"name", factor.name}, {"clause", factor.clause}, {"axles", factor.critical_axle_only ? "critical" : "all"}};
  if (factor.formula == DynamicFactor::Formula::value) {
    object["value"] = factor.value;
  } else {
    object["formula"] = factor_formulas()[std::size_t(factor.formula) - 1];
    object["determinant"] = factor.determinant;
  }
  return object;
}

}  // namespace

json vehicle_json(const Vehicle& vehicle) {
  json axles = json::array(), patches = json::array(), strips = json::array(), factors = json::array(),
       variants = json::array();
  for (const VehicleAxle& axle : vehicle.axles) axles.push_back({{"x", axle.x}, {"load", axle.load}});
  for (const LoadPatch& p : vehicle.patches)
    patches.push_back(
        {{"x", p.x}, {"y", p.y}, {"length", p.length}, {"width", p.width}, {"force", p.force}, {"axle", p.axle}});
  for (const LoadStrip& s : vehicle.strips)
    strips.push_back({{"from", finite_or_null(s.from)},
                      {"to", finite_or_null(s.to)},
                      {"y", s.y},
                      {"width", s.width},
                      {"pressure", s.pressure}});
  for (const DynamicFactor& factor : vehicle.factors) factors.push_back(factor_json(factor));
  for (const VehicleVariant& variant : vehicle.variants)
    variants.push_back({{"name", variant.name}, {"clause", variant.clause}, {"shares", variant.shares}});
  return {{"name", vehicle.name},
          {"title", vehicle.title},
          {"source", vehicle.source},
          {"not_checked", vehicle.not_checked},
          {"kind", vehicle_kinds()[std::size_t(vehicle.kind)]},
          {"axle_weight", axle_weight(vehicle)},
          {"length", vehicle_length(vehicle)},
          {"width", vehicle_width(vehicle)},
          {"axles", axles},
          {"patches", patches},
          {"strips", strips},
          {"factors", factors},
          {"variants", variants}};
}

}  // namespace voussoir
