#include "tools/hide/recordings.h"

#include <algorithm>
#include <cmath>

#include "solver/effects/parts.h"
#include "solver/motion/synthesis.h"
#include "solver/step/stepper.h"

namespace voussoir {

namespace {

/// A support whose motion differs from the recorded ground motion.
struct MovedSupport {
  std::size_t support = 0;  // of supports()
  double factor = 1.0, delay = 0.0;
};
std::vector<MovedSupport> moved_supports(const Assembly& assembly, const HideRequest& request) {
  std::vector<MovedSupport> all;
  const std::vector<std::string> places = supports(assembly);
  for (const EffectSetting& e : request.effects)
    if (e.name == "support_motion") {
      const auto at = std::find(places.begin(), places.end(), e.where);
      all.push_back({std::size_t(at - places.begin()), e.values.at("factor"), e.values.at("delay")});
    }
  return all;
}

/// Difference between the motion of a support and that of the ground at a time, m/s2.
Vec3 astray(const GroundMotion& ground, const MovedSupport& moved, double time) {
  return moved.factor * base_acceleration(&ground, time - moved.delay) - base_acceleration(&ground, time);
}

/// Relative acceleration z̈ of an oscillator z̈ + 2ζω ż + ω² z = −a at the samples of a; within a step a is its mean.
Eigen::VectorXd relative_acceleration(const Eigen::VectorXd& a, double dt, double w, double ratio) {
  const double wd = w * std::sqrt(1.0 - ratio * ratio), e = std::exp(-ratio * w * dt);
  const double c = std::cos(wd * dt), s = std::sin(wd * dt);
  double z = 0.0, v = 0.0;
  Eigen::VectorXd result(a.size());
  for (Eigen::Index i = 0; i < a.size(); ++i) {
    result[i] = -a[i] - 2.0 * ratio * w * v - w * w * z;
    const double rest = -0.5 * (a[i] + a[std::min(i + 1, a.size() - 1)]) / (w * w);
    const double x = z - rest, b = (v + ratio * w * x) / wd;
    z = rest + e * (x * c + b * s);
    v = -ratio * w * (z - rest) + e * wd * (b * c - x * s);
  }
  return result;
}

/// Noise of the channel of each sensor: five times the share of the request of its signal. A dead channel has the
/// noise of the quietest live channel.
void add_channel_noise(Recording& record, const std::vector<Sensor>& sensors, const HideRequest& request) {
  std::vector<double> sizes;
  double quietest = 1e300;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    sizes.push_back(std::sqrt(record.values.col(Eigen::Index(s)).squaredNorm() / double(record.values.rows())));
    if (sizes.back() > 0.0) quietest = std::min(quietest, sizes.back());
  }
  if (quietest == 1e300) quietest = 1.0;
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    const double size = 5.0 * request.noise * (sizes[s] > 0.0 ? sizes[s] : quietest);
    RandomStream random = stream_of(request, "noise of channel " + sensors[s].id);
    for (Eigen::Index i = 0; i < record.values.rows(); ++i) record.values(i, Eigen::Index(s)) += size * random.normal();
  }
}

}  // namespace

Recording ambient(const Response& r, const std::vector<Sensor>& sensors, const HideRequest& request, double ratio) {
  constexpr double dt = 0.01;  // s
  Recording record;
  record.name = "ambient";
  record.dt = dt;
  const auto samples = Eigen::Index(std::lround(60.0 * request.minutes / dt));
  record.values = Eigen::MatrixXd::Zero(samples, r.sensors.rows());
  for (Eigen::Index mode = 0; mode < r.eigenvalues.size(); ++mode) {
    const double w = std::sqrt(r.eigenvalues[mode]), wd = w * std::sqrt(1.0 - ratio * ratio);
    const double e = std::exp(-ratio * w * dt), c = std::cos(wd * dt), s = std::sin(wd * dt);
    RandomStream random = stream_of(request, "excitation", int(mode));
    double q = 0.0, v = 0.0;
    for (Eigen::Index i = 0; i < samples; ++i) {
      const double force = random.normal(), rest = force / (w * w);
      record.values.row(i) += (force - 2.0 * ratio * w * v - w * w * q) * r.sensors.col(mode).transpose();
      // Free vibration about the static displacement: x = e^(−ζωt) (x₀ cos ω_d t + b sin ω_d t).
      const double x = q - rest, b = (v + ratio * w * x) / wd;
      q = rest + e * (x * c + b * s);
      v = -ratio * w * (q - rest) + e * wd * (b * c - x * s);
    }
  }
  add_channel_noise(record, sensors, request);
  record.values *= 1e-3 / std::max(record.values.cwiseAbs().maxCoeff(), 1e-300);  // m/s2
  return record;
}

Recording earthquake(const Assembly& assembly, const LinearModel& model, const Response& r, const EigenMemory& memory,
                     const std::vector<Sensor>& sensors, const HideRequest& request, double ratio) {
  SyntheticSettings synthetic;
  synthetic.seed = request.seed;
  synthetic.peak = 0.5;
  synthetic.duration = request.shaken;
  synthetic.axes = {true, true, true};
  synthetic.frequency = 5.0;
  synthetic.bandwidth = 0.9;
  const GroundMotion ground = synthesize(synthetic);
  const auto samples = Eigen::Index(ground.acceleration.size()), count = r.eigenvalues.size();
  Recording record;
  record.name = "earthquake";
  record.dt = ground.dt;
  record.values = Eigen::MatrixXd::Zero(samples, Eigen::Index(sensors.size()) + 3);
  Eigen::MatrixXd drive = Eigen::MatrixXd::Zero(samples, count);  // of each mode
  for (Eigen::Index i = 0; i < samples; ++i) {
    const Vec3& a = ground.acceleration[std::size_t(i)];
    for (std::size_t s = 0; s < sensors.size(); ++s) record.values(i, Eigen::Index(s)) = sensors[s].direction.dot(a);
    record.values.row(i).tail<3>() = a.transpose();
    drive.row(i) = a.transpose() * r.participation;
  }
  for (const MovedSupport& moved : moved_supports(assembly, request)) {
    const Eigen::MatrixXd follow = follow_support(assembly, r, model, moved.support, sensors, memory);
    for (Eigen::Index i = 0; i < samples; ++i) {
      const Vec3 more = astray(ground, moved, double(i) * ground.dt);
      record.values.row(i).head(follow.rows()) += (follow * more).transpose();
      drive.row(i) += more.transpose() * r.at_support[moved.support];
    }
  }
  for (Eigen::Index m = 0; m < count; ++m)
    record.values.leftCols(r.sensors.rows()) +=
        relative_acceleration(drive.col(m), ground.dt, std::sqrt(r.eigenvalues[m]), ratio) *
        r.sensors.col(m).transpose();
  add_channel_noise(record, sensors, request);
  return record;
}

void set_clocks(const HideRequest& request, const std::vector<MeasuredSensor>& sensors, Recording& record) {
  for (const EffectSetting& e : request.effects) {
    if (e.name != "sensor_fault" || e.values.at("delay") == 0.0) continue;
    for (std::size_t s = 0; s < sensors.size(); ++s) {
      if (e.where != "channel " + sensors[s].id) continue;
      const Eigen::VectorXd y = record.values.col(Eigen::Index(s));
      const auto sample = [&](Eigen::Index i) { return y[std::clamp<Eigen::Index>(i, 0, y.size() - 1)]; };
      for (Eigen::Index i = 0; i < y.size(); ++i) {
        const double at = double(i) - e.values.at("delay") / record.dt, t = at - std::floor(at);
        const auto k = Eigen::Index(std::floor(at));
        const double a = sample(k - 1), b = sample(k), c = sample(k + 1), d = sample(k + 2);
        record.values(i, Eigen::Index(s)) =
            b + 0.5 * t * (c - a + t * (2.0 * a - 5.0 * b + 4.0 * c - d + t * (3.0 * (b - c) + d - a)));
      }
    }
  }
}

}  // namespace voussoir
