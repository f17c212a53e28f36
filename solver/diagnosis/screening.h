// Which candidates could explain what is left, before any is fitted.
#pragma once
#include "solver/diagnosis/fit.h"

namespace voussoir {

/// What a candidate at its usual strength does to the residuals.
struct Signature {
  std::size_t candidate = 0, start = 0;
  bool possible = false;   // it can act beside what is already there
  double share = 0.0;      // of the way from without to the start (and on) at which the straight line between is best
  double misfit = 0.0;     // predicted, of the candidate and the materials together
  double explained = 0.0;  // share of the misfit that it takes away, over what the materials can
  Eigen::VectorXd direction;  // unit, of fitted rows and prior rows, without what the materials can do
};

/// Against the hypothesis at x, of which `origin` is the model, in a basis each; `shared` as fit() has them. Faults of
/// sensors need none. Ordered as the candidates and their starts.
std::vector<Signature> signatures(const DiagnosisProblem& problem, const Hypothesis& hypothesis,
                                  const Eigen::VectorXd& x, const std::vector<Candidate>& candidates, int threads,
                                  const Origin& origin, const Vectors& shared);

/// |cosine| between two signatures: 1 where these sensors cannot tell them apart.
double collinearity(const Signature& a, const Signature& b);

}  // namespace voussoir
