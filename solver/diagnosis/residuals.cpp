// Rows of residuals, and which computed mode is which measured one.
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "solver/diagnosis/assignment.h"
#include "solver/diagnosis/fit.h"
#include "solver/linear/dense_solve.h"

namespace voussoir {

namespace {

int measured_entries(const MeasuredFeature& mode) {
  return int(std::count_if(mode.shape.begin(), mode.shape.end(), [](double v) { return std::isfinite(v); }));
}

bool has_shape(const MeasuredFeature& mode) {
  return measured_entries(mode) >= 3;
}

double largest(const Eigen::VectorXd& shape) {
  double most = 0.0;
  for (double v : shape)
    if (std::isfinite(v)) most = std::max(most, std::abs(v));
  return most;
}

double assurance_at_sensors(const MeasuredFeature& mode, const Eigen::VectorXd& computed) {
  double mm = 0.0, cc = 0.0, mc = 0.0;
  for (Eigen::Index s = 0; s < computed.size(); ++s) {
    if (!std::isfinite(mode.shape[s])) continue;
    mm += mode.shape[s] * mode.shape[s];
    cc += computed[s] * computed[s];
    mc += mode.shape[s] * computed[s];
  }
  return mm > 0.0 && cc > 0.0 ? mc * mc / (mm * cc) : 0.0;
}

bool fits(const std::string& direction, const ModeWords& words) {
  return direction.empty() ? words.direction != "local" : words.direction == direction;
}

/// The k-th computed mode that fits the direction; −1: there are not so many.
int kth(const Response& response, const std::string& direction, int k) {
  for (std::size_t i = 0; i < response.words.size(); ++i)
    if (fits(direction, response.words[i]) && k-- == 0) return int(i);
  return -1;
}

void add_quadrature(const DiagnosisProblem& problem, int m, double scale, std::vector<ResidualRow>& rows) {
  const MeasuredFeature& mode = problem.features.modes[std::size_t(m)];
  for (Eigen::Index s = 0; s < mode.quadrature.size(); ++s) {
    if (!std::isfinite(mode.shape[s]) || !std::isfinite(mode.quadrature[s])) continue;
    const double mixing =
        std::size_t(m) < problem.quadrature_mixing.size() ? problem.quadrature_mixing[std::size_t(m)][s] : 0.0;
    rows.push_back({ResidualRow::Kind::quadrature, m, int(s),
                    std::hypot(mode.shape_std[s] / scale, problem.error.quadrature, mixing)});
  }
}

void add_participation(const DiagnosisProblem& problem, int m, double scale, std::vector<ResidualRow>& rows) {
  const MeasuredFeature& mode = problem.features.modes[std::size_t(m)];
  double most = 0.0;
  for (const std::complex<double>& p : mode.participation)
    if (std::isfinite(p.real())) most = std::max(most, scale * std::abs(p));
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(mode.participation[axis].real())) continue;
    const double mixing =
        std::size_t(m) < problem.participation_mixing.size() ? problem.participation_mixing[std::size_t(m)][axis] : 0.0;
    const double std = std::hypot(scale * mode.participation_std[axis], problem.error.participation * most, mixing);
    rows.push_back({ResidualRow::Kind::participation, m, axis, std});
    rows.push_back({ResidualRow::Kind::lag, m, axis, std});
  }
}

}  // namespace

std::vector<ResidualRow> residual_rows(const DiagnosisProblem& problem) {
  std::vector<ResidualRow> rows;
  for (std::size_t m = 0; m < problem.features.modes.size(); ++m) {
    const MeasuredFeature& mode = problem.features.modes[m];
    const int at = int(m);
    rows.push_back({ResidualRow::Kind::frequency, at, 0, std::hypot(mode.frequency_std, problem.error.frequency)});
    if (mode.damping && problem.damping > 0.0)
      rows.push_back({ResidualRow::Kind::damping, at, 0, std::hypot(mode.damping_std, problem.error.damping)});
    if (!has_shape(mode)) continue;
    const double scale = largest(mode.shape);
    for (Eigen::Index s = 0; s < mode.shape.size(); ++s)
      if (std::isfinite(mode.shape[s]))
        rows.push_back(
            {ResidualRow::Kind::shape, at, int(s), std::hypot(mode.shape_std[s] / scale, problem.error.shape)});
    add_quadrature(problem, at, scale, rows);
    add_participation(problem, at, scale, rows);
  }
  return rows;
}

ModePairs pair_features(const Features& features, const Response& response, const Eigen::MatrixXd& readings) {
  const std::size_t count = features.modes.size();
  ModePairs pairing;
  pairing.computed.assign(count, -1);
  pairing.assurance.assign(count, std::numeric_limits<double>::quiet_NaN());
  std::vector<std::size_t> shaped;
  std::map<std::string, int> seen;  // modes, by direction
  for (std::size_t m = 0; m < count; ++m) {
    const MeasuredFeature& mode = features.modes[m];
    // Those with shapes count too: the third transverse mode is the third whatever is known of the first two.
    const int before = seen[mode.direction]++;
    if (has_shape(mode))
      shaped.push_back(m);
    else
      pairing.computed[m] = kth(response, mode.direction, before);
  }
  if (shaped.empty()) return pairing;
  const auto columns = readings.cols();
  Eigen::MatrixXd cost(Eigen::Index(shaped.size()), columns), mac = cost;
  for (std::size_t i = 0; i < shaped.size(); ++i)
    for (Eigen::Index c = 0; c < columns; ++c) {
      const MeasuredFeature& mode = features.modes[shaped[i]];
      const auto row = Eigen::Index(i);
      mac(row, c) = assurance_at_sensors(mode, readings.col(c));
      const double apart = std::abs(std::log(mode.frequency) - response.log_frequency[c]);
      const bool other_way = !mode.direction.empty() && !fits(mode.direction, response.words[std::size_t(c)]);
      cost(row, c) = 1.0 - mac(row, c) + 0.5 * std::min(apart, 1.0) + (other_way ? 0.3 : 0.0);
    }
  const std::vector<int> partner = least_cost_assignment(cost);
  for (std::size_t i = 0; i < shaped.size(); ++i) {
    const int c = partner[i];
    if (c < 0 || mac(Eigen::Index(i), c) < 0.2) continue;
    pairing.computed[shaped[i]] = c;
    pairing.assurance[shaped[i]] = mac(Eigen::Index(i), c);
  }
  return pairing;
}

namespace {

/// Rows of a mode's shape.
struct ShapeRows {
  std::size_t begin = 0, end = 0;
  Eigen::Index count() const { return Eigen::Index(end - begin); }
};
ShapeRows shape_rows(const std::vector<ResidualRow>& rows, int mode) {
  const auto is = [&](const ResidualRow& row) { return row.mode == mode && row.kind == ResidualRow::Kind::shape; };
  const auto first = std::find_if(rows.begin(), rows.end(), is);
  const auto last = std::find_if_not(first, rows.end(), is);
  return {std::size_t(first - rows.begin()), std::size_t(last - rows.begin())};
}

/// The sensors of these rows.
Eigen::VectorXd seen(const std::vector<ResidualRow>& rows, const ShapeRows& shape, const Eigen::VectorXd& all) {
  Eigen::VectorXd v(shape.count());
  for (std::size_t i = shape.begin; i < shape.end; ++i) v[Eigen::Index(i - shape.begin)] = all[rows[i].sensor];
  return v;
}

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

}  // namespace

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

void set_shape_errors(DiagnosisProblem& problem) {
  EigenMemory memory;
  set_shape_errors(problem, response(problem.base, linear_model(problem.base), problem.features.sensors, problem.modes,
                                     memory, problem.features.driven()));
}

void set_shape_errors(DiagnosisProblem& problem, const Response& plain) {
  problem.whitening.assign(problem.features.modes.size(), {});
  problem.quadrature_mixing.assign(problem.features.modes.size(),
                                   Eigen::VectorXd::Zero(Eigen::Index(problem.features.sensors.size())));
  problem.participation_mixing.assign(problem.features.modes.size(), Eigen::Vector3d::Zero());
  const std::vector<ResidualRow> rows = residual_rows(problem);
  const ModePairs pairs = pair_features(problem.features, plain, plain.sensors);
  for (std::size_t m = 0; m < problem.features.modes.size(); ++m) {
    const ShapeRows shape = shape_rows(rows, int(m));
    if (shape.count() == 0) continue;
    Eigen::MatrixXd covariance = Eigen::MatrixXd::Zero(shape.count(), shape.count());
    for (std::size_t i = shape.begin; i < shape.end; ++i)
      covariance.diagonal()[Eigen::Index(i - shape.begin)] = rows[i].std * rows[i].std;
    const double lambda = std::pow(2.0 * EIGEN_PI * problem.features.modes[m].frequency, 2);
    const int own = pairs.computed[m];
    const double unit = own >= 0 ? seen(rows, shape, plain.sensors.col(own)).cwiseAbs().maxCoeff()
                                 : plain.sensors.cwiseAbs().maxCoeff();
    const Eigen::VectorXd eigenvalues = measured_eigenvalues(problem.features, plain, pairs);
    for (Eigen::Index j = 0; j < plain.eigenvalues.size(); ++j) {
      if (int(j) == own) continue;
      // First order: φᵢ' = Σ φⱼ (φⱼᵀ K' φᵢ)/(λᵢ − λⱼ), of which φⱼᵀ K' φᵢ is a share of √(λᵢ λⱼ).
      const double other = eigenvalues[j], apart = std::abs(other - lambda) / std::sqrt(other * lambda);
      const double share = std::min(1.0, problem.error.mixing / std::max(apart, 1e-6));
      const Eigen::VectorXd neighbour = share / unit * seen(rows, shape, plain.sensors.col(j));
      covariance += neighbour * neighbour.transpose();
      // Neighbours that dampers couple add to the imaginary part; half as much is the most that is usual.
      problem.quadrature_mixing[m] += (0.5 * share / unit * plain.sensors.col(j)).cwiseAbs2();
      if (plain.participation.size() > 0)
        problem.participation_mixing[m] += (share * unit * plain.participation.col(j)).cwiseAbs2();
    }
    problem.quadrature_mixing[m] = problem.quadrature_mixing[m].cwiseSqrt();
    problem.participation_mixing[m] = problem.participation_mixing[m].cwiseSqrt();
    problem.whitening[m] = whitening_of(covariance);
  }
}

namespace {

/// What follows a shape that is `stretch` times a computed mode, both with their largest measured component 1.
void add_phases(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows, int m, int computed,
                double stretch, const Observed& seen, Eigen::VectorXd& r) {
  const MeasuredFeature& mode = problem.features.modes[std::size_t(m)];
  const double scale = largest(mode.shape), omega = 2.0 * EIGEN_PI * mode.frequency;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const ResidualRow& row = rows[i];
    if (row.mode != m) continue;
    double measured = 0.0, said = 0.0;
    if (row.kind == ResidualRow::Kind::quadrature) {
      measured = mode.quadrature[row.sensor] / scale;
      if (computed >= 0)
        said = -stretch * seen.readings(row.sensor, computed) * std::sin(omega * seen.delays[row.sensor]);
    } else if (row.kind == ResidualRow::Kind::participation || row.kind == ResidualRow::Kind::lag) {
      const std::complex<double> given = scale * mode.participation[row.sensor];
      const std::complex<double> model =
          computed < 0 || stretch == 0.0 ? 0.0 : seen.participation(row.sensor, computed) / stretch;
      const bool real = row.kind == ResidualRow::Kind::participation;
      measured = real ? given.real() : given.imag();
      said = real ? model.real() : model.imag();
    } else {
      continue;
    }
    r[Eigen::Index(i)] = (measured - said) / row.std;
  }
}

/// The part of a late clock's readings that is in phase with the mode.
Eigen::VectorXd in_phase(const Observed& seen, int computed, double frequency) {
  const Eigen::VectorXd turn = 2.0 * EIGEN_PI * frequency * seen.delays;
  return seen.readings.col(computed).array() * turn.array().cos();
}

}  // namespace

Eigen::VectorXd residuals(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows,
                          const ModePairs& pairing, const Observed& observed) {
  constexpr double unpaired = 5.0;  // a mode that the model does not have
  Eigen::VectorXd r = Eigen::VectorXd::Zero(Eigen::Index(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const MeasuredFeature& mode = problem.features.modes[std::size_t(rows[i].mode)];
    const int c = pairing.computed[std::size_t(rows[i].mode)];
    if (rows[i].kind == ResidualRow::Kind::damping)
      r[Eigen::Index(i)] = (std::log(*mode.damping) - std::log(observed.damping)) / rows[i].std;
    else if (rows[i].kind == ResidualRow::Kind::frequency)
      r[Eigen::Index(i)] = c < 0 ? unpaired : (std::log(mode.frequency) - observed.log_frequency[c]) / rows[i].std;
  }
  for (std::size_t m = 0; m < problem.whitening.size(); ++m) {
    const ShapeRows shape = shape_rows(rows, int(m));
    if (shape.count() == 0) continue;
    const Eigen::MatrixXd& white = problem.whitening[m];
    const MeasuredFeature& mode = problem.features.modes[m];
    const Eigen::VectorXd measured = white * seen(rows, shape, mode.shape) / largest(mode.shape);
    r.segment(Eigen::Index(shape.begin), shape.count()) = measured;
    const int c = pairing.computed[m];
    double stretch = 0.0;
    if (c >= 0) {
      const Eigen::VectorXd computed = white * seen(rows, shape, in_phase(observed, c, mode.frequency));
      stretch = measured.dot(computed) / std::max(computed.squaredNorm(), 1e-300);  // what fits best
      r.segment(Eigen::Index(shape.begin), shape.count()) -= stretch * computed;
    }
    add_phases(problem, rows, int(m), c, stretch, observed, r);
  }
  return r;
}

}  // namespace voussoir
