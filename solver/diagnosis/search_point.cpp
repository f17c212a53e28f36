#include "solver/diagnosis/search_point.h"

namespace voussoir {

std::shared_ptr<const Origin> origin_at(const DiagnosisProblem& problem, const Hypothesis& hypothesis,
                                        const Eigen::VectorXd& x) {
  if (problem.origin && hypothesis.effects.empty() && x.isZero(0.0)) return problem.origin;
  return std::make_shared<Origin>(hypothesis.assembly(problem.base, x), problem.features.sensors, problem.modes,
                                  problem.features.driven());
}

Eigen::VectorXd at_usual_materials(const Fit& fit) {
  Eigen::VectorXd x = fit.best.x;
  x.head(Eigen::Index(fit.hypothesis.materials.size())).setZero();
  return x;
}

Vectors shared_by_fits(const DiagnosisProblem& problem, const Origin& origin, const Hypothesis& hypothesis,
                       const Eigen::VectorXd& x) {
  return material_vectors(origin, problem.base, hypothesis, x, question_of(problem, origin.response()).wanted);
}

Hypothesis without(Hypothesis hypothesis, std::size_t effect) {
  hypothesis.effects.erase(hypothesis.effects.begin() + std::ptrdiff_t(effect));
  return hypothesis;
}

Eigen::VectorXd without(const Fit& fit, std::size_t effect) {
  auto at = Eigen::Index(fit.hypothesis.materials.size());
  for (std::size_t i = 0; i < effect; ++i) at += Eigen::Index(fit.hypothesis.effects[i].parameters.size());
  const auto gone = Eigen::Index(fit.hypothesis.effects[effect].parameters.size());
  Eigen::VectorXd x(fit.best.x.size() - gone);
  x << fit.best.x.head(at), fit.best.x.tail(fit.best.x.size() - at - gone);
  return x;
}

std::optional<Fit> fit_if_possible(const DiagnosisProblem& problem, const Hypothesis& hypothesis,
                                   const Eigen::VectorXd& x, int iterations) {
  try {
    const Origin own(hypothesis.assembly(problem.base, x), problem.features.sensors, problem.modes,
                     problem.features.driven());
    return fit(problem, hypothesis, x, iterations, own, shared_by_fits(problem, own, hypothesis, x));
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

namespace {

/// A fit from where it is, about the standing model.
std::optional<Fit> fit_again(const DiagnosisProblem& problem, const SearchPoint& s, int iterations) {
  try {
    return fit(problem, s.fit.hypothesis, s.fit.best.x, iterations, *s.origin, s.shared);
  } catch (const std::runtime_error&) {
    return std::nullopt;
  }
}

}  // namespace

SearchPoint adopt(DiagnosisProblem& problem, const DiagnosisSettings& settings, const Trial& trial,
                  const SearchPoint& before) {
  SearchPoint s = {trial.fit, before.origin, before.shared};
  const Eigen::VectorXd x = at_usual_materials(s.fit);
  if (!trial.candidate.of_sensors()) {
    s.origin = origin_at(problem, s.fit.hypothesis, x);
    s.shared = shared_by_fits(problem, *s.origin, s.fit.hypothesis, x);
    set_mesh_error(problem, s.origin->response(), s.fit.hypothesis, x);
  }
  set_covariance(problem, *s.origin, s.fit.hypothesis, x, settings.threads);
  set_scale(problem, {1.0, s.fit.scale.shapes});
  if (std::optional<Fit> again = fit_again(problem, s, settings.iterations)) s.fit = std::move(*again);
  return s;
}

}  // namespace voussoir
