#include "solver/diagnosis/fit.h"

#include <ceres/ceres.h>

#include <cmath>

#include "solver/base/error.h"
#include "solver/linear/dense_solve.h"

namespace voussoir {

namespace {

ModalData along(const ModalData& modes, const ModalData& d, double step) {
  ModalData moved = modes;
  moved.log_frequency += step * d.log_frequency;
  moved.sensors += step * d.sensors;
  if (d.participation.size() > 0) moved.participation += step * d.participation;
  for (std::size_t k = 0; k < d.at_support.size(); ++k) moved.at_support[k] += step * d.at_support[k];
  return moved;
}

struct Split {
  std::vector<int> fitted, held;  // rows
};
Split split_rows(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows) {
  Split split;
  for (std::size_t i = 0; i < rows.size(); ++i)
    (problem.features.modes[std::size_t(rows[i].mode)].held_back ? split.held : split.fitted).push_back(int(i));
  return split;
}

/// What lies beyond its bounds is put on them: nothing changes there.
Eigen::VectorXd within_bounds(const Hypothesis& hypothesis, Eigen::VectorXd x) {
  const std::vector<FitParameter> parameters = hypothesis.parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i)
    x[Eigen::Index(i)] =
        std::clamp(x[Eigen::Index(i)], parameters[i].x(parameters[i].low), parameters[i].x(parameters[i].high));
  return x;
}

/// Ceres' view: fitted residuals, then x itself as residuals of the prior.
class Cost : public ceres::CostFunction {
 public:
  Cost(const DiagnosisProblem& problem, const Hypothesis& hypothesis, const std::vector<ResidualRow>& rows,
       const Split& split, const ModelFamily& family)
      : problem_(&problem), hypothesis_(&hypothesis), rows_(&rows), split_(&split), family_(&family) {
    mutable_parameter_block_sizes()->push_back(int(hypothesis.size()));
    set_num_residuals(int(split.fitted.size() + hypothesis.size()));
  }
  bool Evaluate(double const* const* parameters, double* r, double** jacobians) const override {
    const auto n = Eigen::Index(hypothesis_->size()), m = Eigen::Index(split_->fitted.size());
    const Eigen::VectorXd x = within_bounds(*hypothesis_, Eigen::Map<const Eigen::VectorXd>(parameters[0], n));
    // Ceres asks for the derivatives where it has just been.
    if (member_.x.size() != n || member_.x != x) {
      member_ = family_->member(x);
      last_ = evaluate(*problem_, *rows_, *hypothesis_, *family_, member_);
      ++evaluations_;
    }
    Eigen::Map<Eigen::VectorXd> residuals(r, m + n);
    residuals << last_.residuals(split_->fitted), x;
    if (jacobians && jacobians[0]) {
      const Eigen::MatrixXd all = jacobian(*problem_, *rows_, *hypothesis_, *family_, member_, last_);
      Eigen::Map<Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>> j(jacobians[0], m + n, n);
      j << all(split_->fitted, Eigen::all), Eigen::MatrixXd::Identity(n, n);
    }
    return residuals.allFinite();
  }
  int evaluations() const { return evaluations_; }

 private:
  const DiagnosisProblem* problem_;
  const Hypothesis* hypothesis_;
  const std::vector<ResidualRow>* rows_;
  const Split* split_;
  const ModelFamily* family_;
  mutable ModelFamily::Member member_;
  mutable Evaluation last_;
  mutable int evaluations_ = 0;
};

/// Parameters beyond their bounds count as if at them: no bounds are needed here, whose line searches would cost an
/// eigenvalue solution each.
void solve(const Cost& cost, Eigen::VectorXd& x, int iterations) {
  ceres::Problem::Options ownership;
  ownership.cost_function_ownership = ceres::DO_NOT_TAKE_OWNERSHIP;
  ceres::Problem least_squares(ownership);
  double* values = x.data();
  least_squares.AddResidualBlock(const_cast<Cost*>(&cost), nullptr, values);
  ceres::Solver::Options options;
  options.linear_solver_type = ceres::DENSE_QR;
  options.max_num_iterations = iterations;
  options.function_tolerance = 1e-3;
  options.parameter_tolerance = 1e-4;
  options.initial_trust_region_radius = 10.0;
  options.num_threads = 1;
  options.logging_type = ceres::SILENT;
  ceres::Solver::Summary summary;
  ceres::Solve(options, &least_squares, &summary);
  if (!summary.IsSolutionUsable()) throw RunError("the fit failed: {}", summary.message);
}

double mean_square_root(const Eigen::VectorXd& r) {
  return r.size() > 0 ? std::sqrt(r.squaredNorm() / double(r.size())) : 0.0;
}

/// Second derivatives of half the misfit, the priors' with it.
Eigen::MatrixXd curvature_of(const Eigen::MatrixXd& j) {
  return Eigen::MatrixXd::Identity(j.cols(), j.cols()) + j.transpose() * j;
}

/// Leaving each mode out in turn of a linear fit with priors.
struct LeftOut {
  double gap = 0.0;  // root mean square of what the others leave of its rows
  /// Of x: jackknife over the modes (Efron and Stein 1981), whose rows share errors of the model that the covariance of
  /// the fit takes as independent.
  Eigen::VectorXd std;
};
/// What is left of its rows is (1 − H)⁻¹ r of them, H their part of the hat matrix, with the covariance (1 − H)⁻¹ (Cook
/// and Weisberg 1982, §2.2); x moves by −(1 + JᵀJ)⁻¹ Jᵀ of that.
LeftOut leave_out(const std::vector<ResidualRow>& rows, const Split& split, const Eigen::VectorXd& r,
                  const Eigen::MatrixXd& j) {
  LeftOut result = {mean_square_root(r), Eigen::VectorXd::Zero(j.cols())};
  if (j.cols() == 0) return result;
  const Eigen::MatrixXd turned = j.transpose(), inverse = solve_symmetric(curvature_of(j), turned);
  double sum = 0.0;
  Eigen::Index count = 0;
  int modes = 0;
  for (std::size_t begin = 0, end = 0; begin < split.fitted.size(); begin = end) {
    const int mode = rows[std::size_t(split.fitted[begin])].mode;
    while (end < split.fitted.size() && rows[std::size_t(split.fitted[end])].mode == mode) ++end;
    const auto at = Eigen::Index(begin), n = Eigen::Index(end - begin);
    const Eigen::MatrixXd left = Eigen::MatrixXd::Identity(n, n) - j.middleRows(at, n) * inverse.middleCols(at, n);
    const Eigen::VectorXd own = r.segment(at, n), predicted = solve_symmetric(left, own);
    sum += own.dot(predicted);
    result.std += (inverse.middleCols(at, n) * predicted).cwiseAbs2();
    count += n;
    ++modes;
  }
  result.gap = count > 0 ? std::sqrt(sum / double(count)) : 0.0;
  result.std = (result.std * (modes > 0 ? double(modes - 1) / modes : 0.0)).cwiseSqrt();
  return result;
}

}  // namespace

namespace {

Evaluation seen(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows, const Hypothesis& hypothesis,
                const Eigen::VectorXd& x, const Response& response) {
  Evaluation e;
  e.x = x;
  e.response = response;
  const Observed observed = hypothesis.observe(e.response, problem.damping, x);
  e.readings = observed.readings;
  e.pairing = pair_features(problem.features, e.response, e.readings);
  e.residuals = residuals(problem, rows, e.pairing, observed);
  return e;
}

}  // namespace

Evaluation evaluate(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows, const Hypothesis& hypothesis,
                    const Eigen::VectorXd& x, EigenMemory& memory) {
  const Assembly assembly = hypothesis.assembly(problem.base, x);
  const LinearModel model = linear_model(assembly);
  Evaluation e =
      seen(problem, rows, hypothesis, x,
           response(assembly, model, problem.features.sensors, problem.modes, memory, problem.features.driven()));
  e.assembly = assembly, e.model = model;
  return e;
}

Evaluation evaluate(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows, const Hypothesis& hypothesis,
                    const Eigen::VectorXd& x, const Origin& origin) {
  Evaluation e = seen(problem, rows, hypothesis, x, origin.response());
  e.assembly = origin.assembly(), e.model = origin.model();
  return e;
}

Evaluation evaluate(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows, const Hypothesis& hypothesis,
                    const ModelFamily& family, const ModelFamily::Member& member) {
  return seen(problem, rows, hypothesis, member.x, family.response(member));
}

Eigen::MatrixXd jacobian(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows,
                         const Hypothesis& hypothesis, const ModelFamily& family, const ModelFamily::Member& member,
                         const Evaluation& at) {
  constexpr double step = 1e-5;  // along the derivative of the response
  Eigen::MatrixXd j(Eigen::Index(rows.size()), at.x.size());
  for (Eigen::Index p = 0; p < at.x.size(); ++p) {
    Eigen::VectorXd x = at.x;
    x[p] += step;
    const ModalData moved = along(at.response, family.derivative(member, p), step);
    j.col(p) =
        (residuals(problem, rows, at.pairing, hypothesis.observe(moved, problem.damping, x)) - at.residuals) / step;
  }
  return j;
}

Question question_of(const DiagnosisProblem& problem, const Response& response) {
  Question q = {problem.features.sensors, problem.modes, int(problem.features.modes.size()), problem.features.driven()};
  for (const int c : pair_features(problem.features, response, response.sensors).computed)
    q.wanted = std::max(q.wanted, c + 1);
  q.wanted = std::min(q.wanted + 2, q.modes);
  return q;
}

double log_evidence(const Eigen::VectorXd& r, const Eigen::MatrixXd& j, const Eigen::VectorXd& x) {
  if (j.cols() == 0) return -0.5 * r.squaredNorm();
  const Eigen::VectorXd pivots = pivots_of(curvature_of(j));
  return -0.5 * (r.squaredNorm() + x.squaredNorm()) - 0.5 * pivots.array().log().sum();
}

double chi_square_tail(double sum, int n) {
  // Wilson and Hilferty (1931): the cube root of χ²/n is nearly normal.
  if (n <= 0) return 1.0;
  const double v = 2.0 / (9.0 * n), z = (std::cbrt(sum / n) - (1.0 - v)) / std::sqrt(v);
  return 0.5 * std::erfc(z / std::sqrt(2.0));
}

namespace {

constexpr double basis_tolerance = 1e-4;  // of eigenvalues; what is left after the last vectors is less still

Fit fit_in(ModelFamily& family, const DiagnosisProblem& problem, const Hypothesis& hypothesis, const Eigen::VectorXd& x,
           int iterations) {
  constexpr int tries = 3;
  const std::vector<ResidualRow> rows = residual_rows(problem);
  const Split split = split_rows(problem, rows);
  Fit result;
  result.hypothesis = hypothesis;
  Eigen::VectorXd best = x;
  // Again while the basis was not good enough where the last fit went.
  for (int i = 0; i < tries && iterations > 0 && x.size() > 0; ++i) {
    const Cost cost(problem, hypothesis, rows, split, family);
    solve(cost, best, i == 0 ? iterations : 3);
    best = within_bounds(hypothesis, best);
    result.evaluations += cost.evaluations();
    result.basis_error = family.refine(best);
    if (result.basis_error < basis_tolerance) break;
    result.basis_error = family.converge(best, basis_tolerance);
  }
  const ModelFamily::Member member = family.member(best);
  result.best = evaluate(problem, rows, hypothesis, family, member);
  ++result.evaluations;
  result.jacobian = jacobian(problem, rows, hypothesis, family, member, result.best);
  const Eigen::VectorXd r = result.best.residuals(split.fitted);
  const Eigen::MatrixXd j = result.jacobian(split.fitted, Eigen::all);
  const LeftOut left_out = leave_out(rows, split, r, j);
  if (best.size() > 0) result.std = inverse_of(curvature_of(j)).diagonal().cwiseSqrt().cwiseMax(left_out.std);
  result.misfit = r.squaredNorm() + best.squaredNorm();
  result.log_evidence = log_evidence(r, j, best);
  result.gap = mean_square_root(r);
  result.held_gap = mean_square_root(result.best.residuals(split.held));
  result.predicted_gap = left_out.gap;
  const std::vector<FitParameter> parameters = hypothesis.parameters();
  for (std::size_t i = 0; i < parameters.size(); ++i) {
    const FitParameter& p = parameters[i];
    const double at = best[Eigen::Index(i)];
    result.at_bound.push_back(at < p.x(p.low) + 1e-3 || at > p.x(p.high) - 1e-3);
  }
  return result;
}

}  // namespace

namespace {

Fit fit_about(const Origin& origin, const Vectors& shared, const DiagnosisProblem& problem,
              const Hypothesis& hypothesis, const Eigen::VectorXd& x, int iterations) {
  ModelFamily family(origin, problem.base, hypothesis, question_of(problem, origin.response()), x,
                     ModelFamily::Use::often);
  family.append(shared);
  family.converge(x, 1e-3);
  return fit_in(family, problem, hypothesis, x, iterations);
}

}  // namespace

Fit fit(const DiagnosisProblem& problem, const Hypothesis& hypothesis, const Eigen::VectorXd& x, int iterations,
        const Origin& origin, const Vectors& shared) {
  Fit result = fit_about(origin, shared, problem, hypothesis, x, iterations);
  if (result.basis_error < basis_tolerance) return result;
  const Eigen::VectorXd end = result.best.x;
  const Origin own(hypothesis.assembly(problem.base, end), problem.features.sensors, problem.modes,
                   problem.features.driven());
  const int wanted = question_of(problem, own.response()).wanted;
  return fit_about(own, material_vectors(own, problem.base, hypothesis, end, wanted), problem, hypothesis, end, 3);
}

Fit fit(const DiagnosisProblem& problem, const Hypothesis& hypothesis, const Eigen::VectorXd& x, int iterations) {
  const Origin origin(hypothesis.assembly(problem.base, x), problem.features.sensors, problem.modes,
                      problem.features.driven());
  const Question question = question_of(problem, origin.response());
  Fit result = fit(problem, hypothesis, x, iterations, origin,
                   material_vectors(origin, problem.base, hypothesis, x, question.wanted));
  if (result.best.x == x)
    result.best = evaluate(problem, residual_rows(problem), hypothesis, x, origin);
  else
    make_whole(problem, result);
  return result;
}

void make_whole(const DiagnosisProblem& problem, Fit& fit) {
  EigenMemory memory;
  fit.best = evaluate(problem, residual_rows(problem), fit.hypothesis, fit.best.x, memory);
}

}  // namespace voussoir
