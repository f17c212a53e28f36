// Rows of residuals, and which computed mode is which measured one.
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/diagnosis/assignment.h"
#include "solver/diagnosis/fit.h"

namespace voussoir {

namespace {

/// How much of other modes a shape may hold because the model is not quite right: to first order δk/(2 ln(f₁/f₂)).
double mixing(const Features& features, std::size_t mode, double error) {
  double sum = 0.0;
  for (std::size_t other = 0; other < features.modes.size(); ++other) {
    if (other == mode) continue;
    const double apart = std::abs(std::log(features.modes[other].frequency / features.modes[mode].frequency));
    const double share = std::min(0.5, 0.5 * error / std::max(apart, 1e-6));
    sum += share * share;
  }
  return std::sqrt(sum);
}

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

}  // namespace

std::vector<ResidualRow> residual_rows(const DiagnosisProblem& problem) {
  // Errors of the model at neighbouring sensors are much the same: a shape is worth so many independent ones.
  constexpr double independent = 8.0;
  std::vector<ResidualRow> rows;
  for (std::size_t m = 0; m < problem.features.modes.size(); ++m) {
    const MeasuredFeature& mode = problem.features.modes[m];
    const int at = int(m);
    rows.push_back({ResidualRow::Kind::frequency, at, 0, std::hypot(mode.frequency_std, problem.error.frequency)});
    if (mode.damping && problem.damping > 0.0)
      rows.push_back({ResidualRow::Kind::damping, at, 0, std::hypot(mode.damping_std, problem.error.damping)});
    if (!has_shape(mode)) continue;
    const double mixed = mixing(problem.features, m, 2.0 * problem.error.frequency);
    const double crowd = std::max(1.0, measured_entries(mode) / independent);
    const double model = std::hypot(problem.error.shape, mixed) * std::sqrt(crowd), scale = largest(mode.shape);
    for (Eigen::Index s = 0; s < mode.shape.size(); ++s)
      if (std::isfinite(mode.shape[s]))
        rows.push_back({ResidualRow::Kind::shape, at, int(s), std::hypot(mode.shape_std[s] / scale, model)});
  }
  return rows;
}

ModePairs pair_features(const Features& features, const Response& response, const Eigen::MatrixXd& readings) {
  const std::size_t count = features.modes.size();
  ModePairs pairing;
  pairing.computed.assign(count, -1);
  pairing.assurance.assign(count, std::numeric_limits<double>::quiet_NaN());
  std::vector<std::size_t> shaped;
  std::map<std::string, int> seen;  // modes without shapes, by direction
  for (std::size_t m = 0; m < count; ++m) {
    const MeasuredFeature& mode = features.modes[m];
    if (has_shape(mode))
      shaped.push_back(m);
    else
      pairing.computed[m] = kth(response, mode.direction, seen[mode.direction]++);
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

Eigen::VectorXd residuals(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows,
                          const ModePairs& pairing, const Eigen::VectorXd& log_frequency,
                          const Eigen::MatrixXd& readings, double damping) {
  constexpr double unpaired = 5.0;  // a mode that the model does not have
  Eigen::VectorXd r = Eigen::VectorXd::Zero(Eigen::Index(rows.size()));
  for (std::size_t begin = 0, end = 0; begin < rows.size(); begin = end) {
    while (end < rows.size() && rows[end].mode == rows[begin].mode) ++end;
    const MeasuredFeature& mode = problem.features.modes[std::size_t(rows[begin].mode)];
    const int c = pairing.computed[std::size_t(rows[begin].mode)];
    const double scale = mode.shape.size() > 0 ? largest(mode.shape) : 1.0;
    double pc = 0.0, cc = 0.0;
    for (std::size_t i = begin; i < end && c >= 0; ++i) {
      if (rows[i].kind != ResidualRow::Kind::shape) continue;
      const double weight = 1.0 / (rows[i].std * rows[i].std), computed = readings(rows[i].sensor, c);
      pc += weight * mode.shape[rows[i].sensor] / scale * computed;
      cc += weight * computed * computed;
    }
    const double stretch = cc > 0.0 ? pc / cc : 0.0;  // the scale that fits best
    for (std::size_t i = begin; i < end; ++i) {
      double& value = r[Eigen::Index(i)];
      if (rows[i].kind == ResidualRow::Kind::damping)
        value = (std::log(*mode.damping) - std::log(damping)) / rows[i].std;
      else if (rows[i].kind == ResidualRow::Kind::frequency)
        value = c < 0 ? unpaired : (std::log(mode.frequency) - log_frequency[c]) / rows[i].std;
      else if (c >= 0)
        value = (mode.shape[rows[i].sensor] / scale - stretch * readings(rows[i].sensor, c)) / rows[i].std;
      else
        value = mode.shape[rows[i].sensor] / scale / rows[i].std;
    }
  }
  return r;
}

}  // namespace voussoir
