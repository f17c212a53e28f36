#include "solver/diagnosis/screening.h"

#include <cmath>

#include "solver/base/error.h"
#include "solver/base/parallel.h"
#include "solver/linear/dense_solve.h"

namespace voussoir {

namespace {

/// The residuals, including prior rows, and their derivatives with respect to the parameters of the hypothesis.
struct Linearised {
  const DiagnosisProblem* problem = nullptr;
  std::vector<ResidualRow> rows;
  std::vector<int> fitted;
  Evaluation at;
  Eigen::VectorXd r;  // fitted rows, then x
  Eigen::MatrixXd j;
  double misfit = 0.0;  // least that the parameters reach
};

Eigen::VectorXd with_priors(const Linearised& l, const Eigen::VectorXd& residuals) {
  Eigen::VectorXd all(Eigen::Index(l.fitted.size()) + l.at.x.size());
  all << residuals(l.fitted), l.at.x;
  return all;
}

/// What no change of the parameters takes away.
Eigen::VectorXd left_over(const Linearised& l, const Eigen::VectorXd& r) {
  return r - l.j * least_squares(l.j, r);
}

Linearised linearise(const DiagnosisProblem& problem, const Hypothesis& hypothesis, const Eigen::VectorXd& x,
                     const Origin& origin, const Vectors& shared) {
  Linearised l;
  l.problem = &problem;
  l.rows = residual_rows(problem);
  l.fitted = split_rows(problem, l.rows).fitted;
  ModelFamily family(origin, problem.base, hypothesis, question_of(problem, origin.response()), x,
                     ModelFamily::Use::often);
  family.append(shared);
  const ModelFamily::Member member = family.member(x);
  l.at = evaluate(problem, l.rows, hypothesis, family, member);
  const Eigen::MatrixXd j = jacobian(problem, l.rows, hypothesis, family, member, l.at);
  l.j.resize(Eigen::Index(l.fitted.size()) + x.size(), x.size());
  l.j << j(l.fitted, Eigen::all), Eigen::MatrixXd::Identity(x.size(), x.size());
  l.r = with_priors(l, l.at.residuals);
  l.misfit = left_over(l, l.r).squaredNorm();
  return l;
}

/// Residuals with the candidate in place at its start.
Eigen::VectorXd residuals_with(const Linearised& l, const Hypothesis& hypothesis, const Candidate& candidate,
                               const std::vector<double>& start, const Origin& origin) {
  constexpr double tolerance = 1e-3;  // of eigenvalues
  const Hypothesis more = hypothesis.with(candidate);
  Eigen::VectorXd x(Eigen::Index(more.size()));
  x << l.at.x, Eigen::Map<const Eigen::VectorXd>(start.data(), Eigen::Index(start.size()));
  const bool model_changes = candidate.kind == Candidate::Kind::effect || candidate.kind == Candidate::Kind::factor;
  if (model_changes) {
    ModelFamily family(origin, l.problem->base, more, question_of(*l.problem, origin.response()), x,
                       ModelFamily::Use::once);
    family.converge(x, tolerance);
    return evaluate(*l.problem, l.rows, more, family, family.member(x)).residuals;
  }
  const Observed observed = more.observe(l.at.response, l.problem->damping, x);
  const ModePairs pairing = pair_features(l.problem->features, l.at.response, observed.readings);
  return residuals(*l.problem, l.rows, pairing, observed);
}

/// `amount`: the candidate has one; else it is there or not.
Signature signature(const Linearised& l, const Eigen::VectorXd& changed, bool amount) {
  Signature s;
  s.possible = true;
  const Eigen::VectorXd after = with_priors(l, changed);
  const Eigen::VectorXd left = left_over(l, l.r), move = left_over(l, Eigen::VectorXd(after - l.r));
  const double size2 = move.squaredNorm();
  s.direction = size2 > 0.0 ? Eigen::VectorXd(move / std::sqrt(size2)) : move;
  // Along the straight line through both points as far as helps, at most to three times the usual strength; or as it
  // is.
  s.share = !amount ? 1.0 : size2 > 0.0 ? std::clamp(-left.dot(move) / size2, 0.0, 3.0) : 0.0;
  s.misfit = std::min((left + s.share * move).squaredNorm(), left_over(l, after).squaredNorm());
  s.explained = l.misfit > 0.0 ? 1.0 - s.misfit / l.misfit : 0.0;
  return s;
}

}  // namespace

std::vector<Signature> signatures(const DiagnosisProblem& problem, const Hypothesis& hypothesis,
                                  const Eigen::VectorXd& x, const std::vector<Candidate>& candidates, int threads,
                                  const Origin& origin, const Vectors& shared) {
  const Linearised l = linearise(problem, hypothesis, x, origin, shared);
  std::vector<Signature> all;
  for (std::size_t c = 0; c < candidates.size(); ++c)
    for (std::size_t start = 0; start < candidates[c].starts.size(); ++start) {
      Signature s;
      s.candidate = c;
      s.start = start;
      all.push_back(s);
    }
  for_all(all.size(), threads, [&](std::size_t i) {
    const Candidate& candidate = candidates[all[i].candidate];
    try {
      Signature s = signature(l, residuals_with(l, hypothesis, candidate, candidate.starts[all[i].start], origin),
                              !candidate.parameters.empty());
      s.candidate = all[i].candidate;
      s.start = all[i].start;
      all[i] = s;
    } catch (const std::runtime_error&) {
      // Its place is taken by an effect that is there already.
    }
  });
  return all;
}

double collinearity(const Signature& a, const Signature& b) {
  return a.direction.size() == b.direction.size() ? std::abs(a.direction.dot(b.direction)) : 0.0;
}

}  // namespace voussoir
