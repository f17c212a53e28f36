// Which candidates could explain what is left, before any is fitted.
#pragma once
#include "solver/diagnosis/fit.h"

namespace voussoir {

/// What a candidate at its usual strength does to the residuals.
struct Signature {
  std::size_t candidate = 0, start = 0;
  bool possible = false;      // it can act beside what is already there
  double misfit = 0.0;        // predicted, of the candidate and the materials together
  double explained = 0.0;     // share of the misfit that it takes away, over what the materials can
  Eigen::VectorXd direction;  // unit, of fitted rows and prior rows, without what the materials can do
};

/// One eigenvalue solution a start of each candidate, against the hypothesis at x; faults of sensors need none. Ordered
/// as the candidates and their starts.
std::vector<Signature> signatures(const DiagnosisProblem& problem, const Hypothesis& hypothesis,
                                  const Eigen::VectorXd& x, const std::vector<Candidate>& candidates, int threads);

/// |cosine| between two signatures: 1 where these sensors cannot tell them apart.
double collinearity(const Signature& a, const Signature& b);

/// Calls work(i, memory) for all i < n in `threads` threads. Each call finds `start` as the memory's; what else a
/// memory holds saves time and changes nothing, so the results do not depend on the threads. The first exception (by i)
/// is thrown at the end.
void for_all(std::size_t n, int threads, const Eigen::VectorXd& start,
             const std::function<void(std::size_t, EigenMemory&)>& work);

}  // namespace voussoir
