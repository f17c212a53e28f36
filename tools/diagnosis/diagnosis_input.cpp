#include "tools/diagnosis/diagnosis_input.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "io/case/remarks.h"
#include "solver/base/error.h"
#include "tools/diagnosis/measured_features.h"

namespace voussoir {

namespace {

/// The case's assembly with blocks of another size.
Assembly remeshed(const Case& c, double block_scale) {
  Case other = c;
  other.generator_input.values.at("block_scale") = block_scale;
  return make_assembly(other);
}

std::int64_t unknowns_of(const Assembly& assembly) {
  return 6 * std::count_if(assembly.blocks.begin(), assembly.blocks.end(), [](const Block& b) { return !b.fixed; });
}

bool can_remesh(const Case& c) {
  return !c.generator.empty() && c.generator_input.values.contains("block_scale");
}

/// The largest block_scale that the generator accepts.
double largest_scale(const Case& c) {
  const std::vector<Parameter> parameters = keys_of(find_generator(c.generator), c.generator_input).parameters;
  return std::ranges::find(parameters, "block_scale", &Parameter::name)->high;
}

/// The mesh with blocks 1.25 times as large. It shows how the block size affects the modes. Null if the case cannot be
/// meshed with larger blocks; a remark says so if only its block_scale is too large.
std::shared_ptr<const CoarserMesh> coarser_mesh(DiagnosisInput& input) {
  if (!can_remesh(input.c)) return nullptr;
  const double own = input.c.generator_input.values.at("block_scale"), coarser = 1.25 * own;
  if (const double largest = largest_scale(input.c); coarser > largest) {
    input.measured.remarks.push_back(fmt::format(
        "block_scale = {} leaves no mesh with blocks 1.25 times as large (the generator accepts at most {}), so the "
        "model error does not contain the error of the mesh; use block_scale <= {:.4g}",
        own, largest, largest / 1.25));
    return nullptr;
  }
  auto mesh = std::make_shared<CoarserMesh>();
  mesh->assembly = remeshed(input.c, coarser);
  mesh->sensors = features_of(input.measured, mesh->assembly).sensors;
  mesh->farther = 0.5;  // the case has real stones, but the uncertainty of a mesh is at least half of that
  return mesh;
}

/// The case with one dimension changed by `amount`. All dimensions with the same value change together, because on the
/// bridge they are one dimension.
Assembly with_dimension(const Case& c, double value, double amount) {
  Case other = c;
  for (const Parameter& p : keys_of(find_generator(c.generator), c.generator_input).parameters) {
    double& own = other.generator_input.values.at(p.name);
    if (is_dimension(p) && own == value) own = std::clamp(own + amount, p.low, p.high);
  }
  return make_assembly(other);
}

/// The uncertainties of the dimensions that a generator is given.
std::vector<Nuisance> dimension_nuisances(const Case& c) {
  constexpr double usual = 0.02;  // m; not more than a twentieth of the dimension
  std::vector<Nuisance> all;
  if (c.generator.empty()) return all;
  std::map<double, std::string> names;  // by value
  for (const Parameter& p : keys_of(find_generator(c.generator), c.generator_input).parameters) {
    const double value = c.generator_input.values.at(p.name);
    if (!is_dimension(p) || value <= 0.0) continue;
    std::string& name = names[value];
    name += (name.empty() ? "" : " = ") + p.name;
  }
  for (const auto& [value, name] : names) {
    const double spread = std::min(usual, 0.05 * value);
    // The difference is taken over one standard deviation. Over a smaller one, joints that appear or vanish would
    // count for too much.
    all.push_back(
        {name, "m", spread, spread, [c, value = value](const Assembly& base, double amount) {
           if (!base.fill.nodes.empty())
             throw InputError(
                 "a change of this dimension would remesh the deformable fill, so the two models cannot be compared");
           return with_dimension(c, value, amount);
         }});
  }
  return all;
}

/// Solves the case as it is, and sets the errors of the mesh and of everything that is not exactly known.
void measure_errors(const DiagnosisRequest& request, DiagnosisInput& input) {
  DiagnosisProblem& p = input.problem;
  p.coarser = coarser_mesh(input);
  if (!p.origin) p.origin = std::make_shared<Origin>(p.base, p.features.sensors, p.modes, p.features.driven());
  set_mesh_error(p, p.origin->response(), {}, {});
  p.nuisances = part_nuisances(p.base);
  for (Nuisance& dimension : dimension_nuisances(input.c)) p.nuisances.push_back(std::move(dimension));
  set_covariance(p, *p.origin, {}, {}, request.settings.threads);
}

/// The assembly with larger blocks until it has few enough unknowns for runs of many steps.
Assembly for_runs(const Case& c, Assembly assembly) {
  constexpr double most = 12000.0;
  if (!can_remesh(c)) return assembly;
  double block_scale = c.generator_input.values.at("block_scale");
  const double largest = largest_scale(c);
  while (double(unknowns_of(assembly)) > most && block_scale < largest) {
    // Blocks per volume fall with the cube of their size.
    block_scale = std::min(largest, block_scale * std::max(1.05, std::cbrt(double(unknowns_of(assembly)) / most)));
    assembly = remeshed(c, block_scale);
  }
  return assembly;
}

void hold_back(Features& features, const std::vector<std::string>& names) {
  for (const std::string& name : names) {
    const auto at = std::find_if(features.modes.begin(), features.modes.end(),
                                 [&](const MeasuredFeature& mode) { return mode.name == name; });
    if (at == features.modes.end()) throw InputError("--hold-back: there is no measured mode '{}'", name);
    at->held_back = true;
  }
}

DiagnosisProblem problem_of(const DiagnosisRequest& request, const DiagnosisInput& input, Assembly assembly) {
  DiagnosisProblem problem;
  problem.features = features_of(input.measured, assembly);
  hold_back(problem.features, request.hold_back);
  problem.base = std::move(assembly);
  problem.apart_from_mesh.frequency = request.model_error;
  problem.apart_from_mesh.shape = request.shape_error;
  problem.error = problem.apart_from_mesh;
  const DampingSettings& damping = input.c.settings.damping;
  using Kind = DampingSettings::Kind;
  if (damping.kind == Kind::maxwell || damping.kind == Kind::rayleigh) problem.damping = damping.ratio;
  // Identification leaves out modes that the ground motion did not excite.
  const int measured = int(problem.features.modes.size());
  problem.modes = std::min(input.measured.records.empty() ? measured + 8 : 2 * measured + 8, 40);
  return problem;
}

}  // namespace

DiagnosisInput diagnosis_input(const DiagnosisRequest& request) {
  DiagnosisInput input;
  input.c = request.c;
  input.measured = read_measured(request.measured);
  input.without = request.settings.without;
  Assembly own = make_assembly(input.c);
  for (std::string& text : remarks(input.c, own)) input.measured.remarks.push_back(std::move(text));
  input.identification = identify(input.measured, input.c, own, request.most_modes);
  input.runs = problem_of(request, input, for_runs(input.c, own));
  input.problem = problem_of(request, input, std::move(own));
  measure_errors(request, input);
  return input;
}

DiagnosisInput planned_input(const DiagnosisRequest& request, const MeasurementPlan& plan) {
  DiagnosisInput input;
  input.c = request.c;
  input.measured.directory = plan.sensors;
  input.measured.sensors = read_sensors(plan.sensors);
  Assembly own = make_assembly(input.c);
  for (std::string& text : remarks(input.c, own)) input.measured.remarks.push_back(std::move(text));
  std::vector<Sensor> sensors;
  const std::vector<std::int64_t> blocks = place_sensors(input.measured.sensors, plan.sensors, own);
  for (std::size_t i = 0; i < blocks.size(); ++i) {
    const MeasuredSensor& s = input.measured.sensors[i];
    sensors.push_back({s.id, s.position, s.direction, blocks[i]});
  }
  auto origin = std::make_shared<Origin>(own, sensors, plan.modes + 8);
  const double ratio = input.c.settings.damping.ratio;
  input.measured.modes = expected_modes(origin->response(), plan.modes, {plan.noise, 2.0 * plan.noise, ratio});
  if (ratio <= 0.0)
    for (MeasuredMode& mode : input.measured.modes) mode.damping.reset();
  input.problem = problem_of(request, input, std::move(own));
  input.problem.origin = std::move(origin);
  measure_errors(request, input);
  return input;
}

}  // namespace voussoir
