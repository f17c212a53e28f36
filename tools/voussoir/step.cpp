// voussoir step.
#include <fmt/format.h>

#include <nlohmann/json.hpp>

#include "io/case/case.h"
#include "solver/base/error.h"
#include "solver/base/json_file.h"
#include "solver/run/step_report.h"
#include "solver/step/damping.h"
#include "tools/voussoir/options.h"

namespace voussoir {

namespace {

constexpr std::array<double, 8> shares = {0.0, 0.001, 0.01, 0.1, 0.25, 0.5, 0.75, 0.9};
constexpr std::array<double, 5> budgets = {1e-5, 1e-4, 1e-3, 1e-2, 5e-2};

/// The effect of a share of added mass on the time step.
struct Budget {
  MassScaling scaling;
  double share = 0.0, step = 0.0;  // s, critical
};

std::vector<Budget> try_budgets(const Model& model, const State& state) {
  std::vector<Budget> rows;
  for (double share : budgets) {
    Model scaled = model;
    Budget row;
    row.share = share;
    row.scaling = scale_mass(scaled, state, 0.0, share);
    row.step = critical_step(scaled, state).step;
    rows.push_back(row);
  }
  return rows;
}

void print_report(const Assembly& assembly, const Model& model, const StepReport& report) {
  const char* what = model.fill.empty() ? "bodies" : "bodies and nodes";
  fmt::print(
      "\n{} that demand the shortest time steps. First column: time step that each demands, s. Second column: time "
      "step of the assembly if this one is held, s\n",
      what);
  for (const StiffSite& row : report.stiffest)
    fmt::print("{:>10.4g} {:>10.4g}  {}\n", row.step, row.without, describe_stiff_site(assembly, model, row));
  fmt::print("\nshare of the {} that demand a time step shorter than the value in the second column, s\n", what);
  for (double share : shares) fmt::print("{:>9.1f} % {:>10.4g}\n", 100 * share, report.at_share(share));
  fmt::print(
      "\ncritical time step, s, if the inertia of the stiffest {} is raised until they demand no shorter time step "
      "than the next one\n",
      what);
  fmt::print("{:>10} {:>10} {:>12} {:>8}\n", "raised", "step", "added mass", "gain");
  for (const StiffestRaised& row : report.raised)
    fmt::print("{:>10} {:>10.4g} {:>10.4f} % {:>8.3f}\n", row.count, row.step, 100 * row.share,
               row.step / report.critical.step);
}

void print_budgets(const std::vector<Budget>& rows, double before) {
  fmt::print(
      "\ncritical time step, s, with mass scaling (mass_scaling_limit). Column bodies: number of bodies with more "
      "inertia; heavier: number of these with more mass; most mass, most rot.: largest factors on mass and rotary "
      "inertia\n");
  fmt::print("{:>10} {:>10} {:>8} {:>8} {:>8} {:>10} {:>10}\n", "limit", "step", "gain", "bodies", "heavier",
             "most mass", "most rot.");
  for (const Budget& row : rows)
    fmt::print("{:>10g} {:>10.4g} {:>8.3f} {:>8} {:>8} {:>10.3f} {:>10.3f}\n", row.share, row.step, row.step / before,
               row.scaling.bodies, row.scaling.heavier, row.scaling.largest, row.scaling.largest_rotary);
}

nlohmann::json site_json(const Model& model, const StiffSite& site) {
  nlohmann::json json = {{"step", site.step}, {"without", site.without}};
  if (site.node >= 0) {
    json["node"] = site.node;
    json["mass"] = model.fill.mass[std::size_t(model.fill.node_of[std::size_t(site.node)])];
    return json;
  }
  json["block"] = model.block_of_body[std::size_t(site.body)];
  json["mass"] = model.bodies[std::size_t(site.body)].mass;
  json["thickness"] = least_thickness(model, site.body);
  if (site.patch >= 0) json["joint"] = model.joint_of_patch[std::size_t(site.patch)];
  return json;
}

nlohmann::json report_json(const Model& model, const StepReport& report, const std::vector<Budget>& rows) {
  nlohmann::json json = {
      {"critical_step", report.critical.step}, {"block", model.block_of_body[std::size_t(report.critical.body)]},
      {"stiffest", nlohmann::json::array()},   {"local_steps", nlohmann::json::array()},
      {"raised", nlohmann::json::array()},     {"mass_scaling", nlohmann::json::array()}};
  if (report.critical.node >= 0) json.erase("block"), json["node"] = report.critical.node;
  for (const StiffSite& row : report.stiffest) json["stiffest"].push_back(site_json(model, row));
  for (double share : shares) json["local_steps"].push_back({{"share", share}, {"step", report.at_share(share)}});
  for (const StiffestRaised& row : report.raised)
    json["raised"].push_back({{"bodies", row.count}, {"share", row.share}, {"step", row.step}});
  for (const Budget& row : rows)
    json["mass_scaling"].push_back({{"limit", row.share},
                                    {"step", row.step},
                                    {"bodies", row.scaling.bodies},
                                    {"nodes", row.scaling.nodes},
                                    {"heavier", row.scaling.heavier},
                                    {"largest", row.scaling.largest},
                                    {"largest_rotary", row.scaling.largest_rotary}});
  return json;
}

int step(const std::vector<std::string>& arguments) {
  CommandLine line("step", "step CASE [-o FILE]", "voussoir step cases/cs1-f.toml");
  line.described.add_options()("bodies", whole_option("bodies", 0, 1'000'000)->value_name("N")->default_value(8),
                               "number of the stiffest bodies to list")(
      "output,o", options::value<std::string>()->value_name("FILE"), "also write the result as JSON");
  line.positional = line.required = {"CASE"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  const int bodies = values["bodies"].as<int>();
  if (values.count("output")) check_ending(values["output"].as<std::string>(), {".json"}, "JSON");
  const Case c = read_case(values["CASE"].as<std::string>(), CaseUse::geometry);
  const Assembly assembly = make_assembly(c);
  const Model model = build_model(assembly, c.settings);
  const State state = initial_state(model);
  const StepReport report = report_step(model, state, bodies);
  if (report.critical.body < 0) {
    fmt::print("no joint holds any block, so there is no critical time step\n");
    return 0;
  }
  const std::vector<Budget> rows = try_budgets(model, state);
  const double factor = damping_step_factor(c.settings.damping, report.critical.highest);
  if (!values.count("quiet")) {
    fmt::print("critical time step {:.4g} s undamped, × {:.3f} for damping, × {} safety: {:.4g} s\nset by {}\n",
               report.critical.step, factor, c.settings.step.safety,
               report.critical.step * factor * c.settings.step.safety,
               describe_fastest(assembly, model, report.critical));
    print_report(assembly, model, report);
    print_budgets(rows, report.critical.step);
  }
  if (values.count("output")) write_json(values["output"].as<std::string>(), report_json(model, report, rows));
  return 0;
}

}  // namespace

Verb step_verb() {
  return {"step", "say which blocks limit the time step, and what mass scaling would gain", step};
}

}  // namespace voussoir
