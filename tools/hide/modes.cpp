#include "tools/hide/modes.h"

#include <fmt/format.h>

#include <cmath>

#include "solver/diagnosis/fit.h"
#include "tools/diagnosis/measured_features.h"

namespace voussoir {

std::vector<MeasuredMode> measured_modes(const Response& r, const HideRequest& request, double ratio, Noise& noise) {
  std::vector<MeasuredMode> modes;
  for (std::size_t i = 0; i < r.words.size() && int(modes.size()) < request.modes; ++i) {
    if (r.words[i].direction == "local" || r.words[i].order == 0) continue;
    MeasuredMode mode;
    mode.name = fmt::format("{}", modes.size() + 1);
    mode.period = std::exp(-r.log_frequency[Eigen::Index(i)]) * (1.0 + request.noise * noise.normal());
    mode.period_std = request.noise * mode.period;
    mode.direction = r.words[i].direction;
    mode.damping = std::min(0.5, ratio * std::exp(0.1 * noise.normal()));
    mode.damping_std = 0.1 * *mode.damping;
    const Eigen::VectorXd seen = r.sensors.col(Eigen::Index(i));
    const double largest = seen.size() > 0 ? seen.cwiseAbs().maxCoeff() : 0.0;
    const double spread = 2.0 * request.noise;  // shapes are known half as well as periods
    for (Eigen::Index s = 0; s < seen.size(); ++s)
      mode.shape.push_back({std::size_t(s), seen[s] / largest + spread * noise.normal(), spread});
    modes.push_back(mode);
  }
  return modes;
}

double trace_of(const Assembly& bare, const Response& truth, const std::vector<Sensor>& sensors,
                const HideRequest& request, double ratio, double bare_ratio) {
  Noise none(0, 0.0);
  DiagnosisProblem problem;
  problem.base = bare;
  problem.features.sensors = sensors;
  for (const MeasuredMode& mode : measured_modes(truth, request, ratio, none))
    problem.features.modes.push_back(feature_of(mode, sensors.size()));
  problem.damping = bare_ratio;
  problem.modes = int(problem.features.modes.size()) + 8;
  problem.error.shape = 0.01;  // as diagnose takes it without what its mesh does
  set_covariance(problem);
  const Hypothesis materials = {calibrations(bare), {}};
  return fit(problem, materials, Eigen::VectorXd::Zero(Eigen::Index(materials.size())), 8).misfit;
}

}  // namespace voussoir
