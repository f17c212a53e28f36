// Screening: finds the candidates that could explain the residuals, before fitting them.
#pragma once
#include "solver/diagnosis/fit.h"

namespace voussoir {

/// Change of the residuals by a candidate with its usual values.
struct Signature {
  std::size_t candidate = 0, start = 0;
  bool possible = false;   // it can be combined with the present hypothesis
  double share = 0.0;      // share of the step from "without" to the start values (may exceed 1) that fits best on the
                           // straight line
  double misfit = 0.0;     // predicted for the candidate and the materials together
  double explained = 0.0;  // share of the misfit that it removes in addition to the materials
  Eigen::VectorXd direction;  // unit vector over fitted rows and prior rows, without the part that materials can
                              // explain
};

/// Signatures relative to the hypothesis at x, whose model is `origin`, with a reduced basis for each candidate;
/// `shared` as in fit(). Faults of sensors need no basis. The order is that of the candidates and their start values.
std::vector<Signature> signatures(const DiagnosisProblem& problem, const Hypothesis& hypothesis,
                                  const Eigen::VectorXd& x, const std::vector<Candidate>& candidates, int threads,
                                  const Origin& origin, const Vectors& shared);

/// |cosine| between two signatures: 1 if these sensors cannot distinguish them.
double collinearity(const Signature& a, const Signature& b);

}  // namespace voussoir
