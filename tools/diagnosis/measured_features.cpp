#include "tools/diagnosis/measured_features.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "solver/base/counted.h"

namespace voussoir {

namespace {

constexpr double default_period_std = 0.01;  // share, where a measurement gives none
constexpr double default_shape_std = 0.05;   // share of the largest component
constexpr double default_damping_std = 0.3;  // share

}  // namespace

MeasuredFeature feature_of(const MeasuredMode& mode, std::size_t sensors) {
  MeasuredFeature f;
  f.name = mode.name;
  f.frequency = 1.0 / mode.period;
  f.frequency_std = mode.period_std > 0.0 ? mode.period_std / mode.period : default_period_std;
  f.direction = mode.direction;
  if (mode.damping && *mode.damping > 0.0) {
    f.damping = mode.damping;
    f.damping_std = mode.damping_std > 0.0 ? mode.damping_std / *mode.damping : default_damping_std;
  }
  if (mode.shape.empty()) return f;
  f.participation = mode.participation;
  f.participation_std = mode.participation_std;
  if (mode.phases) f.quadrature = Eigen::VectorXd::Constant(Eigen::Index(sensors), std::nan(""));
  f.shape = Eigen::VectorXd::Constant(Eigen::Index(sensors), std::nan(""));
  f.shape_std = Eigen::VectorXd::Zero(Eigen::Index(sensors));
  double largest = 0.0;
  for (const MeasuredValue& v : mode.shape) largest = std::max(largest, std::abs(v.value));
  for (const MeasuredValue& v : mode.shape) {
    f.shape[Eigen::Index(v.sensor)] = v.value;
    if (mode.phases) f.quadrature[Eigen::Index(v.sensor)] = v.quadrature;
    f.shape_std[Eigen::Index(v.sensor)] = v.std > 0.0 ? v.std : default_shape_std * largest;
  }
  return f;
}

Features features_of(const Measured& measured, const Assembly& assembly) {
  Features features;
  const std::vector<std::int64_t> blocks = place_sensors(measured, assembly);
  for (std::size_t i = 0; i < measured.sensors.size(); ++i)
    features.sensors.push_back(
        {measured.sensors[i].id, measured.sensors[i].position, measured.sensors[i].direction, blocks[i]});
  for (const MeasuredMode& mode : measured.modes) features.modes.push_back(feature_of(mode, measured.sensors.size()));
  std::stable_sort(features.modes.begin(), features.modes.end(),
                   [](const auto& a, const auto& b) { return a.frequency < b.frequency; });
  return features;
}

std::vector<MeasuredMode> expected_modes(const Response& r, int most, const Precision& precision) {
  std::vector<MeasuredMode> modes;
  for (std::size_t i = 0; i < r.words.size() && int(modes.size()) < most; ++i) {
    if (r.words[i].direction == "local" || r.words[i].order == 0) continue;
    MeasuredMode mode;
    mode.name = fmt::format("{}", modes.size() + 1);
    mode.period = std::exp(-r.log_frequency[Eigen::Index(i)]);
    mode.period_std = precision.periods * mode.period;
    mode.direction = r.words[i].direction;
    mode.damping = precision.damping_ratio;
    mode.damping_std = 0.1 * precision.damping_ratio;
    const Eigen::VectorXd seen = r.sensors.col(Eigen::Index(i));
    const double largest = seen.isZero(0.0) ? 1.0 : seen.cwiseAbs().maxCoeff();
    for (Eigen::Index s = 0; s < seen.size(); ++s)
      mode.shape.push_back({std::size_t(s), seen[s] / largest, precision.shapes});
    modes.push_back(mode);
  }
  return modes;
}

std::string sensors_used(const Features& features) {
  std::vector<bool> used(features.sensors.size());
  for (const MeasuredFeature& mode : features.modes)
    for (Eigen::Index s = 0; s < mode.shape.size(); ++s)
      if (std::isfinite(mode.shape[s])) used[std::size_t(s)] = true;
  const auto count = std::size_t(std::count(used.begin(), used.end(), true)), all = used.size();
  const std::string sensors = counted(all, "sensor");
  return count == all ? sensors : fmt::format("{} of {}", count, sensors);
}

}  // namespace voussoir
