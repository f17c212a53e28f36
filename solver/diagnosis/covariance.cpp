// What a right model may miss a right measurement by: the covariance of all rows.
#include <cmath>

#include "solver/base/error.h"
#include "solver/base/parallel.h"
#include "solver/diagnosis/rows.h"
#include "solver/linear/dense_solve.h"

namespace voussoir {

namespace {

void set_whitening(DiagnosisProblem& problem, const std::vector<ResidualRow>& rows) {
  const RowSplit split = split_rows(problem, rows);
  std::vector<int> order = split.fitted;
  order.insert(order.end(), split.held.begin(), split.held.end());
  const Eigen::MatrixXd c = problem.covariance.at(problem.scale)(order, order), white = whitening_of(c),
                        colour = lower_factor(c);
  problem.whitening.resize(c.rows(), c.cols());
  problem.colouring.resize(c.rows(), c.cols());
  problem.whitening(order, order) = white;
  problem.colouring(order, order) = colour;
}

}  // namespace

Eigen::MatrixXd RowCovariance::at(const ErrorScale& scale) const {
  const Eigen::VectorXd wider = Eigen::VectorXd::Ones(own.rows()) + (scale.shapes - 1.0) * of_shape;
  Eigen::MatrixXd all = scale.structure * scale.structure * structure * structure.transpose();
  return all + free + wider.asDiagonal() * own * wider.asDiagonal();
}

void set_scale(DiagnosisProblem& problem, const ErrorScale& scale) {
  problem.scale = scale;
  set_whitening(problem, residual_rows(problem));
}

void set_mesh_error(DiagnosisProblem& problem, const Response& response, const Hypothesis& hypothesis,
                    const Eigen::VectorXd& x) {
  if (!problem.coarser) return;
  try {
    problem.mesh = mesh_error(*problem.coarser, response, hypothesis, x, int(problem.features.modes.size()) + 2);
  } catch (const std::runtime_error&) {
    return;  // what was measured without it is the best that is known
  }
  const double farther = problem.coarser->farther;
  problem.error.frequency = std::hypot(problem.apart_from_mesh.frequency, farther * problem.mesh.scatter);
  problem.error.shape = std::hypot(problem.apart_from_mesh.shape, farther * problem.mesh.shape);
}

namespace {

/// Eigenvalues of the computed modes as the measurement has them; of those that were not measured, moved by as much as
/// the others on average.
Eigen::VectorXd measured_eigenvalues(const Features& features, const Response& plain, const ModePairs& pairs) {
  double shift = 0.0, count = 0.0;
  const auto log_eigenvalue = [](double frequency) { return 2.0 * std::log(2.0 * EIGEN_PI * frequency); };
  for (std::size_t m = 0; m < features.modes.size(); ++m)
    if (const int c = pairs.computed[m]; c >= 0)
      shift += log_eigenvalue(features.modes[m].frequency) - std::log(plain.eigenvalues[c]), count += 1.0;
  Eigen::VectorXd values = plain.eigenvalues * std::exp(count > 0.0 ? shift / count : 0.0);
  for (std::size_t m = 0; m < features.modes.size(); ++m)
    if (const int c = pairs.computed[m]; c >= 0) values[c] = std::exp(log_eigenvalue(features.modes[m].frequency));
  return values;
}

/// The part of the covariance that each mode has for itself.
class OwnErrors {
 public:
  /// `readings`: of sensors, with their faults.
  OwnErrors(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows, const Response& plain,
            const Eigen::MatrixXd& readings)
      : problem_(problem), rows_(rows), readings_(readings) {
    pairs_ = pair_features(problem.features, plain, readings);
    eigenvalues_ = measured_eigenvalues(problem.features, plain, pairs_);
    covariance_ = Eigen::MatrixXd::Zero(Eigen::Index(rows.size()), Eigen::Index(rows.size()));
    for (std::size_t i = 0; i < rows.size(); ++i)
      covariance_(Eigen::Index(i), Eigen::Index(i)) = rows[i].std * rows[i].std;
    for (std::size_t m = 0; m < problem.features.modes.size(); ++m) add_mixing(int(m));
  }
  const Eigen::MatrixXd& covariance() const { return covariance_; }

  /// What nothing is known of: how large a shape is, and its phase.
  Eigen::MatrixXd free_scales() const {
    constexpr double wide = 3.0;  // in units of its largest component
    Eigen::MatrixXd free = Eigen::MatrixXd::Zero(covariance_.rows(), covariance_.cols());
    for (std::size_t m = 0; m < problem_.features.modes.size(); ++m) {
      const int own = pairs_.computed[m];
      if (own < 0) continue;
      for (const ResidualRow::Kind kind : {ResidualRow::Kind::shape, ResidualRow::Kind::quadrature}) {
        const RowRange range = rows_of(rows_, int(m), kind);
        if (range.count() == 0) continue;
        const Eigen::VectorXd shape = seen(rows_, range, readings_.col(own));
        const Eigen::VectorXd unit = wide / std::max(shape.cwiseAbs().maxCoeff(), 1e-300) * shape;
        free.block(range.at(), range.at(), range.count(), range.count()) = unit * unit.transpose();
      }
    }
    return free;
  }

 private:
  /// First order: φᵢ' = Σ φⱼ (φⱼᵀ K' φᵢ)/(λᵢ − λⱼ), of which φⱼᵀ K' φᵢ is a share of √(λᵢ λⱼ).
  void add_mixing(int m) {
    const RowRange shape = rows_of(rows_, m, ResidualRow::Kind::shape);
    const RowRange phase = rows_of(rows_, m, ResidualRow::Kind::quadrature);
    if (shape.count() == 0) return;
    const double lambda = std::pow(2.0 * EIGEN_PI * problem_.features.modes[std::size_t(m)].frequency, 2);
    const int own = pairs_.computed[std::size_t(m)];
    const double unit =
        own >= 0 ? seen(rows_, shape, readings_.col(own)).cwiseAbs().maxCoeff() : readings_.cwiseAbs().maxCoeff();
    for (Eigen::Index j = 0; j < eigenvalues_.size(); ++j) {
      if (int(j) == own) continue;
      const double other = eigenvalues_[j], apart = std::abs(other - lambda) / std::sqrt(other * lambda);
      const double share = std::min(1.0, problem_.error.mixing / std::max(apart, 1e-6));
      const Eigen::VectorXd neighbour = share / unit * seen(rows_, shape, readings_.col(j));
      covariance_.block(shape.at(), shape.at(), shape.count(), shape.count()) += neighbour * neighbour.transpose();
      if (phase.count() == 0) continue;
      // Neighbours that dampers couple add to the imaginary part; half as much is the most that is usual.
      const Eigen::VectorXd turned = 0.5 * share / unit * seen(rows_, phase, readings_.col(j));
      covariance_.diagonal().segment(phase.at(), phase.count()) += turned.cwiseAbs2();
    }
  }

  const DiagnosisProblem& problem_;
  const std::vector<ResidualRow>& rows_;
  const Eigen::MatrixXd& readings_;
  ModePairs pairs_;
  Eigen::VectorXd eigenvalues_;
  Eigen::MatrixXd covariance_;
};

/// Effect of each nuisance on the rows, from its effect on the modes.
Eigen::MatrixXd rows_of_nuisances(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows,
                                  const Response& plain, const Hypothesis& hypothesis, const Eigen::VectorXd& x,
                                  const Observed& as_is, const std::vector<Sensitivity>& nuisances) {
  constexpr double step = 1e-5;  // along the derivative of the modes
  const ModePairs pairs = pair_features(problem.features, plain, as_is.readings);
  const Eigen::VectorXd at = differences(problem, rows, pairs, as_is);
  Eigen::MatrixXd structure = Eigen::MatrixXd::Zero(at.size(), Eigen::Index(nuisances.size()));
  for (std::size_t n = 0; n < nuisances.size(); ++n) {
    if (nuisances[n].modes.log_frequency.size() == 0) continue;
    const Observed moved = hypothesis.observe(along(plain, nuisances[n].modes, step), problem.damping, x);
    structure.col(Eigen::Index(n)) = (differences(problem, rows, pairs, moved) - at) / step;
  }
  return structure;
}

}  // namespace

void set_covariance(DiagnosisProblem& problem, const Origin& origin, const Hypothesis& hypothesis,
                    const Eigen::VectorXd& x, int threads) {
  set_covariance(problem, origin, origin.response(), hypothesis, x, threads);
}

void set_covariance(DiagnosisProblem& problem, const Origin& origin, const Response& plain,
                    const Hypothesis& hypothesis, const Eigen::VectorXd& x, int threads) {
  const std::vector<ResidualRow> rows = residual_rows(problem);
  RowCovariance& c = problem.covariance;
  const Observed as_is = hypothesis.observe(plain, problem.damping, x);
  const OwnErrors own(problem, rows, plain, as_is.readings);
  c.nuisances.assign(problem.nuisances.size(), {});
  const Sensitivities of(origin, problem.features.sensors, question_of(problem, plain).wanted);
  for_all(c.nuisances.size(), threads,
          [&](std::size_t i) { c.nuisances[i] = of.of(problem.nuisances[i], problem.base, hypothesis, x); });
  if (problem.coarser && problem.mesh.difference.log_frequency.size() == plain.log_frequency.size()) {
    const double farther = problem.coarser->farther;
    Sensitivity mesh = {"size of the blocks", "-", farther, problem.mesh.difference, {}};
    mesh.modes.log_frequency *= farther;
    mesh.modes.sensors *= farther;
    c.nuisances.push_back(std::move(mesh));
  }
  problem.shape_metric.assign(problem.features.modes.size(), {});
  c.structure = rows_of_nuisances(problem, rows, plain, hypothesis, x, as_is, c.nuisances);
  c.own = own.covariance();
  c.free = Eigen::MatrixXd::Zero(c.own.rows(), c.own.cols());
  c.of_shape = Eigen::VectorXd::Zero(c.own.rows());
  for (std::size_t i = 0; i < rows.size(); ++i)
    c.of_shape[Eigen::Index(i)] =
        rows[i].kind != ResidualRow::Kind::frequency && rows[i].kind != ResidualRow::Kind::damping;
  const Eigen::MatrixXd known = c.at({});
  for (std::size_t m = 0; m < problem.features.modes.size(); ++m)
    if (const RowRange r = rows_of(rows, int(m), ResidualRow::Kind::shape); r.count() > 0)
      problem.shape_metric[m] = whitening_of(known.block(r.at(), r.at(), r.count(), r.count()));
  c.std = known.diagonal().cwiseSqrt();
  c.free = own.free_scales();
  set_whitening(problem, rows);
}

void set_covariance(DiagnosisProblem& problem) {
  const Origin origin(problem.base, problem.features.sensors, problem.modes, problem.features.driven());
  set_covariance(problem, origin, {}, {}, 1);
}

}  // namespace voussoir
