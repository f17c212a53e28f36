#include "solver/linear/stiffness.h"

#include "solver/contact/patch_kernel.h"
#include "solver/linear/fill_stiffness.h"
#include "solver/linear/six.h"

namespace voussoir {

namespace {

using Matrix12 = Eigen::Matrix<double, 12, 12>;
using Matrix3x6 = Eigen::Matrix<double, 3, 6>;

Matrix6 intact_stiffness(const Patch& p) {
  Matrix6 k = Matrix6::Zero();
  k.diagonal() << p.kn * p.area, p.ks * p.area, p.ks * p.area, p.ks * (p.ss + p.tt), p.kn * p.tt, p.kn * p.ss;
  return k;
}

/// Rows n, s, t of the jump at a point of the patch.
Matrix3x6 point_rows(const PatchPoint& p) {
  Matrix3x6 n = Matrix3x6::Zero();
  n(0, 0) = n(1, 1) = n(2, 2) = 1.0;
  n(0, 4) = p.t, n(0, 5) = -p.s;
  n(1, 3) = -p.t, n(2, 3) = p.s;
  return n;
}

const Patch& patch_at(const Model& model, const State& state, std::size_t index) {
  return index < model.joints.size() ? model.joints[index] : state.contacts[index - model.joints.size()];
}

/// Not a free slot of contacts.
bool is_there(const Model& model, const State& state, std::size_t index) {
  return index < model.joints.size() || state.has_contact(index - model.joints.size());
}

const double* pose_of(const State& state, std::int32_t body) {
  return &state.pose[pose_width * std::size_t(body)];
}

Matrix6 points_stiffness(const Model& model, const State& state, const Patch& patch, const Array<double>& points,
                         const PatchMemory& memory) {
  const Jump<double> j = patch_jump(patch, pose_of(state, patch.a), pose_of(state, patch.b));
  Matrix6 k = Matrix6::Zero();
  for (int i = 0; i < patch.point_count; ++i) {
    const PatchPoint point = patch_point(patch, points, i);
    const Triple<double> u = elastic_jump(patch, j, point, memory, i);
    const LawConstants& law = model.laws[patch.law];
    const bool broken = memory.broken[point_index(patch, i, 1, 0)];
    const Mat3 d =
        memory.point_crush.empty() || !is_composite(law)
            ? point_tangent(law, patch.kn, patch.ks, u, broken)
            : composite_tangent(law, patch.kn, patch.ks, u, broken, memory.point_rest[point_index(patch, i, 2, 1)],
                                memory.point_crush[point_index(patch, i, 3, 0)]);
    const Matrix3x6 rows = point_rows(point);
    k += point.weight * rows.transpose() * d * rows;
  }
  return k;
}

/// As if every point were closed and sticking.
Matrix6 closed_stiffness(const Patch& patch, const Array<double>& points) {
  Matrix6 k = Matrix6::Zero();
  for (int i = 0; i < patch.point_count; ++i) {
    const PatchPoint point = patch_point(patch, points, i);
    const Matrix3x6 rows = point_rows(point);
    k += point.weight * rows.transpose() * Vec3(patch.kn, patch.ks, patch.ks).asDiagonal() * rows;
  }
  return k;
}

/// Whether a patch on the intact path is wholly open.
bool is_open(const Model& model, const State& state, std::size_t index) {
  if (!(state.joint.mode[index] & mode_broken)) return false;
  const Patch& patch = model.joints[index];
  const Jump<double> j = patch_jump(patch, pose_of(state, patch.a), pose_of(state, patch.b));
  for (int c = 0; c < patch.corner_count; ++c) {
    const PatchPoint corner = patch_corner(patch, model.corners, c);
    if (point_jump(patch, j, corner.s, corner.t).x < 0.0) return false;
  }
  return true;
}

/// A tie resists along its axis alone; slack it does so only in a structure that counts as intact.
Matrix6 tie_stiffness(const Model& model, const State& state, const Patch& tie, PatchTangent kind) {
  const Jump<double> j = patch_jump(tie, pose_of(state, tie.a), pose_of(state, tie.b));
  const double stretch = -elastic_jump(tie, j, patch_point(tie, model.points, 0), state.joint, 0).x;
  Matrix6 k = Matrix6::Zero();
  if (kind == PatchTangent::intact || stretch > 0.0) k(0, 0) = tie.kn * tie.area;
  return k;
}

/// From a body's centroid, where it is now, to the middle of the patch (m).
Vec3 arm_to(const Model& model, const double* pose, std::int32_t body, const Vec3& place) {
  return place - model.bodies[std::size_t(body)].centroid - Vec3(pose[0], pose[1], pose[2]);
}

/// Generalised jump of a patch for small motions (du, dθ) of each of its bodies from where they are. Exact at a finite
/// jump too, since the axes turn by the mean of the two turns and the arms end in the middle.
struct JumpOf {
  Matrix6 a, b;
};
JumpOf jump_rows(const Model& model, const State& state, const Patch& patch) {
  const double *pa = pose_of(state, patch.a), *pb = pose_of(state, patch.b);
  const Jump<double> j = patch_jump(patch, pa, pb);
  const Mat3 to_local = axes_matrix(j).transpose();
  const Vec3 place(j.place.x, j.place.y, j.place.z);
  const Vec3 arm_a = arm_to(model, pa, patch.a, place), arm_b = arm_to(model, pb, patch.b, place);
  JumpOf of = {Matrix6::Zero(), Matrix6::Zero()};
  of.a.block<3, 3>(0, 0) = of.a.block<3, 3>(3, 3) = -to_local;
  of.a.block<3, 3>(0, 3) = to_local * skew(arm_a);  // −(dθ × arm)
  of.b.block<3, 3>(0, 0) = of.b.block<3, 3>(3, 3) = to_local;
  of.b.block<3, 3>(0, 3) = -to_local * skew(arm_b);
  return of;
}

/// Blocks of K that a patch adds to; rows b, columns a for both of its bodies together.
struct PairStiffness {
  Matrix6 a, b, ba;
};
PairStiffness pair_stiffness(const Model& model, const State& state, std::size_t index, PatchTangent kind) {
  const JumpOf jump = jump_rows(model, state, patch_at(model, state, index));
  const Matrix6 k = patch_stiffness(model, state, index, kind), a = block_product(k, jump.a),
                b = block_product(k, jump.b);
  const Columns to_a(jump.a.transpose()), to_b(jump.b.transpose());
  PairStiffness pair = {Matrix6::Zero(), Matrix6::Zero(), Matrix6::Zero()};
  to_a.add_times(a, pair.a), to_b.add_times(b, pair.b), to_b.add_times(a, pair.ba);
  return pair;
}

/// What the forces already there do when the bodies move (docs/theory/modes.md): the patch's resultant F and couple C
/// on b turn with its axes, by ½ (dθ_a + dθ_b), and act at its middle, which moves by the mean of the two faces. The
/// skew parts of the diagonal blocks, ½ [M]× with M the moment on the body, cancel over a body in equilibrium and are
/// left out.
Matrix12 geometric_stiffness(const Model& model, const State& state, const Patch& patch, const double* wrench) {
  const double *pa = pose_of(state, patch.a), *pb = pose_of(state, patch.b);
  const Jump<double> j = patch_jump(patch, pa, pb);
  const Vec3 place(j.place.x, j.place.y, j.place.z), force = -Vec3(wrench[0], wrench[1], wrench[2]);
  const Vec3 couple = -Vec3(wrench[3], wrench[4], wrench[5]) - place.cross(force);
  const Mat3 f = skew(force), ra = skew(arm_to(model, pa, patch.a, place)),
             rb = skew(arm_to(model, pb, patch.b, place));
  Matrix12 k = Matrix12::Zero();  // −∂(forces on a and b)/∂(motions)
  k.block<3, 3>(0, 3) = k.block<3, 3>(0, 9) = -0.5 * f;
  k.block<3, 3>(6, 3) = k.block<3, 3>(6, 9) = 0.5 * f;
  k.block<3, 3>(3, 0) = k.block<3, 3>(9, 0) = 0.5 * f;
  k.block<3, 3>(3, 6) = k.block<3, 3>(9, 6) = -0.5 * f;
  k.block<3, 3>(9, 3) = 0.5 * (rb * f - f * ra + skew(couple));
  k.block<3, 3>(3, 9) = k.block<3, 3>(9, 3).transpose();
  return k;
}

/// The same of a tie with force f on body a: f turns with the way from anchor to anchor, and each anchor with its body.
Matrix12 geometric_stiffness_of_tie(const State& state, const Patch& tie, const double* wrench) {
  const double *pa = pose_of(state, tie.a), *pb = pose_of(state, tie.b);
  const Vec3 ra = rotation_of(state, std::size_t(tie.a)) * Vec3(tie.arm_a);
  const Vec3 rb = rotation_of(state, std::size_t(tie.b)) * Vec3(tie.arm_b);
  const Jump<double> j = patch_jump(tie, pa, pb);
  const Vec3 force(wrench[0], wrench[1], wrench[2]), axis = force.normalized();
  Eigen::Matrix<double, 3, 12> way;
  way << -Mat3::Identity(), skew(ra), Mat3::Identity(), -skew(rb);
  const double over_length = force.norm() / (tie.length - j.n);
  Matrix12 k = way.transpose() * (over_length * (Mat3::Identity() - axis * axis.transpose())) * way;
  const Mat3 a = skew(force) * skew(ra), b = skew(-force) * skew(rb);
  k.block<3, 3>(3, 3) -= 0.5 * (a + a.transpose());
  k.block<3, 3>(9, 9) -= 0.5 * (b + b.transpose());
  return k;
}

void add_pair(BlockMatrix& k, const Patch& patch, const PairStiffness& pair) {
  k.add(patch.a, patch.a, pair.a);
  k.add(patch.b, patch.b, pair.b);
  k.add(patch.b, patch.a, pair.ba);
}

PairStiffness parts_of(const Matrix12& pair) {
  return {pair.topLeftCorner<6, 6>(), pair.bottomRightCorner<6, 6>(), pair.bottomLeftCorner<6, 6>()};
}

}  // namespace

Mat3 point_tangent(const LawConstants& law, double kn, double ks, const Triple<double>& elastic, bool broken) {
  Mat3 d = Mat3::Zero();
  const double n = elastic.x, s = elastic.y, t = elastic.z;
  if (!broken || law.kind == JointLaw::Kind::elastic) {
    d.diagonal() << kn, ks, ks;
    return d;
  }
  if (n >= 0.0) return d;
  d.diagonal() << kn, ks, ks;
  const double shear = std::sqrt(s * s + t * t);
  const double limit = (law.residual_cohesion - kn * n * law.residual_tan_friction) / ks;
  if (shear < limit * (1.0 - 1e-9) || shear == 0.0) return d;
  const Eigen::Vector2d along(s / shear, t / shear);
  d.bottomRightCorner<2, 2>() -= 0.999 * ks * along * along.transpose();
  return d;
}

Mat3 composite_tangent(const LawConstants& law, double kn, double ks, const Triple<double>& elastic, bool broken,
                       double softening, double crushed) {
  const double kept = kept_stiffness(law, kn, crushed);
  LawConstants left = law;  // what friction is left of
  left.residual_cohesion += (1.0 - softening) * (law.cohesion - law.residual_cohesion);
  left.residual_tan_friction += (1.0 - softening) * (law.tan_friction - law.residual_tan_friction);
  const bool pulled = elastic.x >= 0.0 && !broken;
  Mat3 d = point_tangent(left, kept * kn, kept * ks, elastic, !pulled);
  if (!crushes(law) || elastic.x >= 0.0) return d;
  const CrushingCurve curve(law, kn);
  const double p = kn * elastic.x, t2 = ks * ks * (elastic.y * elastic.y + elastic.z * elastic.z);
  if (std::sqrt(p * p + law.cap_shear * t2) < (1.0 - 1e-9) * curve.effective(crushed)) return d;
  const double slope = std::max(curve.slope(crushed), 0.0);
  d(0, 0) = std::max(kn * slope / (kn + slope), 1e-3 * kn);
  return d;
}

Matrix6 patch_stiffness(const Model& model, const State& state, std::size_t index, PatchTangent kind) {
  const std::size_t joints = model.joints.size();
  const Patch& patch = patch_at(model, state, index);
  if (index >= joints) {
    if (kind == PatchTangent::present)
      return points_stiffness(model, state, patch, state.contact_points, state.contact);
    return closed_stiffness(patch, state.contact_points);
  }
  if (state.joint.mode[index] & mode_gone) return Matrix6::Zero();
  if (patch.length > 0.0) return tie_stiffness(model, state, patch, kind);
  if (kind == PatchTangent::intact) return intact_stiffness(patch);
  if (state.joint.mode[index] & mode_points) return points_stiffness(model, state, patch, model.points, state.joint);
  return is_open(model, state, index) ? Matrix6(Matrix6::Zero()) : intact_stiffness(patch);
}

std::array<Matrix6, 2> own_stiffness(const Model& model, const State& state, std::size_t index, PatchTangent kind) {
  const PairStiffness pair = pair_stiffness(model, state, index, kind);
  return {pair.a, pair.b};
}

BlockMatrix stiffness_blocks(const Model& model, const State& state, PatchTangent kind) {
  const std::size_t all = model.joints.size() + state.contacts.size();
  std::vector<std::pair<std::int32_t, std::int32_t>> coupled;
  for (std::size_t i = 0; i < all; ++i) {
    const Patch& patch = patch_at(model, state, i);
    if (is_there(model, state, i)) coupled.emplace_back(patch.a, patch.b);
  }
  couple_fill(model, state, coupled);
  BlockMatrix k(model.sites(), coupled);
  for (std::size_t i = 0; i < all; ++i)
    if (is_there(model, state, i)) add_pair(k, patch_at(model, state, i), pair_stiffness(model, state, i, kind));
  add_interface(model, state, kind, k);
  add_fill(model, state, k);
  return k;
}

void add_geometric_stiffness(BlockMatrix& k, const Model& model, const State& state, const Array<double>& wrenches) {
  for (std::size_t i = 0; i < model.joints.size() + state.contacts.size(); ++i) {
    const Patch& patch = patch_at(model, state, i);
    if (!is_there(model, state, i)) continue;
    const double* wrench = &wrenches[wrench_width * i];
    add_pair(k, patch,
             parts_of(patch.length > 0.0 ? geometric_stiffness_of_tie(state, patch, wrench)
                                         : geometric_stiffness(model, state, patch, wrench)));
  }
}

SparseMatrix assemble_stiffness(const Model& model, const State& state, const Unknowns& unknowns, PatchTangent kind) {
  return stiffness_blocks(model, state, kind).over(unknowns);
}

Matrix6 body_mass(const Model& model, const State& state, std::size_t body) {
  Matrix6 m = Matrix6::Zero();
  const Mat3 r = rotation_of(state, body).toRotationMatrix();
  m.topLeftCorner<3, 3>() = model.bodies[body].inertial_mass * Mat3::Identity();
  m.bottomRightCorner<3, 3>() = r * model.bodies[body].inertia * r.transpose();
  return m;
}

BlockMatrix mass_blocks(const Model& model, const State& state, const Unknowns& unknowns) {
  BlockMatrix m(model.sites(), {});
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (unknowns.any(i)) m.diagonal(std::int32_t(i)) = body_mass(model, state, i);
  for (std::size_t i = 0; i < model.fill.nodes.size(); ++i)
    m.diagonal(std::int32_t(model.bodies.size() + i)).topLeftCorner<3, 3>() = model.fill.inertial[i] * Mat3::Identity();
  return m;
}

}  // namespace voussoir
