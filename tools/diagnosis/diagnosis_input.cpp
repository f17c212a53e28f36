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
  mesh->assembly = remeshed(input.c, 1.25 * input.block_scale);
  mesh->sensors = features_of(input.measured, mesh->assembly).sensors;
  // The stones are those of the case: what is coarser is so many times farther off; and no mesh is better than half.
  const double own = input.c.generator_input.values.at("block_scale");
  mesh->farther = std::max(0.5, (input.block_scale - own) / (0.25 * input.block_scale));
  return mesh;
}

/// What the mesh does to the case as it is, and errors of shapes, for both problems.
void measure_mesh(DiagnosisInput& input) {
  EigenMemory memory;
  DiagnosisProblem& p = input.coarse;
  p.coarser = coarser_mesh(input);
  const Response plain = response(p.base, linear_model(p.base), p.features.sensors, p.modes, memory);
  set_mesh_error(p, plain, {}, {});
  set_shape_errors(p, plain);
  if (!input.coarsened) {
    input.full = p;
    return;
  }
  input.full.mesh = p.mesh;
  input.full.error.frequency = std::hypot(p.apart_from_mesh.frequency, 0.5 * p.mesh.scatter);
  input.full.error.shape = std::hypot(p.apart_from_mesh.shape, 0.5 * p.mesh.shape);
  set_shape_errors(input.full);
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
  if (can_remesh(input.c)) input.block_scale = input.c.generator_input.values.at("block_scale");
  Assembly coarse = own;
  while (can_remesh(input.c) && unknowns_of(coarse) > request.unknowns) {
    // Blocks per volume fall with the cube of their size.
    const double factor = std::cbrt(double(unknowns_of(coarse)) / request.unknowns);
    input.block_scale *= std::max(1.05, factor);
    input.coarsened = true;
    coarse = remeshed(input.c, input.block_scale);
  }
  input.identification = identify(input.measured, input.c, coarse, request.most_modes);
  input.full = problem_of(request, input, std::move(own));
  input.coarse = problem_of(request, input, std::move(coarse));
  measure_mesh(input);
  return input;
}

}  // namespace voussoir
