#include "solver/contact/make_contact.h"

#include <algorithm>

#include "geometry/shortest_link.h"

namespace voussoir {

namespace {

const double* pose_of(const State& state, std::int32_t body) {
  return &state.pose[pose_width * std::size_t(body)];
}

/// Shares of the smaller body's face that a sharp contact stands on, and below which an overlap carries nothing.
constexpr double point_share = 0.01, least_share = 0.01;
/// Of its size: the breadth of edges (a line as long as it is broad stands on as much as a point), and by how much
/// cells shrink for the normal of a pair.
constexpr double edge_breadth = 0.1, shrink_share = 0.01;
/// And how near the joints of stones that enclose an edge end at it.
constexpr double point_reach = 0.1;

double body_size(const Model& model, std::int32_t body) {
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  for (const Convex& cell : model.cells[body])
    for (const Vec3& v : cell.vertices) low = low.cwiseMin(v), high = high.cwiseMax(v);
  return std::cbrt((high - low).prod());
}

/// Series stiffness over the two half-lengths from the centroids to the contact plane, as for joints.
void set_stiffness(const Model& model, const State& state, const Vec3& place, const Vec3& normal, Patch& patch) {
  const auto half = [&](std::int32_t body) {
    const double* p = pose_of(state, body);
    const Vec3 centroid = model.bodies[body].centroid + Vec3(p[0], p[1], p[2]);
    return std::max(std::abs(normal.dot(place - centroid)), 0.1 * body_size(model, body));
  };
  const Model::Matter &ma = model.matter[patch.a], &mb = model.matter[patch.b];
  const double da = half(patch.a), db = half(patch.b);
  patch.kn = 1.0 / (da / ma.youngs + db / mb.youngs);
  patch.ks = 1.0 / (da / ma.shear + db / mb.shear);
}

void store_turn(double* to, const Eigen::Quaterniond& q) {
  to[0] = q.w(), to[1] = q.x(), to[2] = q.y(), to[3] = q.z();
}

/// Arms and axes of both bodies so that the patch's own jump is zero where the bodies are now.
void place_patch(const Model& model, const State& state, const Vec3& place, const Mat3& frame, Patch& patch) {
  const Eigen::Quaterniond e(frame);
  const auto arm = [&](std::int32_t body) -> Vec3 {
    const double* p = pose_of(state, body);
    return rotation_of(state, std::size_t(body)).conjugate() *
           (place - model.bodies[body].centroid - Vec3(p[0], p[1], p[2]));
  };
  const Vec3 arm_a = arm(patch.a), arm_b = arm(patch.b);
  const Vec3 at_a = model.bodies[patch.a].centroid + arm_a;
  store(patch.arm_a, arm_a);
  store(patch.arm_b, arm_b);
  store(patch.place, at_a);
  store(patch.shift, model.bodies[patch.b].centroid + arm_b - at_a);
  store_turn(patch.e_a, rotation_of(state, std::size_t(patch.a)).conjugate() * e);
  store_turn(patch.e_b, rotation_of(state, std::size_t(patch.b)).conjugate() * e);
}

/// Gap of the two faces as an affine field over the patch: least squares over the corners (both faces are plane).
void fit_gap(const Meeting& m, const PatchShape& shape, Patch& patch) {
  Mat3 normal = Mat3::Zero();
  Vec3 right = Vec3::Zero();
  for (std::size_t i = 0; i < m.on_a.size(); ++i) {
    const Vec3 mid = 0.5 * (m.on_a[i] + m.on_b[i]) - shape.centroid;
    const Vec3 row(1.0, shape.frame.col(2).dot(mid), -shape.frame.col(1).dot(mid));
    normal += row * row.transpose();
    right += row * m.normal.dot(m.on_b[i] - m.on_a[i]);
  }
  normal.diagonal() += 1e-14 * Vec3::Constant(normal.trace());
  store(patch.gap, normal.ldlt().solve(right));
}

/// The patch lies at the level where the faces are nearest: halfway up the mean gap instead, a rocking block would turn
/// about a point above its edge.
void make_face_patch(const Model& model, const State& state, const Meeting& m, NewContact& contact) {
  const auto gap = [&](std::size_t i) { return m.normal.dot(m.on_b[i] - m.on_a[i]); };
  std::size_t nearest = 0;
  for (std::size_t i = 1; i < m.on_a.size(); ++i)
    if (gap(i) < gap(nearest)) nearest = i;
  const double level = m.normal.dot(m.on_a[nearest] + m.on_b[nearest]) / 2;
  Polygon polygon;
  for (std::size_t i = 0; i < m.on_a.size(); ++i) {
    const Vec3 mid = 0.5 * (m.on_a[i] + m.on_b[i]);
    polygon.push_back(mid + m.normal * (level - m.normal.dot(mid)));
  }
  const PatchShape shape = patch_shape(polygon, m.normal, model.contact.points_per_side);
  Patch& p = contact.patch;
  p.area = shape.area, p.ss = shape.ss, p.tt = shape.tt;
  place_patch(model, state, shape.centroid, shape.frame, p);
  fit_gap(m, shape, p);
  set_stiffness(model, state, shape.centroid, m.normal, p);
  contact.points = shape.points;
  contact.corners = shape.corners;
}

/// Stones laid edge along edge meet sharply from the start, by the thousand. Those that others enclose carry nothing
/// there; only when they have moved well into each other do they need a contact.
bool touching_as_built(const Model& model, const Patch& p) {
  const double near = model.contact.gap_tolerance;
  return separation(model.cells[p.a][p.cell_a], model.cells[p.b][p.cell_b], near) <= near;
}

/// The frame of a sharp contact: s along the line of the pairs of points, if there are two.
Mat3 sharp_frame(const Meeting& m) {
  Vec3 s = m.normal.unitOrthogonal();
  if (m.on_a.size() == 2) {
    const Vec3 along = m.on_a[1] + m.on_b[1] - m.on_a[0] - m.on_b[0];
    s = (along - m.normal.dot(along) * m.normal).normalized();
  }
  Mat3 frame;
  frame << m.normal, s, m.normal.cross(s);
  return frame;
}

Vec3 middle_of(const Meeting& m) {
  Vec3 place = Vec3::Zero();
  for (std::size_t i = 0; i < m.on_a.size(); ++i) place += (m.on_a[i] + m.on_b[i]) / (2.0 * double(m.on_a.size()));
  return place;
}

/// A sharp contact gets a small area. Along shared edges the area is a strip whose points all lie on the line, so that
/// it is a hinge (Simpson's rule: exact for linear functions, with points at the ends).
void make_sharp_patch(const Model& model, const State& state, const Meeting& m, NewContact& contact) {
  Patch& p = contact.patch;
  const double size = std::min(body_size(model, p.a), body_size(model, p.b)), breadth = edge_breadth * size;
  const Mat3 frame = sharp_frame(m);
  const Vec3 place = middle_of(m);
  const double length = m.on_a.size() == 2 ? frame.col(1).dot(m.on_a[1] - m.on_a[0]) : 0.0;
  const double half = 0.5 * length, h = 0.5 * breadth;
  place_patch(model, state, place, frame, p);
  set_stiffness(model, state, place, m.normal, p);
  if (length <= breadth) {
    p.area = point_share * size * size;
    p.gap[0] = m.separation;
    contact.points = {{0.0, 0.0, p.area}};
    contact.corners = {{-h, -h, 0}, {h, -h, 0}, {h, h, 0}, {-h, h, 0}};
    return;
  }
  p.area = breadth * length;
  p.ss = p.area * length * length / 12.0;
  const double first = m.normal.dot(m.on_b[0] - m.on_a[0]), last = m.normal.dot(m.on_b[1] - m.on_a[1]);
  p.gap[0] = 0.5 * (first + last), p.gap[2] = -(last - first) / length;
  contact.points = {{-half, 0, p.area / 6}, {0, 0, p.area * 4 / 6}, {half, 0, p.area / 6}};
  contact.corners = {{-half, -h, 0}, {half, -h, 0}, {half, h, 0}, {-half, h, 0}};
}

bool has_area(const Meeting& m, double size) {
  return m.kind == Meeting::Kind::face && m.on_a.size() >= 3 && m.area > least_share * size * size;
}

/// Whether faces lie flat on each other, in a small spot: no matter of edges.
bool flat_spot(const Convex& a, const Convex& b, const Meeting& m) {
  return m.kind == Meeting::Kind::face && m.on_a.size() >= 3 &&
         (a.planes[std::size_t(m.face_a)].normal + b.planes[std::size_t(m.face_b)].normal).norm() < 1e-3;
}

/// Whether two cells that share no area lie on either side of a plane that has a face of each: they slide along it
/// without overlap, and the middle of all directions that part them would resist that.
bool slides_free(const Model& model, const Convex& a, const Convex& b, const Meeting& m, double size) {
  constexpr double flat_share = 1e-4;  // of the squared size: less is no area
  if (flat_spot(a, b, m) && m.area > flat_share * size * size) return false;
  return lie_flush(a, b, model.contact.gap_tolerance);
}

/// How cells meet that share no area to speak of. Edges that cross have a normal of the pair already.
Meeting sharply(const Convex& a, const Convex& b, const Meeting& m, double within, double shrink) {
  if (m.kind == Meeting::Kind::edge || flat_spot(a, b, m)) return m;
  return sharp_meeting(a, b, within, shrink).value_or(m);
}

/// The middle of what the boxes about two cells share: near where they meet.
Vec3 middle_of_boxes(const Convex& a, const Convex& b) {
  const Box one = bounding_box(a.vertices), other = bounding_box(b.vertices);
  return 0.5 * (one.low.cwiseMax(other.low) + one.high.cwiseMin(other.high));
}

}  // namespace

Convex placed_cell(const Model& model, const State& state, std::int32_t body, std::int32_t cell) {
  const double* p = pose_of(state, body);
  return moved(model.cells[body][cell], rotation_of(state, std::size_t(body)).toRotationMatrix(),
               model.bodies[body].centroid, Vec3(p[0], p[1], p[2]));
}

Examined make_contact(const Model& model, const State& state, const JointsOfBodies& joints, const CellPair& cells,
                      const Convex& placed_a, const Convex& placed_b, double within) {
  const auto [a, b, cell_a, cell_b] = cells;
  Meeting m = meeting(placed_a, placed_b, within);
  if (m.kind == Meeting::Kind::apart) return {std::nullopt, std::max(0.0, m.separation)};
  NewContact contact;
  Patch& p = contact.patch;
  p.a = a, p.b = b, p.cell_a = cell_a, p.cell_b = cell_b;
  p.law = model.matter[a].tan_friction <= model.matter[b].tan_friction ? model.contact_law[a] : model.contact_law[b];
  const double size = std::min(body_size(model, a), body_size(model, b)), shrink = shrink_share * size;
  if (has_area(m, size) && opens_at_an_edge(placed_a, placed_b, m, 3.0 * shrink))
    m = on_common_plane(placed_a, placed_b, m, shrink);
  if (has_area(m, size)) {
    make_face_patch(model, state, m, contact);
  } else {
    // Edge beside edge: where the stones around stand about it as built, there is nothing to stand on yet.
    const bool deep = m.separation < -point_share * size;
    const bool waits = !deep && (m.kind == Meeting::Kind::face || touching_as_built(model, p));
    if (waits && slides_free(model, placed_a, placed_b, m, size)) return {};
    if (waits && joints.enclose(state, cells, middle_of_boxes(placed_a, placed_b), point_reach * size)) return {};
    const Meeting sharp = sharply(placed_a, placed_b, m, within, shrink);
    if (sharp.kind == Meeting::Kind::apart) return {std::nullopt, std::max(0.0, sharp.separation)};
    if (sharp.on_a.empty()) return {};
    if (waits && joints.enclose(state, cells, middle_of(sharp), point_reach * size)) return {};
    make_sharp_patch(model, state, sharp, contact);
  }
  // Found already overlapping (neighbours that met edge to edge): it begins without force from there.
  double deepest = 0.0;
  for (const PatchPoint& c : contact.corners.size() > 1 && p.tt > 0.0 ? contact.corners : contact.points)
    deepest = std::min(deepest, p.gap[0] + p.gap[1] * c.t - p.gap[2] * c.s);
  p.gap[0] -= deepest;
  p.point_count = std::int32_t(contact.points.size());
  p.corner_count = std::int32_t(contact.corners.size());
  contact.memory.assign(4 * contact.points.size(), 0.0);
  for (std::size_t i = 0; i < contact.points.size(); ++i) contact.memory[4 * i + 3] = 1.0;
  return {std::move(contact)};
}

namespace {

struct Carried {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();  // on body a, about `place`, world axes
};

/// Elastic tractions of the old patch about a place.
Carried elastic_wrench(const Model& model, const State& state, const Patch& patch, const Array<double>& points,
                       const PatchMemory& memory, const Vec3& place) {
  const Jump<double> j = patch_jump(patch, pose_of(state, patch.a), pose_of(state, patch.b));
  const Mat3 axes = axes_matrix(j);
  Carried sum;
  for (int i = 0; i < patch.point_count; ++i) {
    const PatchPoint point = patch_point(patch, points, i);
    const Triple<double> u = elastic_jump(patch, j, point, memory, i);
    const double kept = kept_at(model.laws[patch.law], patch, memory, i);
    Triple<double> e = {kept * u.x, kept * u.y, kept * u.z};
    if (memory.broken[point_index(patch, i, 1, 0)]) {
      if (u.x >= 0.0) continue;
      const LawConstants& law = model.laws[patch.law];
      const double limit = law.residual_cohesion - patch.kn * e.x * law.residual_tan_friction;
      const double shear = patch.ks * std::hypot(e.y, e.z);
      if (law.kind != JointLaw::Kind::elastic && shear > limit) e.y *= limit / shear, e.z *= limit / shear;
    }
    const Vec3 force = point.weight * (axes * Vec3(patch.kn * e.x, patch.ks * e.y, patch.ks * e.z));
    const Vec3 where = Vec3(j.place.x, j.place.y, j.place.z) + axes * Vec3(0.0, point.s, point.t);
    sum.force += force;
    sum.moment += (where - place).cross(force);
  }
  return sum;
}

double normal_force(const NewContact& c, double raise) {
  double sum = 0.0;
  for (const PatchPoint& p : c.points)
    sum += p.weight * c.patch.kn * std::min(0.0, c.patch.gap[0] + raise + c.patch.gap[1] * p.t - c.patch.gap[2] * p.s);
  return sum;
}

/// Moves the gap until the normal force is the wanted one (compression, negative).
void match_normal_force(double wanted, NewContact& c) {
  double span = 0.0;
  for (const PatchPoint& p : c.points)
    span = std::max(span, std::abs(c.patch.gap[0] + c.patch.gap[1] * p.t - c.patch.gap[2] * p.s));
  double low = -2.0 * span - 2.0 * std::abs(wanted) / (c.patch.kn * c.patch.area), high = 2.0 * span + 1e-12;
  while (normal_force(c, low) > wanted && low > -1.0) low *= 2.0;
  for (int i = 0; i < 100; ++i) {
    const double middle = 0.5 * (low + high);
    (normal_force(c, middle) < wanted ? low : high) = middle;
  }
  c.patch.gap[0] += 0.5 * (low + high);
}

/// Least and greatest gap at its points and corners.
std::pair<double, double> gap_range(const NewContact& c) {
  double low = c.patch.gap[0], high = low;
  if (c.points.size() == 1) return {low, high};
  for (const auto* some : {&c.points, &c.corners})
    for (const PatchPoint& p : *some) {
      const double gap = c.patch.gap[0] + c.patch.gap[1] * p.t - c.patch.gap[2] * p.s;
      low = std::min(low, gap), high = std::max(high, gap);
    }
  return {low, high};
}

/// Of a contact where it is made: its own jump is zero.
double elastic_energy(const NewContact& c) {
  double sum = 0.0;
  for (std::size_t i = 0; i < c.points.size(); ++i) {
    const PatchPoint& p = c.points[i];
    const double n = c.patch.gap[0] + c.patch.gap[1] * p.t - c.patch.gap[2] * p.s;
    const double s = c.memory[4 * i + 1], t = c.memory[4 * i + 2];
    if (n < 0.0) sum += 0.5 * p.weight * (c.patch.kn * n * n + c.patch.ks * (s * s + t * t));
  }
  return sum;
}

/// The same force on a smaller area has more elastic energy, so a patch with decreasing area would accelerate its
/// blocks. If a part of it is open, the whole patch is raised, because a smaller patch would close the open part.
void limit_energy(double most, NewContact& c) {
  const double now = elastic_energy(c);
  if (now <= most) return;
  const double factor = std::sqrt(std::max(most, 0.0) / now);
  for (std::size_t i = 0; i < c.points.size(); ++i) c.memory[4 * i + 1] *= factor, c.memory[4 * i + 2] *= factor;
  const auto [deepest, highest] = gap_range(c);
  if (highest <= 0.0) {
    for (double& g : c.patch.gap) g *= factor;
    return;
  }
  const double from = c.patch.gap[0];
  double low = 0.0, high = -deepest;
  for (int i = 0; i < 60; ++i) {
    c.patch.gap[0] = from + 0.5 * (low + high);
    (elastic_energy(c) > most ? low : high) = c.patch.gap[0] - from;
  }
  c.patch.gap[0] = from + high;
}

void match_tractions(const Model& model, const State& state, const Patch& old, const Array<double>& points,
                     const PatchMemory& memory, NewContact& contact) {
  Patch& p = contact.patch;
  p.kn = old.kn, p.ks = old.ks;
  const Jump<double> j = patch_jump(p, pose_of(state, p.a), pose_of(state, p.b));
  const Mat3 axes = axes_matrix(j);
  const Carried carried = elastic_wrench(model, state, old, points, memory, Vec3(j.place.x, j.place.y, j.place.z));
  const Vec3 force = axes.transpose() * carried.force, moment = axes.transpose() * carried.moment;
  if (force.x() >= 0.0) return;  // nothing pressed: it starts as it lies
  const double gap[3] = {force.x() / (p.kn * p.area), p.tt > 0 ? moment.y() / (p.kn * p.tt) : 0.0,
                         p.ss > 0 ? moment.z() / (p.kn * p.ss) : 0.0};
  double worst = -1e300;
  for (const PatchPoint& c : contact.corners)
    worst = std::max(worst, gap[0] + (p.ss > 0.0 ? gap[1] * c.t - gap[2] * c.s : 0.0));
  if (worst <= 0.0)
    std::copy(gap, gap + 3, p.gap);
  else
    match_normal_force(force.x(), contact);
  // Shear force and torsion over the points that press.
  double area = 0.0, polar = 0.0;
  const auto closed = [&](const PatchPoint& q) { return p.gap[0] + p.gap[1] * q.t - p.gap[2] * q.s < 0.0; };
  for (const PatchPoint& q : contact.points)
    if (closed(q)) area += q.weight, polar += q.weight * (q.s * q.s + q.t * q.t);
  if (area <= 0.0) return;
  const double twist = worst <= 0.0 && polar > 0.0 ? moment.x() / (p.ks * polar) : 0.0;
  for (std::size_t i = 0; i < contact.points.size(); ++i) {
    const PatchPoint& q = contact.points[i];
    if (!closed(q)) continue;  // an open point holds no shear
    contact.memory[4 * i + 1] = -(force.y() / (p.ks * area) - twist * q.t);
    contact.memory[4 * i + 2] = -(force.z() / (p.ks * area) + twist * q.s);
  }
}

}  // namespace

Vec3 mean_slip(const State& state, const Patch& patch, const Array<double>& points, const PatchMemory& memory) {
  const Jump<double> j = patch_jump(patch, pose_of(state, patch.a), pose_of(state, patch.b));
  Vec3 sum = Vec3::Zero();
  double area = 0.0;
  for (int i = 0; i < patch.point_count; ++i) {
    const double weight = patch_point(patch, points, i).weight;
    sum += weight * Vec3(0.0, memory.point[point_index(patch, i, 2, 0)], memory.point[point_index(patch, i, 2, 1)]);
    area += weight;
  }
  return area > 0.0 ? Vec3(axes_matrix(j) * sum / area) : Vec3::Zero();
}

void carry_over(const Model& model, const State& state, const Patch& old, const Array<double>& points,
                const PatchMemory& memory, double energy, NewContact& contact) {
  match_tractions(model, state, old, points, memory, contact);
  limit_energy(energy, contact);
}

}  // namespace voussoir
