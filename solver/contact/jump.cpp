#include "solver/contact/jump.h"

namespace voussoir {

Jump<double> tie_jump(const Patch& patch, const Triple<double>& move_a, const Triple<double>& move_b) {
  const Vec3 from = Vec3(patch.place) + Vec3(move_a.x, move_a.y, move_a.z);
  const Vec3 way = Vec3(patch.shift) + Vec3(move_b.x - move_a.x, move_b.y - move_a.y, move_b.z - move_a.z);
  const Eigen::Quaterniond turn = Eigen::Quaterniond::FromTwoVectors(Vec3(patch.shift), way);
  Jump<double> j{};
  j.n = patch.length - way.norm();
  j.cosine = 1.0;
  j.share = 0.125;
  j.axes = axes_of(Quat<double>{turn.w(), {turn.x(), turn.y(), turn.z()}} * quat(patch.e_a), 2.0);
  j.place = {from.x() + 0.5 * way.x(), from.y() + 0.5 * way.y(), from.z() + 0.5 * way.z()};
  return j;
}

}  // namespace voussoir
