#include "solver/motion/ground_path.h"

#include <algorithm>

namespace voussoir {

// Between samples the acceleration is a(s) = a₀ + (a₁ − a₀) s/h, 0 <= s <= h. Integrated once and twice from v₀, u₀:
//   v(s) = v₀ + a₀ s + (a₁ − a₀) s²/(2h)
//   u(s) = u₀ + v₀ s + a₀ s²/2 + (a₁ − a₀) s³/(6h)
// At s = h: v₁ = v₀ + h (a₀ + a₁)/2 and u₁ = u₀ + v₀ h + h² (2 a₀ + a₁)/6.

GroundPath ground_path(const GroundMotion& motion) {
  GroundPath path;
  path.motion = motion;
  const std::vector<Vec3>& a = motion.acceleration;
  const double h = motion.dt;
  path.velocity.assign(a.size(), Vec3::Zero());
  path.at_sample.assign(a.size(), Vec3::Zero());
  for (std::size_t i = 1; i < a.size(); ++i) {
    path.velocity[i] = path.velocity[i - 1] + 0.5 * h * (a[i - 1] + a[i]);
    path.at_sample[i] = path.at_sample[i - 1] + h * path.velocity[i - 1] + h * h / 6.0 * (2.0 * a[i - 1] + a[i]);
  }
  return path;
}

Vec3 GroundPath::displacement(double t) const {
  const std::vector<Vec3>& a = motion.acceleration;
  if (a.size() < 2 || t <= 0.0) return Vec3::Zero();
  const double h = motion.dt;
  const double last = double(a.size() - 1);
  if (t / h >= last) return at_sample.back() + (t - motion.duration()) * velocity.back();
  const auto i = std::size_t(t / h);
  const double s = t - double(i) * h;
  return at_sample[i] + s * velocity[i] + 0.5 * s * s * a[i] + s * s * s / (6.0 * h) * (a[i + 1] - a[i]);
}

}  // namespace voussoir
