// What a search stands on: a fit, and the model about which candidates are tried.
#pragma once
#include <memory>
#include <optional>

#include "solver/diagnosis/diagnose.h"

namespace voussoir {

/// A fit, the model it has with usual materials, about which candidates are tried, and what materials do to that.
struct SearchPoint {
  Fit fit;
  std::shared_ptr<const Origin> origin;
  Vectors shared;
};

/// The model of a hypothesis at x; that of the base is there already.
std::shared_ptr<const Origin> origin_at(const DiagnosisProblem& problem, const Hypothesis& hypothesis,
                                        const Eigen::VectorXd& x);
/// x of a fit with its materials as the case has them.
Eigen::VectorXd at_usual_materials(const Fit& fit);
/// What the materials of a hypothesis do to the responses of the model at x.
Vectors shared_by_fits(const DiagnosisProblem& problem, const Origin& origin, const Hypothesis& hypothesis,
                       const Eigen::VectorXd& x);

Hypothesis without(Hypothesis hypothesis, std::size_t effect);
/// x of a fit without the parameters of one of its effects.
Eigen::VectorXd without(const Fit& fit, std::size_t effect);

/// A fit from x about the model there; nothing where that is no bridge that stands, or the fit does not converge.
std::optional<Fit> fit_if_possible(const DiagnosisProblem& problem, const Hypothesis& hypothesis,
                                   const Eigen::VectorXd& x, int iterations);

/// The fit of a trial, its model, and what the mesh and all that is not exactly known do to that.
SearchPoint adopt(DiagnosisProblem& problem, const DiagnosisSettings& settings, const Trial& trial,
                  const SearchPoint& before);

}  // namespace voussoir
