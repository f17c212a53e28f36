#include "tools/diagnosis/diagnose_case.h"

#include <fmt/format.h>

#include "solver/base/error.h"

namespace voussoir {

namespace {

/// The text of the corrected case: the text of the case and the effects that were found. Faults of sensors belong to
/// the measurement; they are written as comments.
std::string corrected_text(const DiagnosisInput& input, const std::vector<EffectSetting>& all) {
  std::vector<EffectSetting> model;
  std::string faults;
  for (const EffectSetting& effect : all) {
    if (effect.name == "sensor_fault")
      faults += fmt::format("# Fault of the measurement: {}\n", effect.text());
    else
      model.push_back(effect);
  }
  return fmt::format("{}\n# Added by voussoir diagnose from {}.\n{}{}", input.c.text, input.measured.directory, faults,
                     effects_text(model));
}

/// Fits only the sensor faults and support motions of the hypothesis, because the corrected assembly does not contain
/// them.
Fit rerun(const DiagnosisProblem& judged, Assembly corrected, double damping, const Fit& found) {
  DiagnosisProblem problem = judged;
  problem.base = std::move(corrected);
  problem.origin = nullptr;  // that of the case
  problem.damping = damping;
  Hypothesis faults;
  std::vector<double> x;
  auto at = Eigen::Index(found.hypothesis.materials.size());
  for (const Candidate& c : found.hypothesis.effects) {
    const bool fault = c.of_sensors() || c.kind == Candidate::Kind::motion;
    if (fault) faults.effects.push_back(c);
    for (std::size_t i = 0; i < c.parameters.size(); ++i, ++at)
      if (fault) x.push_back(found.best.x[at]);
  }
  return fit(problem, faults, Eigen::Map<const Eigen::VectorXd>(x.data(), Eigen::Index(x.size())), 0);
}

/// The hypothesis whose effects have the parameters that were found as usual values (x = 0).
Hypothesis with_found_effects(const Fit& found) {
  constexpr double held = 1e-4;  // of their priors
  Hypothesis h = found.hypothesis;
  auto at = Eigen::Index(h.materials.size());
  for (Candidate& c : h.effects)
    for (FitParameter& p : c.parameters) {
      p.usual = p.value(found.best.x[at++]);
      p.spread *= held;
    }
  return h;
}

/// The materials of the corrected case with the effects as they were found. Each row has only its own error here. With
/// the errors that all rows share, the fit could leave a common shift to these errors instead of the materials; a case
/// for further use must follow the shift.
Fit fit_corrected(const DiagnosisProblem& judged, const Fit& found) {
  DiagnosisProblem problem = judged;
  set_scale(problem, {0.0, judged.scale.shapes});
  const Hypothesis hypothesis = with_found_effects(found);
  Eigen::VectorXd x = Eigen::VectorXd::Zero(Eigen::Index(hypothesis.size()));
  const Origin origin(hypothesis.assembly(problem.base, x), problem.features.sensors, problem.modes,
                      problem.features.driven());
  const int wanted = question_of(problem, origin.response()).wanted;
  return fit(problem, hypothesis, x, 16, origin, material_vectors(origin, problem.base, hypothesis, x, wanted));
}

}  // namespace

DiagnosisResult diagnose_case(const DiagnosisInput& input, const DiagnosisRequest& request,
                              const std::function<void(const std::string&)>& say) {
  DiagnosisResult result;
  result.diagnosis = diagnose(input.problem, request.settings, say);
  Diagnosis& d = result.diagnosis;
  result.before = d.plain;
  result.calibrated = fit_corrected(d.judged, d.best);
  const Fit& c = result.calibrated;
  result.corrected_text = corrected_text(input, c.hypothesis.settings(c.best.x));
  result.corrected = parse_case(result.corrected_text, input.c.path, CaseUse::geometry);
  result.after = rerun(d.judged, make_assembly(result.corrected), result.corrected.settings.damping.ratio, c);
  result.modes = compare_modes(input.problem, result.before, d.judged, result.after);
  result.where = locate(input.problem, result.before.best);
  result.where_after = locate(input.problem, result.after.best);
  try {
    result.recorded = run_recorded(input, c, request.run_seconds, request.settings.threads, say);
  } catch (const std::runtime_error& error) {
    say(fmt::format("The runs under the recorded motion failed: {}", error.what()));
  }
  return result;
}

}  // namespace voussoir
