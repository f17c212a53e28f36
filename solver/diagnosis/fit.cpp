#include "solver/diagnosis/fit.h"

#include <ceres/ceres.h>

#include <cmath>

#include "solver/base/error.h"
#include "solver/linear/dense_solve.h"

namespace voussoir {

namespace {

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
       const RowSplit& split, const ModelFamily& family)
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
  const RowSplit* split_;
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

/// A fit to first order: fitted rows are those at x = 0 and J x, under a covariance that is C + J Jᵀ before the data.
struct LinearFit {
  Eigen::VectorXd rows;  // at x = 0, each in its own unit
  Eigen::MatrixXd jacobian;
};

/// Evidence and posterior standard deviations of x for one pair of error scales.
struct UnderScale {
  ErrorScale scale;
  double log_evidence = 0.0;
  Eigen::MatrixXd covariance;  // of x: 1 − Jᵀ (C + J Jᵀ)⁻¹ J
};
UnderScale under_scale(const RowCovariance& c, const std::vector<int>& fitted, const LinearFit& l,
                       const ErrorScale& scale) {
  const Eigen::MatrixXd all = c.at(scale)(fitted, fitted) + l.jacobian * l.jacobian.transpose();
  const Eigen::MatrixXd white = whitening_of(all), j = white * l.jacobian;
  UnderScale u;
  u.scale = scale;
  u.log_evidence = -0.5 * (white * l.rows).squaredNorm() + white.diagonal().array().log().sum();
  u.covariance = Eigen::MatrixXd::Identity(j.cols(), j.cols()) - j.transpose() * j;
  return u;
}

/// Over all scales: logarithmic priors of deviation 0.35 about 1; of the structure from a half to 2.8, of shapes from
/// a half to 2.2. The structure's bound is far: a scale at its bound would leave misfit for effects to explain.
void weigh_scales(const DiagnosisProblem& problem, const std::vector<int>& fitted, const LinearFit& l, Fit& fit) {
  constexpr double spread = 0.35;
  std::vector<UnderScale> all;
  std::vector<double> prior, weights;
  double priors = 0.0, most = -1e300, sum = 0.0;
  for (const double structure : {0.5, 0.7, 1.0, 1.4, 2.0, 2.8})
    for (const double shapes : {0.5, 0.75, 1.0, 1.5, 2.2}) {
      all.push_back(under_scale(problem.covariance, fitted, l, {structure, shapes}));
      prior.push_back(
          std::exp(-0.5 * (std::pow(std::log(structure) / spread, 2) + std::pow(std::log(shapes) / spread, 2))));
      priors += prior.back();
      most = std::max(most, all.back().log_evidence);
    }
  for (std::size_t i = 0; i < all.size(); ++i) {
    weights.push_back(prior[i] / priors * std::exp(all[i].log_evidence - most));
    sum += weights.back();
  }
  // The fit was made under one scale; the others count from there.
  fit.log_evidence += most + std::log(sum) - under_scale(problem.covariance, fitted, l, problem.scale).log_evidence;
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(l.jacobian.cols());
  fit.scale = {0.0, 0.0};
  for (std::size_t i = 0; i < all.size(); ++i) {
    fit.scale.structure += weights[i] / sum * all[i].scale.structure;
    fit.scale.shapes += weights[i] / sum * all[i].scale.shapes;
    variance += weights[i] / sum * all[i].covariance.diagonal();
  }
  fit.std = variance.cwiseSqrt();
}

/// The amount of an effect is relative to the stiffnesses and masses of its part, which are as uncertain as those of
/// other parts. This relative standard deviation remains with any measurement.
void add_own_law(Fit& fit) {
  constexpr double own = 0.08;  // as for the stiffness of a part (nuisance.cpp)
  auto at = Eigen::Index(fit.hypothesis.materials.size());
  for (const Candidate& c : fit.hypothesis.effects)
    for (const FitParameter& p : c.parameters) {
      const double x = fit.best.x[at];
      if (c.kind == Candidate::Kind::effect)
        fit.std[at] = std::hypot(fit.std[at], own / p.spread * (p.logarithmic ? 1.0 : std::abs(p.value(x))));
      ++at;
    }
}

LinearFit linear_fit(const DiagnosisProblem& problem, const Fit& fit, const std::vector<int>& fitted) {
  LinearFit l;
  l.jacobian = (problem.colouring * fit.jacobian)(fitted, Eigen::all);
  l.rows = fit.best.differences(fitted) - l.jacobian * fit.best.x;
  return l;
}

/// What all other rows leave of groups of rows (indices into the fitted ones), each as a sum of squares in standard
/// deviations of that prediction: with P = (C + J Jᵀ)⁻¹, it is P_ii⁻¹ (P r)_i, of the covariance P_ii⁻¹ (Rasmussen and
/// Williams 2006, §5.4.2, of groups).
std::vector<double> leave_out(const Eigen::MatrixXd& covariance, const LinearFit& l,
                              const std::vector<std::vector<int>>& groups) {
  const Eigen::MatrixXd p = inverse_of(covariance + l.jacobian * l.jacobian.transpose());
  const Eigen::VectorXd r = p * l.rows;
  std::vector<double> sums;
  for (const std::vector<int>& group : groups) {
    const Eigen::VectorXd own = r(group);
    sums.push_back(group.empty() ? 0.0 : own.dot(solve_symmetric(Eigen::MatrixXd(p(group, group)), own)));
  }
  return sums;
}

/// Root mean square error of the prediction of the rows of each mode from the other modes.
double predicted_gap(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows,
                     const std::vector<int>& fitted, const LinearFit& l) {
  std::vector<std::vector<int>> groups(problem.features.modes.size());
  for (std::size_t i = 0; i < fitted.size(); ++i)
    groups[std::size_t(rows[std::size_t(fitted[i])].mode)].push_back(int(i));
  double sum = 0.0;
  for (const double own : leave_out(problem.covariance.at(problem.scale)(fitted, fitted), l, groups)) sum += own;
  return fitted.empty() ? 0.0 : std::sqrt(sum / double(fitted.size()));
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
  e.differences = differences(problem, rows, e.pairing, observed);
  e.residuals = problem.whitening * e.differences;
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

double log_evidence(const Eigen::VectorXd& r, const Eigen::MatrixXd& j, const Eigen::VectorXd& x) {
  if (j.cols() == 0) return -0.5 * r.squaredNorm();
  const Eigen::VectorXd pivots = pivots_of(curvature_of(j));
  return -0.5 * (r.squaredNorm() + x.squaredNorm()) - 0.5 * pivots.array().log().sum();
}

std::vector<LeftOutSensor> leave_out_sensors(const DiagnosisProblem& problem, const Fit& fit) {
  const std::vector<ResidualRow> rows = residual_rows(problem);
  const std::vector<int> fitted = split_rows(problem, rows).fitted;
  std::vector<std::vector<int>> groups(problem.features.sensors.size());
  for (std::size_t i = 0; i < fitted.size(); ++i)
    if (const ResidualRow& row = rows[std::size_t(fitted[i])]; row.kind == ResidualRow::Kind::shape)
      groups[std::size_t(row.sensor)].push_back(int(i));
  const std::vector<double> sums =
      leave_out(problem.covariance.at(fit.scale)(fitted, fitted), linear_fit(problem, fit, fitted), groups);
  std::vector<LeftOutSensor> all;
  for (std::size_t s = 0; s < sums.size(); ++s) all.push_back({sums[s], int(groups[s].size())});
  return all;
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
  const RowSplit split = split_rows(problem, rows);
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
  result.misfit = r.squaredNorm() + best.squaredNorm();
  result.log_evidence = log_evidence(r, j, best);
  result.gap = mean_square_root(r);
  result.held_gap = mean_square_root(result.best.residuals(split.held));
  const LinearFit l = linear_fit(problem, result, split.fitted);
  weigh_scales(problem, split.fitted, l, result);
  add_own_law(result);
  result.predicted_gap = predicted_gap(problem, rows, split.fitted, l);
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
