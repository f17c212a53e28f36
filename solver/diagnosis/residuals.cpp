// Rows of residuals, and which computed mode is which measured one.
#include <algorithm>
#include <cmath>
#include <complex>
#include <limits>

#include "solver/diagnosis/assignment.h"
#include "solver/diagnosis/rows.h"

namespace voussoir {

namespace {

int measured_entries(const MeasuredFeature& mode) {
  return int(std::count_if(mode.shape.begin(), mode.shape.end(), [](double v) { return std::isfinite(v); }));
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
    rows.push_back(
        {ResidualRow::Kind::quadrature, m, int(s), std::hypot(mode.shape_std[s] / scale, problem.error.quadrature)});
  }
}

void add_participation(const DiagnosisProblem& problem, int m, double scale, std::vector<ResidualRow>& rows) {
  const MeasuredFeature& mode = problem.features.modes[std::size_t(m)];
  double most = 0.0;
  for (const std::complex<double>& p : mode.participation)
    if (std::isfinite(p.real())) most = std::max(most, scale * std::abs(p));
  for (int axis = 0; axis < 3; ++axis) {
    if (!std::isfinite(mode.participation[axis].real())) continue;
    const double std = std::hypot(scale * mode.participation_std[axis], problem.error.participation * most);
    rows.push_back({ResidualRow::Kind::participation, m, axis, std});
    rows.push_back({ResidualRow::Kind::lag, m, axis, std});
  }
}

}  // namespace

bool has_shape(const MeasuredFeature& mode) {
  return measured_entries(mode) >= 3;
}

double unit_of(const MeasuredFeature& mode) {
  if (mode.unit > 0.0) return mode.unit;
  double most = 0.0;
  for (double v : mode.shape)
    if (std::isfinite(v)) most = std::max(most, std::abs(v));
  return most;
}

std::vector<ResidualRow> residual_rows(const DiagnosisProblem& problem) {
  std::vector<ResidualRow> rows;
  for (std::size_t m = 0; m < problem.features.modes.size(); ++m) {
    const MeasuredFeature& mode = problem.features.modes[m];
    const int at = int(m);
    rows.push_back({ResidualRow::Kind::frequency, at, 0, std::hypot(mode.frequency_std, problem.error.frequency)});
    if (mode.damping && problem.damping > 0.0)
      rows.push_back({ResidualRow::Kind::damping, at, 0, std::hypot(mode.damping_std, problem.error.damping)});
    if (!has_shape(mode)) continue;
    const double scale = unit_of(mode);
    for (Eigen::Index s = 0; s < mode.shape.size(); ++s)
      if (std::isfinite(mode.shape[s]))
        rows.push_back(
            {ResidualRow::Kind::shape, at, int(s), std::hypot(mode.shape_std[s] / scale, problem.error.shape)});
    add_quadrature(problem, at, scale, rows);
    add_participation(problem, at, scale, rows);
  }
  return rows;
}

RowSplit split_rows(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows) {
  RowSplit split;
  for (std::size_t i = 0; i < rows.size(); ++i)
    (problem.features.modes[std::size_t(rows[i].mode)].held_back ? split.held : split.fitted).push_back(int(i));
  return split;
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

/// What follows a shape that is `stretch` times a computed mode, both with their largest measured component 1.
void add_phases(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows, int m, int computed,
                double stretch, const Observed& seen, Eigen::VectorXd& r) {
  const MeasuredFeature& mode = problem.features.modes[std::size_t(m)];
  const double scale = unit_of(mode), omega = 2.0 * EIGEN_PI * mode.frequency;
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
    r[Eigen::Index(i)] = measured - said;
  }
}

/// By which a computed shape is nearest to the measured one, under the covariance of its rows where that is known.
double best_scale(const DiagnosisProblem& problem, std::size_t mode, const Eigen::VectorXd& measured,
                  const Eigen::VectorXd& computed) {
  const bool known = mode < problem.shape_metric.size() && problem.shape_metric[mode].size() > 0;
  const Eigen::VectorXd m = known ? Eigen::VectorXd(problem.shape_metric[mode] * measured) : measured;
  const Eigen::VectorXd c = known ? Eigen::VectorXd(problem.shape_metric[mode] * computed) : computed;
  return m.dot(c) / std::max(c.squaredNorm(), 1e-300);
}

/// The part of a late clock's readings that is in phase with the mode.
Eigen::VectorXd in_phase(const Observed& seen, int computed, double frequency) {
  const Eigen::VectorXd turn = 2.0 * EIGEN_PI * frequency * seen.delays;
  return seen.readings.col(computed).array() * turn.array().cos();
}

}  // namespace

Question question_of(const DiagnosisProblem& problem, const Response& response) {
  Question q = {problem.features.sensors, problem.modes, int(problem.features.modes.size()), problem.features.driven()};
  for (const int c : pair_features(problem.features, response, response.sensors).computed)
    q.wanted = std::max(q.wanted, c + 1);
  q.wanted = std::min(q.wanted + 2, q.modes);
  return q;
}

ModalData along(const ModalData& modes, const ModalData& d, double step) {
  ModalData moved = modes;
  moved.log_frequency += step * d.log_frequency;
  moved.sensors += step * d.sensors;
  if (d.motions.size() > 0) moved.motions += step * d.motions;
  if (d.participation.size() > 0) moved.participation += step * d.participation;
  for (std::size_t k = 0; k < d.at_support.size(); ++k) moved.at_support[k] += step * d.at_support[k];
  return moved;
}

Eigen::VectorXd differences(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows,
                            const ModePairs& pairing, const Observed& observed) {
  constexpr double unpaired = 5.0;  // standard deviations of the frequency of a mode that the model does not have
  Eigen::VectorXd r = Eigen::VectorXd::Zero(Eigen::Index(rows.size()));
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const auto at = Eigen::Index(i);
    const MeasuredFeature& mode = problem.features.modes[std::size_t(rows[i].mode)];
    const int c = pairing.computed[std::size_t(rows[i].mode)];
    const double std = at < problem.covariance.std.size() ? problem.covariance.std[at] : rows[i].std;
    if (rows[i].kind == ResidualRow::Kind::damping)
      r[at] = std::log(*mode.damping) - std::log(observed.damping);
    else if (rows[i].kind == ResidualRow::Kind::frequency)
      r[at] = c < 0 ? unpaired * std : std::log(mode.frequency) - observed.log_frequency[c];
  }
  for (std::size_t m = 0; m < problem.features.modes.size(); ++m) {
    const RowRange range = rows_of(rows, int(m), ResidualRow::Kind::shape);
    if (range.count() == 0) continue;
    const MeasuredFeature& mode = problem.features.modes[m];
    const Eigen::VectorXd measured = seen(rows, range, mode.shape) / unit_of(mode);
    r.segment(range.at(), range.count()) = measured;
    const int c = pairing.computed[m];
    double stretch = 0.0;
    if (c >= 0) {
      const Eigen::VectorXd computed = seen(rows, range, in_phase(observed, c, mode.frequency));
      stretch = best_scale(problem, m, measured, computed);
      r.segment(range.at(), range.count()) -= stretch * computed;
    }
    add_phases(problem, rows, int(m), c, stretch, observed, r);
  }
  return r;
}

Eigen::VectorXd residuals(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows,
                          const ModePairs& pairing, const Observed& observed) {
  return problem.whitening * differences(problem, rows, pairing, observed);
}

}  // namespace voussoir
