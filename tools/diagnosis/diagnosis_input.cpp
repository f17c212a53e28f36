#include "tools/diagnosis/diagnosis_input.h"

#include <algorithm>
#include <cmath>

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

/// Blocks 1.25 times as large, to see what their size does.
std::shared_ptr<const CoarserMesh> coarser_mesh(const DiagnosisInput& input) {
  if (!can_remesh(input.c)) return nullptr;
  auto mesh = std::make_shared<CoarserMesh>();
  mesh->assembly = remeshed(input.c, 1.25 * input.c.generator_input.values.at("block_scale"));
  mesh->sensors = features_of(input.measured, mesh->assembly).sensors;
  mesh->farther = 0.5;  // the stones are those of the case, but no mesh is better than half of that
  return mesh;
}

/// What the mesh does to the case as it is, and errors of shapes.
void measure_mesh(DiagnosisInput& input) {
  DiagnosisProblem& p = input.problem;
  p.coarser = coarser_mesh(input);
  p.origin = std::make_shared<Origin>(p.base, p.features.sensors, p.modes, p.features.driven());
  // What neighbours add to participation counts from the first effect on: with it from the beginning, a support that
  // moves by 0.4 of the others' motion is lost (trial 59 of voussoir-blind).
  Response plain = p.origin->response();
  plain.participation.resize(0, 0);
  set_mesh_error(p, plain, {}, {});
  set_shape_errors(p, plain);
}

/// The assembly with larger blocks until it has few enough unknowns for runs of many steps.
Assembly for_runs(const Case& c, Assembly assembly) {
  constexpr double most = 12000.0;
  if (!can_remesh(c)) return assembly;
  double block_scale = c.generator_input.values.at("block_scale");
  while (double(unknowns_of(assembly)) > most) {
    // Blocks per volume fall with the cube of their size.
    block_scale *= std::max(1.05, std::cbrt(double(unknowns_of(assembly)) / most));
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
  // Identification leaves out modes that nothing drove.
  const int measured = int(problem.features.modes.size());
  problem.modes = std::min(input.measured.records.empty() ? measured + 8 : 2 * measured + 8, 40);
  return problem;
}

}  // namespace

DiagnosisInput diagnosis_input(const DiagnosisRequest& request) {
  DiagnosisInput input;
  input.c = read_case(request.case_file, CaseUse::geometry);
  input.measured = read_measured(request.measured);
  input.without = request.settings.without;
  Assembly own = make_assembly(input.c);
  for (std::string& text : remarks(input.c, own)) input.measured.remarks.push_back(std::move(text));
  input.identification = identify(input.measured, input.c, own, request.most_modes);
  input.runs = problem_of(request, input, for_runs(input.c, own));
  input.problem = problem_of(request, input, std::move(own));
  measure_mesh(input);
  return input;
}

}  // namespace voussoir
