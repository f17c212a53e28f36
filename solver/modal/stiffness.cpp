#include "solver/modal/stiffness.h"

#include <algorithm>

#include "solver/step/body_pass.h"

namespace voussoir {

namespace {

using Matrix6 = Eigen::Matrix<double, 6, 6>;
using Matrix6x12 = Eigen::Matrix<double, 6, 12>;
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

/// Tangent at a point that has just been updated: nothing where open, normal and transverse stiffness where sliding.
Mat3 point_tangent(const LawConstants& law, const Patch& patch, const Triple<double>& elastic, bool broken) {
  Mat3 d = Mat3::Zero();
  const double n = elastic.x, s = elastic.y, t = elastic.z;
  if (!broken || law.kind == JointLaw::Kind::elastic) {
    d.diagonal() << patch.kn, patch.ks, patch.ks;
    return d;
  }
  if (n >= 0.0) return d;
  d.diagonal() << patch.kn, patch.ks, patch.ks;
  const double shear = std::sqrt(s * s + t * t);
  const double limit = (law.residual_cohesion - patch.kn * n * law.residual_tan_friction) / patch.ks;
  if (shear < limit * (1.0 - 1e-9) || shear == 0.0) return d;
  const Eigen::Vector2d along(s / shear, t / shear);
  d.bottomRightCorner<2, 2>() -= 0.999 * patch.ks * along * along.transpose();
  return d;
}

const Patch& patch_at(const Model& model, const State& state, std::size_t index) {
  return index < model.joints.size() ? model.joints[index] : state.contacts[index - model.joints.size()];
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
    const Mat3 d = point_tangent(model.laws[patch.law], patch, u, memory.broken[point_index(patch, i, 1, 0)]);
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

Mat3 skew(const Vec3& a) {
  Mat3 m;
  m << 0, -a.z(), a.y(), a.z(), 0, -a.x(), -a.y(), a.x(), 0;
  return m;
}

/// Generalised jump of a patch for small motions (du_a, dθ_a, du_b, dθ_b) of its bodies from where they are.
Matrix6x12 jump_rows(const Model& model, const State& state, const Patch& patch) {
  const double *pa = pose_of(state, patch.a), *pb = pose_of(state, patch.b);
  const Jump<double> j = patch_jump(patch, pa, pb);
  const Eigen::Quaterniond q(j.frame.w, j.frame.v.x, j.frame.v.y, j.frame.v.z);
  const Mat3 to_local = q.toRotationMatrix().transpose();
  const Vec3 place(j.place.x, j.place.y, j.place.z);
  const Vec3 arm_a = place - model.bodies[patch.a].centroid - Vec3(pa[0], pa[1], pa[2]);
  const Vec3 arm_b = place - model.bodies[patch.b].centroid - Vec3(pb[0], pb[1], pb[2]);
  Matrix6x12 rows = Matrix6x12::Zero();
  rows.block<3, 3>(0, 0) = -to_local;
  rows.block<3, 3>(0, 3) = to_local * skew(arm_a);  // −(dθ × arm)
  rows.block<3, 3>(0, 6) = to_local;
  rows.block<3, 3>(0, 9) = -to_local * skew(arm_b);
  rows.block<3, 3>(3, 3) = -to_local;
  rows.block<3, 3>(3, 9) = to_local;
  return rows;
}

/// K of one patch for small motions of both its bodies.
Eigen::Matrix<double, 12, 12> pair_stiffness(const Model& model, const State& state, std::size_t index,
                                             PatchTangent kind) {
  const Patch& patch = patch_at(model, state, index);
  Matrix6x12 rows = jump_rows(model, state, patch);
  for (const auto& [body, column] : {std::pair{patch.a, 0}, std::pair{patch.b, 6}})
    for (int c = 0; c < 6; ++c)
      if (!model.bodies[body].still() && model.bodies[body].held(c)) rows.col(column + c).setZero();
  return rows.transpose() * patch_stiffness(model, state, index, kind) * rows;
}

/// The lower block triangle of K: for each free body its own 6 × 6 block, then those of its higher neighbours.
struct Pattern {
  std::vector<std::int32_t> first, neighbour;  // bodies
};

Pattern find_pattern(const Model& model, const State& state, const Unknowns& unknowns) {
  const Incidence incidence = find_incidence(model, state);
  Pattern pattern;
  pattern.first.push_back(0);
  for (std::int32_t body = 0; body < std::int32_t(model.bodies.size()); ++body) {
    if (unknowns.of_body[body] >= 0) {
      std::vector<std::int32_t> list = {body};
      for (std::int32_t k = incidence.first[body]; k < incidence.first[body + 1]; ++k) {
        const Patch& p = patch_at(model, state, incidence.patches[k] >> 1);
        const std::int32_t other = p.a == body ? p.b : p.a;
        if (other > body && unknowns.of_body[other] >= 0) list.push_back(other);
      }
      std::sort(list.begin(), list.end());
      list.erase(std::unique(list.begin(), list.end()), list.end());
      pattern.neighbour.insert(pattern.neighbour.end(), list.begin(), list.end());
    }
    pattern.first.push_back(std::int32_t(pattern.neighbour.size()));
  }
  return pattern;
}

std::size_t block_at(const Pattern& pattern, std::int32_t column, std::int32_t row) {
  const auto begin = pattern.neighbour.begin() + pattern.first[column],
             end = pattern.neighbour.begin() + pattern.first[column + 1];
  return std::size_t(std::lower_bound(begin, end, row) - pattern.neighbour.begin());
}

SparseMatrix to_columns(const Pattern& pattern, const Unknowns& unknowns, const std::vector<Matrix6>& blocks,
                        double shift) {
  SparseMatrix k(unknowns.count, unknowns.count);
  std::vector<int> sizes(unknowns.count);
  for (std::size_t body = 0; body < unknowns.of_body.size(); ++body)
    if (unknowns.of_body[body] >= 0)
      for (int c = 0; c < 6; ++c)
        sizes[unknowns.of_body[body] + c] = 6 * (pattern.first[body + 1] - pattern.first[body]) - c;
  k.reserve(sizes);
  for (std::size_t body = 0; body < unknowns.of_body.size(); ++body) {
    const std::int32_t column = unknowns.of_body[body];
    if (column < 0) continue;
    for (int c = 0; c < 6; ++c)
      for (std::int32_t at = pattern.first[body]; at < pattern.first[body + 1]; ++at) {
        const std::int32_t row = unknowns.of_body[pattern.neighbour[at]];
        for (int r = row == column ? c : 0; r < 6; ++r)
          k.insert(row + r, column + c) = blocks[at](r, c) * (row + r == column + c ? 1.0 + shift : 1.0);
      }
  }
  k.makeCompressed();
  return k;
}

}  // namespace

Unknowns number_unknowns(const Model& model) {
  Unknowns unknowns;
  for (const Body& body : model.bodies) {
    unknowns.of_body.push_back(body.still() ? -1 : unknowns.count);
    if (!body.still()) unknowns.count += 6;
  }
  return unknowns;
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
  if (kind == PatchTangent::intact) return intact_stiffness(patch);
  if (state.joint.mode[index] & mode_points) return points_stiffness(model, state, patch, model.points, state.joint);
  return is_open(model, state, index) ? Matrix6(Matrix6::Zero()) : intact_stiffness(patch);
}

std::vector<Matrix6> body_stiffness(const Model& model, const State& state, PatchTangent kind) {
  std::vector<Matrix6> blocks(model.bodies.size(), Matrix6::Zero());
  for (std::size_t i = 0; i < model.joints.size() + state.contacts.size(); ++i) {
    const Patch& patch = patch_at(model, state, i);
    const Eigen::Matrix<double, 12, 12> k = pair_stiffness(model, state, i, kind);
    blocks[patch.a] += k.topLeftCorner<6, 6>();
    blocks[patch.b] += k.bottomRightCorner<6, 6>();
  }
  return blocks;
}

SparseMatrix assemble_stiffness(const Model& model, const State& state, const Unknowns& unknowns, PatchTangent kind,
                                double shift) {
  const Pattern pattern = find_pattern(model, state, unknowns);
  std::vector<Matrix6> blocks(pattern.neighbour.size(), Matrix6::Zero());
  const std::size_t all = model.joints.size() + state.contacts.size();
  for (std::size_t i = 0; i < all; ++i) {
    const Patch& patch = patch_at(model, state, i);
    const Eigen::Matrix<double, 12, 12> k = pair_stiffness(model, state, i, kind);
    const bool free_a = unknowns.of_body[patch.a] >= 0, free_b = unknowns.of_body[patch.b] >= 0;
    if (free_a) blocks[block_at(pattern, patch.a, patch.a)] += k.topLeftCorner<6, 6>();
    if (free_b) blocks[block_at(pattern, patch.b, patch.b)] += k.bottomRightCorner<6, 6>();
    if (!free_a || !free_b) continue;
    if (patch.a < patch.b)
      blocks[block_at(pattern, patch.a, patch.b)] += k.bottomLeftCorner<6, 6>();
    else
      blocks[block_at(pattern, patch.b, patch.a)] += k.topRightCorner<6, 6>();
  }
  if (shift > 0.0) {  // a block that nothing holds has a zero diagonal: give it the share of a typical one
    double largest = 0.0;
    for (const Matrix6& block : blocks) largest = std::max(largest, block.diagonal().maxCoeff());
    for (std::size_t body = 0; body < unknowns.of_body.size(); ++body)
      if (unknowns.of_body[body] >= 0)
        blocks[block_at(pattern, std::int32_t(body), std::int32_t(body))].diagonal().array() += shift * 1e-3 * largest;
  }
  return to_columns(pattern, unknowns, blocks, shift);
}

Eigen::VectorXd divide_by_mass(const Model& model, const State& state, const Unknowns& unknowns,
                               const Eigen::VectorXd& x) {
  Eigen::VectorXd y(x.size());
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const std::int32_t at = unknowns.of_body[i];
    if (at < 0) continue;
    const Body& body = model.bodies[i];
    const Mat3 r = rotation_of(state, i).toRotationMatrix();
    y.segment<3>(at) = x.segment<3>(at) / body.inertial_mass;
    y.segment<3>(at + 3) = r * (body.inverse_inertia * (r.transpose() * x.segment<3>(at + 3)));
    for (int c = 0; c < 6; ++c)
      if (body.held(c)) y[at + c] = 0.0;
  }
  return y;
}

}  // namespace voussoir
