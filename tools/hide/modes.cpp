#include "tools/hide/modes.h"

#include <fmt/format.h>

#include <cmath>

#include "solver/diagnosis/fit.h"
#include "tools/diagnosis/measured_features.h"

namespace voussoir {

std::vector<MeasuredMode> true_modes(const Response& r, const HideRequest& request, double ratio) {
  return expected_modes(r, request.modes,
                        {request.noise, 2.0 * request.noise, ratio});  // shapes have twice the standard deviation
}

std::vector<MeasuredMode> measured_modes(const Response& truth, const std::vector<Sensor>& sensors,
                                         const HideRequest& request, double ratio) {
  std::vector<MeasuredMode> modes = true_modes(truth, request, ratio);
  for (std::size_t i = 0; i < modes.size(); ++i) {
    MeasuredMode& mode = modes[i];
    mode.period *= 1.0 + request.noise * stream_of(request, "period", int(i)).normal();
    mode.period_std = request.noise_said * request.noise * mode.period;
    mode.damping = std::min(0.5, ratio * std::exp(0.1 * stream_of(request, "damping", int(i)).normal()));
    mode.damping_std = request.noise_said * 0.1 * *mode.damping;
    for (MeasuredValue& v : mode.shape) {
      v.value += v.std * stream_of(request, "shape at " + sensors[v.sensor].id, int(i)).normal();
      v.std *= request.noise_said;
    }
  }
  return modes;
}

double trace_of(const Assembly& bare, const Response& truth, const std::vector<Sensor>& sensors,
                const HideRequest& request, double ratio, double bare_ratio) {
  DiagnosisProblem problem;
  problem.base = bare;
  problem.features.sensors = sensors;
  for (const MeasuredMode& mode : true_modes(truth, request, ratio))
    problem.features.modes.push_back(feature_of(mode, sensors.size()));
  problem.damping = bare_ratio;
  problem.modes = int(problem.features.modes.size()) + 8;
  problem.error.shape = 0.01;  // as in diagnose without the error of its mesh
  set_covariance(problem);
  const Hypothesis materials = {calibrations(bare), {}};
  return fit(problem, materials, Eigen::VectorXd::Zero(Eigen::Index(materials.size())), 8).misfit;
}

}  // namespace voussoir
