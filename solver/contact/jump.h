// The displacement jump of a patch from the present placements of its two bodies: exact at any rotation, no
// trigonometry.
//
//   δ(r) = δc + θ' × Q r,  θ' = 2 vec(q_b q_a⁻¹),  Q = (q_a + q_b)/|q_a + q_b|
//
// because with P the rotation of b relative to a, R_b − R_a = P^½ Q − P^−½ Q = 2 sin(φ/2) [axis]× Q. Tractions act
// midway between the two material points: r_mid = H Q r, H = cos(φ/2) 1 + θ'θ'ᵀ/(4(1 + cos(φ/2)))
// (docs/theory/joints.md).
#pragma once
#include "solver/model/state.h"

namespace voussoir {

/// Jump of a patch in its own turning axes (n, s, t), m and rad (twice the sine of half the angle).
template <class T>
struct Jump {
  T n, s, t;        // δc
  T rn, rs, rt;     // θ'
  T cosine;         // of half the relative rotation
  T share;          // 1/(4 (1 + cosine))
  Quat<T> frame;    // local axes → world
  Triple<T> place;  // midway between the two material points at the patch's centroid, m
};

/// `relative` = q_b q_a⁻¹ of the frames in the hemisphere w ≥ 0, `norm` = 1/|q_a + q_b|, `frame` the normalised
/// half-way rotation times the local axes.
template <class T>
[[gnu::always_inline]] inline Jump<T> local_jump(const Triple<T>& move_a, const Triple<T>& move_b,
                                                 const Triple<T>& place, const Triple<T>& shift,
                                                 const Quat<T>& relative, T norm, const Quat<T>& frame) {
  Jump<T> j;
  const Triple<T> d = turn_back(frame, shift + (move_b - move_a));
  const Triple<T> r = turn_back(frame, relative.v);
  j.n = d.x, j.s = d.y, j.t = d.z;
  j.rn = 2.0 * r.x, j.rs = 2.0 * r.y, j.rt = 2.0 * r.z;
  j.cosine = relative.w;
  j.share = 0.5 * norm * norm;  // |q_a + q_b|² = 2 (1 + cosine)
  j.frame = frame;
  const Triple<T> sum = shift + (move_a + move_b);
  j.place = {place.x + 0.5 * sum.x, place.y + 0.5 * sum.y, place.z + 0.5 * sum.z};
  return j;
}

/// Force and moment about the world's origin that the patch puts on body a (b gets the opposite).
struct Wrench {
  double f[3], m[3];
};

inline Quat<double> pose_rotation(const double* pose) {
  return {pose[3], {pose[4], pose[5], pose[6]}};
}
inline Triple<double> pose_displacement(const double* pose) {
  return {pose[0], pose[1], pose[2]};
}
inline Triple<double> triple(const double* x) {
  return {x[0], x[1], x[2]};
}
inline Quat<double> quat(const double* q) {
  return {q[0], {q[1], q[2], q[3]}};
}
inline Quat<double> conjugate(const Quat<double>& q) {
  return {q.w, {-q.v.x, -q.v.y, -q.v.z}};
}

/// The jump of a tie: a bar of length L, hinged at its anchors a and b, with s, t and rotations zero and n the negative
/// of its stretch, n = L − |x_b − x_a|, along the axis from b to a. So it is pressed when it pulls.
Jump<double> tie_jump(const Patch& patch, const Triple<double>& move_a, const Triple<double>& move_b);

/// The jump of any patch, from its bodies' poses.
inline Jump<double> patch_jump(const Patch& patch, const double* pose_a, const double* pose_b) {
  const Quat<double> qa = pose_rotation(pose_a), qb = pose_rotation(pose_b);
  const Quat<double> fa = qa * quat(patch.e_a);
  Quat<double> fb = qb * quat(patch.e_b);
  if (fa.w * fb.w + dot(fa.v, fb.v) < 0.0) fb = {-fb.w, {-fb.v.x, -fb.v.y, -fb.v.z}};
  const Quat<double> relative = fb * conjugate(fa);
  const double norm = 1.0 / std::sqrt(2.0 + 2.0 * relative.w);
  const Quat<double> frame = {norm * (fa.w + fb.w), norm * (fa.v + fb.v)};
  const Triple<double> arm_a = triple(patch.arm_a), arm_b = triple(patch.arm_b);
  const Triple<double> move_a = pose_displacement(pose_a) + turn_change(qa, arm_a);
  const Triple<double> move_b = pose_displacement(pose_b) + turn_change(qb, arm_b);
  if (patch.length > 0.0) return tie_jump(patch, move_a, move_b);
  Jump<double> j = local_jump(move_a, move_b, triple(patch.place), triple(patch.shift), relative, norm, frame);
  return j;
}

/// Jump of the patch's material at a point of it, gap included: n, s, t.
inline Triple<double> point_jump(const Patch& patch, const Jump<double>& j, double s, double t) {
  const double rs = j.rs + patch.gap[1], rt = j.rt + patch.gap[2];
  return {j.n + patch.gap[0] + rs * t - rt * s, j.s - j.rn * t, j.t + j.rn * s};
}

/// The same less the plastic jump of point i.
inline Triple<double> elastic_jump(const Patch& patch, const Jump<double>& j, const PatchPoint& at,
                                   const PatchMemory& memory, int i) {
  const Triple<double> u = point_jump(patch, j, at.s, at.t);
  return {u.x - memory.point_rest[point_index(patch, i, 2, 0)], u.y - memory.point[point_index(patch, i, 2, 0)],
          u.z - memory.point[point_index(patch, i, 2, 1)]};
}

}  // namespace voussoir
