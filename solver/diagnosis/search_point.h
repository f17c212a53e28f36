// The present point of a search: a fit, and the model about which candidates are tried.
#pragma once
#include <memory>
#include <optional>

#include "solver/diagnosis/diagnose.h"

namespace voussoir {

/// A fit, its model at usual materials, about which candidates are tried, and the derivatives of that model with
/// respect to the materials.
struct SearchPoint {
  Fit fit;
  std::shared_ptr<const Origin> origin;
  Vectors shared;
};

/// The model of a hypothesis at x. For the base, the existing model is used.
std::shared_ptr<const Origin> origin_at(const DiagnosisProblem& problem, const Hypothesis& hypothesis,
                                        const Eigen::VectorXd& x);
/// x of a fit with the materials of the case.
Eigen::VectorXd at_usual_materials(const Fit& fit);
/// Derivatives of the responses of the model at x with respect to the materials of a hypothesis.
Vectors shared_by_fits(const DiagnosisProblem& problem, const Origin& origin, const Hypothesis& hypothesis,
                       const Eigen::VectorXd& x);

Hypothesis without(Hypothesis hypothesis, std::size_t effect);
/// x of a fit without the parameters of one of its effects.
Eigen::VectorXd without(const Fit& fit, std::size_t effect);

/// A fit from x about the model at x. Empty if that model is not a valid bridge or the fit does not converge.
std::optional<Fit> fit_if_possible(const DiagnosisProblem& problem, const Hypothesis& hypothesis,
                                   const Eigen::VectorXd& x, int iterations);

/// Takes over a trial: its fit, its model, and the effects of mesh and nuisances on that model.
SearchPoint adopt(DiagnosisProblem& problem, const DiagnosisSettings& settings, const Trial& trial,
                  const SearchPoint& before);

}  // namespace voussoir
