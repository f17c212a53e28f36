// The displacement jump of a patch from the present placements of its two bodies. It is exact for any rotation and
// needs no trigonometric functions.
//
//   δ(r) = δc + θ' × Q r,  θ' = 2 vec(q_b q_a⁻¹),  Q = (q_a + q_b)/|q_a + q_b|
//
// Here r is the position of a point relative to the centroid of the patch, δc the jump at the centroid, and q_a, q_b
// are the rotations of the bodies as unit quaternions. The formula holds because, with P the rotation of b relative to
// a and φ its angle, R_b − R_a = P^½ Q − P^−½ Q = 2 sin(φ/2) [axis]× Q. Tractions act midway between the two material
// points: r_mid = H Q r, H = cos(φ/2) 1 + θ'θ'ᵀ/(4(1 + cos(φ/2))) (docs/theory/joints.md).
#pragma once
#include "solver/model/state.h"

namespace voussoir {

/// Jump of a patch in its rotating axes (n, s, t), m and rad (twice the sine of half the angle).
template <class T>
struct Jump {
  T n, s, t;        // δc
  T rn, rs, rt;     // θ'
  T cosine;         // of half the relative rotation
  T share;          // 1/(4 (1 + cosine))
  Axes<T> axes;     // n, s, t in world axes
  Triple<T> place;  // midpoint between the two material points at the centroid of the patch, m
};

/// `way` (m) is the vector from the material point of a at the centroid to that of b, and `place` + ½ `moves` (m) is
/// the midpoint between both. `relative` = q_b q_a⁻¹ with w ≥ 0 and `sum` = q_a + q_b, where q_a and q_b rotate the
/// local axes of the patch to world axes.
template <class T>
[[gnu::always_inline]] inline Jump<T> local_jump(const Triple<T>& way, const Triple<T>& moves, const Triple<T>& place,
                                                 const Quat<T>& relative, const Quat<T>& sum) {
  Jump<T> j;
  const T by = 1.0 / (1.0 + relative.w);  // 2/|q_a + q_b|²
  j.axes = axes_of(sum, by);
  const Triple<T> d = turn_back(j.axes, way);
  const Triple<T> r = turn_back(j.axes, relative.v);
  j.n = d.x, j.s = d.y, j.t = d.z;
  j.rn = 2.0 * r.x, j.rs = 2.0 * r.y, j.rt = 2.0 * r.z;
  j.cosine = relative.w;
  j.share = 0.25 * by;
  j.place = {place.x + 0.5 * moves.x, place.y + 0.5 * moves.y, place.z + 0.5 * moves.z};
  return j;
}

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
/// of its stretch, n = L − |x_b − x_a|, along the axis from b to a. A tie in tension therefore counts as compressed.
Jump<double> tie_jump(const Patch& patch, const Triple<double>& move_a, const Triple<double>& move_b);

/// The jump since the joint was made, if its stones had moved before (docs/theory/construction.md).
inline Jump<double> since_built(const Patch& patch, Jump<double> j) {
  j.n -= patch.built[0], j.s -= patch.built[1], j.t -= patch.built[2];
  j.rn -= patch.built[3], j.rs -= patch.built[4], j.rt -= patch.built[5];
  return j;
}

/// The jump of any patch, from the poses of its bodies.
inline Jump<double> patch_jump(const Patch& patch, const double* pose_a, const double* pose_b) {
  const Quat<double> qa = pose_rotation(pose_a), qb = pose_rotation(pose_b);
  const Quat<double> fa = qa * quat(patch.e_a);
  Quat<double> fb = qb * quat(patch.e_b);
  if (fa.w * fb.w + dot(fa.v, fb.v) < 0.0) fb = {-fb.w, {-fb.v.x, -fb.v.y, -fb.v.z}};
  const Quat<double> relative = fb * conjugate(fa);
  const Triple<double> arm_a = triple(patch.arm_a), arm_b = triple(patch.arm_b);
  const Triple<double> move_a = pose_displacement(pose_a) + turn_change(qa, arm_a);
  const Triple<double> move_b = pose_displacement(pose_b) + turn_change(qb, arm_b);
  if (patch.length > 0.0) return since_built(patch, tie_jump(patch, move_a, move_b));
  const Quat<double> sum = {fa.w + fb.w, fa.v + fb.v};
  const Triple<double> shift = triple(patch.shift);
  return since_built(
      patch, local_jump(shift + (move_b - move_a), shift + (move_a + move_b), triple(patch.place), relative, sum));
}

/// The rotating axes n, s, t as columns.
inline Mat3 axes_matrix(const Jump<double>& j) {
  Mat3 m;
  m << j.axes.x.x, j.axes.y.x, j.axes.z.x, j.axes.x.y, j.axes.y.y, j.axes.z.y, j.axes.x.z, j.axes.y.z, j.axes.z.z;
  return m;
}

/// Jump at the point (s, t) of a patch, including its gap: n, s, t (m).
inline Triple<double> point_jump(const Patch& patch, const Jump<double>& j, double s, double t) {
  const double rs = j.rs + patch.gap[1], rt = j.rt + patch.gap[2];
  return {j.n + patch.gap[0] + rs * t - rt * s, j.s - j.rn * t, j.t + j.rn * s};
}

/// The same minus the plastic jump of point i.
inline Triple<double> elastic_jump(const Patch& patch, const Jump<double>& j, const PatchPoint& at,
                                   const PatchMemory& memory, int i) {
  const Triple<double> u = point_jump(patch, j, at.s, at.t);
  return {u.x - memory.point_rest[point_index(patch, i, 2, 0)], u.y - memory.point[point_index(patch, i, 2, 0)],
          u.z - memory.point[point_index(patch, i, 2, 1)]};
}

/// Remaining share of the stiffness of point i.
inline double kept_at(const LawConstants& law, const Patch& patch, const PatchMemory& memory, int i) {
  return memory.point_crush.empty() ? 1.0
                                    : kept_stiffness(law, patch.kn, memory.point_crush[point_index(patch, i, 3, 0)]);
}

}  // namespace voussoir
