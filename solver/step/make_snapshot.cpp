#include "solver/step/make_snapshot.h"

#include <algorithm>
#include <limits>

#include "geometry/kern.h"
#include "solver/contact/jump.h"
#include "solver/contact/make_contact.h"
#include "solver/fill/tet_stress.h"
#include "solver/model/kernels.h"
#include "solver/step/damage.h"

namespace voussoir {

namespace {

const double* pose_of(const State& state, std::int32_t body) {
  return &state.pose[pose_width * std::size_t(body)];
}

Vec3 vector(const Triple<double>& x) {
  return {x.x, x.y, x.z};
}

/// Sums over a patch: m2, N, m2, and of the normal traction the first moments along s and t (N m); opening and slip, m.
struct Tractions {
  double area = 0.0, normal = 0.0, s = 0.0, t = 0.0, bonded = 0.0, opening = 0.0, slip = 0.0;
  double moment_s = 0.0, moment_t = 0.0;
};

PlaneCorners plane_corners(const Patch& p, const Array<double>& corners) {
  PlaneCorners plane;
  for (int c = 0; c < p.corner_count; ++c) {
    const PatchPoint corner = patch_corner(p, corners, c);
    plane.emplace_back(corner.s, corner.t);
  }
  return plane;
}

/// Elastic tractions and openings over the points of a patch.
Tractions point_tractions(const LawConstants& law, const Patch& p, const Jump<double>& j, const Array<double>& points,
                          const PatchMemory& memory) {
  Tractions sum;
  for (int i = 0; i < p.point_count; ++i) {
    const PatchPoint point = patch_point(p, points, i);
    const Triple<double> u = elastic_jump(p, j, point, memory, i);
    const bool broken = memory.broken[point_index(p, i, 1, 0)];
    const double w = point.weight;
    sum.area += w;
    if (!broken) sum.bonded += w;
    if (broken) sum.opening = std::max(sum.opening, point_jump(p, j, point.s, point.t).x);
    if (broken && u.x >= 0.0) continue;
    sum.slip =
        std::max(sum.slip, std::hypot(memory.point[point_index(p, i, 2, 0)], memory.point[point_index(p, i, 2, 1)]));
    const double kept = kept_at(law, p, memory, i), normal = w * kept * p.kn * u.x;
    sum.normal += normal;
    sum.moment_s += normal * point.s;
    sum.moment_t += normal * point.t;
    sum.s += w * kept * p.ks * u.y;
    sum.t += w * kept * p.ks * u.z;
  }
  return sum;
}

Tractions intact_tractions(const Model& model, const State& state, const Patch& p, const Jump<double>& j,
                           std::size_t index) {
  Tractions sum;
  const bool broken = state.joint.mode[index] & mode_broken;
  const double* slip = &state.slip[3 * lane_count * std::size_t(p.batch) + std::size_t(p.lane)];
  double least = 1e300;
  for (int c = 0; c < p.corner_count; ++c) {
    const PatchPoint corner = patch_corner(p, model.corners, c);
    const double n = point_jump(p, j, corner.s, corner.t).x;
    least = std::min(least, n);
    if (broken) sum.opening = std::max(sum.opening, n);
  }
  sum.area = p.area;
  sum.bonded = broken ? 0.0 : p.area;
  if (broken && least >= 0.0) return sum;
  sum.slip = std::hypot(slip[0], slip[lane_count]);
  sum.normal = p.area * p.kn * j.n;
  sum.s = p.area * p.ks * (j.s - slip[0]);
  sum.t = p.area * p.ks * (j.t - slip[lane_count]);
  const SecondMoments m = second_moments(plane_corners(p, model.corners));
  sum.moment_s = p.kn * (j.rs * m.xy - j.rt * m.xx);
  sum.moment_t = p.kn * (j.rs * m.yy - j.rt * m.xy);
  return sum;
}

PatchSnapshot patch_snapshot(const Model& model, const Patch& p, const Jump<double>& j, const Tractions& sum,
                             const Array<double>& corners, const PatchMemory& memory) {
  const double opening = memory.largest[largest_index(place_of(p), 0)];
  PatchSnapshot s;
  s.a = model.block_of_body[p.a];
  s.b = model.block_of_body[p.b];
  s.normal = vector(turn(j.axes, Triple<double>{1, 0, 0}));
  for (int c = 0; c < p.corner_count; ++c) {
    const PatchPoint corner = patch_corner(p, corners, c);
    s.polygon.push_back(vector(j.place) + vector(turn(j.axes, Triple<double>{0, corner.s, corner.t})));
  }
  s.area = p.area;
  s.opening = sum.opening;
  s.slip = sum.slip;
  s.largest_opening = p.stride > 1 ? std::max(opening, sum.opening) : opening;
  s.largest_slip = std::max(memory.largest[largest_index(place_of(p), 1)], sum.slip);
  s.normal_traction = sum.normal / sum.area;
  s.shear_traction = std::hypot(sum.s, sum.t) / sum.area;
  s.bonded = sum.bonded / sum.area;
  const LawConstants& law = model.laws[std::size_t(p.law)];
  s.had_bond = has_bond(law);
  if (sum.normal < 0.0)
    s.eccentricity =
        eccentricity_over_depth(plane_corners(p, corners), {sum.moment_s / sum.normal, sum.moment_t / sum.normal});
  if (const double shear = s.shear_traction * s.area; shear > 0.0) {
    const double capacity = shear_capacity(law, s);
    s.utilisation = capacity > 0.0 ? shear / capacity : 1.0;
  }
  return s;
}

/// The strip between the anchors of a tie, as wide as it was.
Polygon strip_of(const Patch& p, const Jump<double>& j) {
  const auto axis = [&](double n, double s) { return vector(turn(j.axes, Triple<double>{n, s, 0.0})); };
  const Vec3 half = axis(-0.5 * (p.length - j.n), 0.0), side = axis(0.0, 0.5 * p.area / p.length);
  const Vec3 from = vector(j.place) - half, to = vector(j.place) + half;
  return {from - side, from + side, to + side, to - side};
}

PatchSnapshot tie_snapshot(const Model& model, const State& state, std::size_t i, const Jump<double>& j) {
  const Patch& p = model.joints[i];
  const Triple<double> u = elastic_jump(p, j, patch_point(p, model.points, 0), state.joint, 0);
  const double set = u.x - j.n;  // what it was stretched to at first, less what has yielded
  PatchSnapshot s;
  s.a = model.block_of_body[std::size_t(p.a)];
  s.b = model.block_of_body[std::size_t(p.b)];
  s.polygon = strip_of(p, j);
  s.normal = polygon_normal(s.polygon);
  s.area = p.area;
  s.normal_traction = p.kn * std::max(0.0, -u.x);
  s.bonded = 0.0;
  s.tie = true;
  s.yielded = set + model.laws[std::size_t(p.law)].prestress / p.kn;
  s.largest_tension = state.joint.largest[largest_index(place_of(p), 1)];
  return s;
}

PatchSnapshot joint_snapshot(const Model& model, const State& state, std::size_t i) {
  const Patch& p = model.joints[i];
  const Jump<double> j = patch_jump(p, pose_of(state, p.a), pose_of(state, p.b));
  if (p.length > 0.0) return tie_snapshot(model, state, i, j);
  Tractions sum;
  const bool replaced = state.joint.mode[i] & mode_gone;
  if (replaced) {  // what it was lives on in its largest opening and slip
    sum.area = p.area;
    sum.opening = std::max(0.0, j.n);
  } else if (state.joint.mode[i] & mode_points) {
    sum = point_tractions(model.laws[std::size_t(p.law)], p, j, model.points, state.joint);
  } else {
    sum = intact_tractions(model, state, p, j, i);
  }
  PatchSnapshot s = patch_snapshot(model, p, j, sum, model.corners, state.joint);
  s.replaced = replaced;
  return s;
}

/// Of a contact, m: while it is wholly open its plastic slip is its jump, and is not kept point by point.
Vec3 slip_of(const State& state, std::size_t contact) {
  const Patch& p = state.contacts[contact];
  if (!(state.contact.mode[contact] & mode_open)) return mean_slip(state, p, state.contact_points, state.contact);
  const Jump<double> j = patch_jump(p, &state.pose[pose_width * p.a], &state.pose[pose_width * p.b]);
  return vector(turn(j.axes, Triple<double>{0.0, j.s, j.t}));
}

/// What the patches that a contact replaced had slipped belongs to it.
void add_earlier_slip(const State& state, std::size_t contact, PatchSnapshot& s) {
  const double* slid = &state.contact_slid[4 * contact];
  const Vec3 before(slid[0], slid[1], slid[2]);
  s.largest_slip = std::max(slid[3], before.norm() + s.largest_slip);
  if (!before.isZero(0.0)) s.slip = (before + slip_of(state, contact)).norm();
}

FillSnapshot fill_snapshot(const FillModel& fill, const FillMemory& memory) {
  FillSnapshot s;
  if (fill.empty()) return s;
  for (const std::int32_t node : fill.node_of) {
    const double* p = &memory.pose[node_width * std::size_t(node)];
    const double* v = &memory.motion[node_width * std::size_t(node)];
    s.displacement.emplace_back(p[0], p[1], p[2]);
    s.velocity.emplace_back(v[0], v[1], v[2]);
  }
  const std::vector<std::array<double, 6>> stress = kernels().cauchy_stress(fill, memory);
  for (std::size_t i = 0; i < fill.lane_of_tet.size(); ++i) {
    const auto slot = std::size_t(fill.lane_of_tet[i]);
    const double* plastic = &memory.plastic[plastic_index(slot / lane_count, 0) + slot % lane_count];
    s.tets.push_back(
        {stress[i], plastic[lane_count * row_shear], plastic[lane_count * row_volume], memory.yield[slot]});
  }
  return s;
}

}  // namespace

double shear_capacity(const LawConstants& law, const PatchSnapshot& patch) {
  if (law.kind == JointLaw::Kind::elastic) return std::numeric_limits<double>::infinity();
  const double bonded = patch.had_bond ? patch.bonded : 0.0;
  const double tan_friction = bonded * law.tan_friction + (1.0 - bonded) * law.residual_tan_friction;
  const double cohesion = bonded * law.cohesion + (1.0 - bonded) * law.residual_cohesion;
  return patch.area * (cohesion + std::max(0.0, -patch.normal_traction) * tan_friction);
}

Snapshot make_snapshot(const Model& model, const State& state) {
  Snapshot snapshot;
  snapshot.time = state.time();
  snapshot.base_displacement = state.base_displacement();
  for (std::int32_t body : model.body_of_block) {
    const double* p = pose_of(state, body);
    const double* v = &state.motion[motion_width * std::size_t(body)];
    snapshot.displacement.emplace_back(p[0], p[1], p[2]);
    snapshot.rotation.emplace_back(p[3], p[4], p[5], p[6]);
    snapshot.velocity.emplace_back(v[0], v[1], v[2]);
  }
  snapshot.patches.resize(model.joints.size());
  for (std::size_t i = 0; i < model.joints.size(); ++i)
    snapshot.patches[model.joint_of_patch[i]] = joint_snapshot(model, state, i);
  for (std::size_t i = 0; i < state.contacts.size(); ++i) {
    if (!state.has_contact(i)) continue;
    const Patch& p = state.contacts[i];
    const Jump<double> j = patch_jump(p, pose_of(state, p.a), pose_of(state, p.b));
    const Tractions sum = point_tractions(model.laws[std::size_t(p.law)], p, j, state.contact_points, state.contact);
    PatchSnapshot s = patch_snapshot(model, p, j, sum, state.contact_corners, state.contact);
    add_earlier_slip(state, i, s);
    // Faces that met during the run were never a joint: how far apart they are, or were when they were found, is no
    // opening. What a joint had opened before a contact took its place stays with the joint.
    s.opening = s.largest_opening = 0.0;
    snapshot.patches.push_back(std::move(s));
  }
  snapshot.fill = fill_snapshot(model.fill, state.fill);
  return snapshot;
}

void set_baseline(State& state) {
  state.baseline = state.pose;
  for (std::size_t i = 0; i < state.baseline.size(); i += pose_width)
    for (std::size_t c = 0; c < 3; ++c) state.baseline[i + c] -= state.base_displacement()[Eigen::Index(c)];
}

namespace {

/// How far a pose has taken a point that is `arm` (m, reference axes) from the centroid.
Vec3 moved_by(const double* pose, const Vec3& arm) {
  return Vec3(pose) + vector(turn_change(pose_rotation(pose), Triple<double>{arm.x(), arm.y(), arm.z()}));
}

}  // namespace

Vec3 displacement_since_built(const Model& model, const State& state, std::int64_t block, const Vec3& position) {
  const std::int32_t body = model.body_of_block[block];
  return moved_by(pose_of(state, body), position - model.bodies[body].centroid) - state.base_displacement();
}

Vec3 relative_displacement(const Model& model, const State& state, std::int64_t block, const Vec3& position) {
  const std::int32_t body = model.body_of_block[block];
  return displacement_since_built(model, state, block, position) -
         moved_by(&state.baseline[pose_width * std::size_t(body)], position - model.bodies[body].centroid);
}

Vec3 relative_rotation(const Model& model, const State& state, std::int64_t block) {
  const auto body = std::size_t(model.body_of_block[std::size_t(block)]);
  const double* from = &state.baseline[pose_width * body];
  const Eigen::AngleAxisd turn(rotation_of(state, body) *
                               Eigen::Quaterniond(from[3], from[4], from[5], from[6]).conjugate());
  return turn.angle() * turn.axis();
}

Vec3 point_velocity(const Model& model, const State& state, std::int64_t block, const Vec3& position) {
  const auto body = std::size_t(model.body_of_block[std::size_t(block)]);
  const double* motion = &state.motion[motion_width * body];
  const Eigen::Quaterniond q = rotation_of(state, body);
  const Body& b = model.bodies[body];
  const Vec3 momentum(motion[3], motion[4], motion[5]);
  const Vec3 spin = q * (b.inverse_inertia * (q.conjugate() * momentum));
  return Vec3(motion[0], motion[1], motion[2]) + spin.cross(q * (position - b.centroid));
}

double fallen_share(const Model& model, const State& state, double distance) {
  double whole = 0.0, gone = 0.0;
  for (std::size_t block = 0; block < model.body_of_block.size(); ++block) {
    const Body& body = model.bodies[std::size_t(model.body_of_block[block])];
    if (body.fixed) continue;
    whole += body.mass;
    const Vec3 u = relative_displacement(model, state, std::int64_t(block), body.centroid);
    if (!(u.norm() <= distance)) gone += body.mass;
  }
  for (std::size_t node = 0; node < model.fill.nodes.size(); ++node) {  // what loose soil has done, a wall did not hold
    whole += model.fill.mass[node];
    const Vec3 u = Vec3(&state.fill.pose[node_width * node]) - state.base_displacement();
    if (!(u.norm() <= distance)) gone += model.fill.mass[node];
  }
  return whole > 0.0 ? gone / whole : 0.0;
}

}  // namespace voussoir
