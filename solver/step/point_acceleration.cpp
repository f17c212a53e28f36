#include "solver/step/point_acceleration.h"

namespace voussoir {

Vec3 point_acceleration(const BodyPass& pass, std::int64_t block, const Vec3& position) {
  const auto body = std::size_t(pass.model->body_of_block[std::size_t(block)]);
  const Body& b = pass.model->bodies[body];
  const double* pose = &pass.state->pose[pose_width * body];
  const double* motion = &pass.state->motion[motion_width * body];
  const BodyUpdate next = pass.update(body);
  const Vec3 velocity(motion[0], motion[1], motion[2]), momentum(motion[3], motion[4], motion[5]);
  const Vec3 velocity_next(next.velocity.x, next.velocity.y, next.velocity.z);
  const Vec3 momentum_next(next.momentum.x, next.momentum.y, next.momentum.z);
  const Eigen::Quaterniond q(pose[3], pose[4], pose[5], pose[6]);
  const auto spin = [&](const Vec3& l) { return Vec3(q * (b.inverse_inertia * (q.conjugate() * l))); };
  // ω = R I⁻¹ Rᵀ L, so dω/dt = R I⁻¹ Rᵀ (dL/dt − ω × L): Euler's equations in world axes (Goldstein 1980, § 5-5).
  const Vec3 mean = 0.5 * (momentum + momentum_next), omega = spin(mean);
  const Vec3 alpha = spin((momentum_next - momentum) / pass.dt - omega.cross(mean));
  const Vec3 arm = q * (position - b.centroid);
  return (velocity_next - velocity) / pass.dt + alpha.cross(arm) + omega.cross(omega.cross(arm));
}

}  // namespace voussoir
