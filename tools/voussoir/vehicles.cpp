// voussoir vehicles.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cmath>

#include "io/traffic/vehicle.h"
#include "io/traffic/vehicle_json.h"
#include "solver/base/constants.h"
#include "solver/base/json_file.h"
#include "tools/voussoir/verb.h"

namespace voussoir {

namespace {

const std::string& kind_of(const Vehicle& vehicle) {
  return vehicle_kinds()[std::size_t(vehicle.kind)];
}

double tonnes(double force) {
  return force / (1e3 * standard_gravity);
}

void print_library(const std::vector<Vehicle>& vehicles) {
  fmt::print(
      "| vehicle | description | kind | axles | weight, t | length, m | source |\n| --- | --- | --- | --- | --- | --- "
      "| --- |\n");
  for (const Vehicle& v : vehicles)
    fmt::print("| `{}` | {} | {} | {} | {:.1f} | {:.2f} | {} |\n", v.name, v.title, kind_of(v), v.axles.size(),
               tonnes(axle_weight(v)), vehicle_length(v), v.source);
}

std::string end_text(double end) {
  return std::isfinite(end) ? fmt::format("{:.2f}", end) : "no end";
}

void print_axles(const Vehicle& v) {
  if (v.axles.empty()) return;
  fmt::print("\n| axle | x, m | load, kN | load, t |\n| --- | --- | --- | --- |\n");
  for (std::size_t i = 0; i < v.axles.size(); ++i)
    fmt::print("| {} | {:.2f} | {:.1f} | {:.2f} |\n", i + 1, v.axles[i].x, v.axles[i].load / 1e3,
               tonnes(v.axles[i].load));
  fmt::print(
      "\n| patch of axle | x, m | y, m | length, m | width, m | load, kN |\n| --- | --- | --- | --- | --- | --- |\n");
  for (const LoadPatch& p : v.patches)
    fmt::print("| {} | {:.2f} | {:.3f} | {:.2f} | {:.2f} | {:.2f} |\n", p.axle + 1, p.x, p.y, p.length, p.width,
               p.force / 1e3);
}

void print_strips(const Vehicle& v) {
  if (v.strips.empty()) return;
  fmt::print(
      "\n| strip from, m | to, m | y, m | width, m | pressure, kN/m2 | line load, kN/m |\n| --- | --- | --- | --- | "
      "--- | --- |\n");
  for (const LoadStrip& s : v.strips)
    fmt::print("| {} | {} | {:.2f} | {:.2f} | {:.2f} | {:.2f} |\n", end_text(s.from), end_text(s.to), s.y, s.width,
               s.pressure / 1e3, s.pressure * s.width / 1e3);
}

std::string factor_text(const DynamicFactor& f) {
  if (f.formula == DynamicFactor::Formula::value) return fmt::format("{:g}", f.value);
  return fmt::format("{}, determinant length {:g} times the span", factor_formulas()[std::size_t(f.formula) - 1],
                     f.determinant);
}

void print_choices(const Vehicle& v) {
  if (!v.factors.empty())
    fmt::print("\n| factor, used if asked for | value | acts on | clause |\n| --- | --- | --- | --- |\n");
  for (const DynamicFactor& f : v.factors)
    fmt::print("| {} | {} | {} | {} |\n", f.name, factor_text(f),
               f.critical_axle_only ? "the critical axle" : "all loads", f.clause);
  if (!v.variants.empty()) fmt::print("\n| variant | shares of the axles | clause |\n| --- | --- | --- |\n");
  for (const VehicleVariant& variant : v.variants)
    fmt::print("| {} | {:g} | {} |\n", variant.name, fmt::join(variant.shares, ", "), variant.clause);
}

void print_vehicle(const Vehicle& v) {
  fmt::print("{}: {} ({})\nsource: {}\n", v.name, v.title, kind_of(v), v.source);
  if (!v.not_checked.empty()) fmt::print("not checked against the source: {}\n", fmt::join(v.not_checked, ", "));
  fmt::print("axles: {:.1f} kN ({:.2f} t), {:.2f} m from the first to the last, {:.2f} m wide\n", axle_weight(v) / 1e3,
             tonnes(axle_weight(v)), vehicle_length(v), vehicle_width(v));
  print_axles(v);
  print_strips(v);
  print_choices(v);
}

void print_json(const std::vector<Vehicle>& vehicles) {
  nlohmann::json list = nlohmann::json::array();
  for (const Vehicle& vehicle : vehicles) list.push_back(vehicle_json(vehicle));
  fmt::print("{}", json_text({{"vehicles", list}}));
}

int vehicles_verb_run(const std::vector<std::string>& arguments) {
  CommandLine line("vehicles", "vehicles [NAME|FILE …] [--json]", "voussoir vehicles lm71");
  line.rest = "NAME";
  line.described.add_options()("json", "print everything as JSON, in N and m");
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  const bool all = !values.count("NAME");
  std::vector<Vehicle> vehicles;
  for (const std::string& name : all ? shipped_vehicles() : values["NAME"].as<std::vector<std::string>>())
    vehicles.push_back(read_vehicle(name));
  if (values.count("json"))
    print_json(vehicles);
  else if (all)
    print_library(vehicles);
  else
    for (std::size_t i = 0; i < vehicles.size(); ++i) {
      if (i > 0) fmt::print("\n");
      print_vehicle(vehicles[i]);
    }
  return 0;
}

}  // namespace

Verb vehicles_verb() {
  return {"vehicles", "list the lorries, trains and load models of the library, or describe one", vehicles_verb_run};
}

}  // namespace voussoir
