#include "solver/contact/interface_search.h"

#include <algorithm>
#include <atomic>
#include <numeric>
#include <span>
#include <tuple>
#include <utility>

#include "geometry/neighbours.h"
#include "solver/base/error.h"
#include "solver/base/parallel.h"
#include "solver/contact/interface_change.h"
#include "solver/contact/interface_jump.h"
#include "solver/contact/make_contact.h"
#include "solver/contact/search.h"

namespace voussoir {

namespace {

constexpr double facing = 0.5;             // |n_face + n_triangle|: 29 degrees
constexpr double least_face_share = 0.01;  // of a block's face: overlaps that carry nothing

/// A triangle of the fill's surface where it is.
struct Sheet {
  Polygon corners;
  Vec3 normal = Vec3::Zero();  // out of the fill
};

struct Overlap {
  int face = -1;
  Polygon polygon;       // in the face's plane, counter-clockwise about its normal
  double area = 0.0;     // m2
  double nearest = 0.0;  // m, least distance of the triangle from the plane over the overlap; negative: inside
};

Overlap overlap(const Convex& cell, int face, const Sheet& sheet) {
  const Plane& plane = cell.planes[std::size_t(face)];
  Polygon flat, outline;
  double height[3];
  for (std::size_t k = 3; k-- > 0;) {
    height[k] = plane.normal.dot(sheet.corners[k]) - plane.offset;
    flat.push_back(sheet.corners[k] - height[k] * plane.normal);
  }
  for (const int v : cell.faces[std::size_t(face)]) outline.push_back(cell.vertices[std::size_t(v)]);
  Overlap found;
  found.face = face;
  if (polygon_normal(flat).dot(plane.normal) <= 0.0) return found;  // turned over
  found.polygon = cleaned(intersect(flat, outline, plane.normal));
  if (found.polygon.size() < 3) return found;
  found.area = polygon_area(found.polygon);
  // The height over the plane is affine: with the triangle's own normal N, N · (p + h n) is the same everywhere.
  const double slope = sheet.normal.dot(plane.normal);
  found.nearest = 1e300;
  for (const Vec3& p : found.polygon)
    found.nearest = std::min(found.nearest, sheet.normal.dot(sheet.corners[0] - p) / slope);
  return found;
}

using Key = std::tuple<std::int32_t, std::int32_t, std::int32_t>;  // body, cell, triangle

class InterfaceSearch {
 public:
  InterfaceSearch(const Model& model, State& state, const Branches& branches, int threads)
      : model_(model), state_(state), branches_(branches), threads_(threads) {
    change_.gone.assign(state.interface.patches.size(), 0);
  }

  InterfaceUpdate run(bool clip) {
    if (clip) look_at_those_past();
    if (model_.contact.search && is_due()) look_around();
    if (update_.changed()) change_interface(model_, state_, branches_.count, std::move(change_));
    return update_;
  }

 private:
  Vec3 node_at(std::int32_t node) const {
    return model_.fill.nodes[std::size_t(node)] + Vec3(&state_.fill.pose[node_width * std::size_t(node)]);
  }

  Sheet sheet_of(std::int32_t triangle) const {
    Sheet sheet;
    for (const std::int32_t node : model_.fill.triangles[std::size_t(triangle)]) sheet.corners.push_back(node_at(node));
    sheet.normal = polygon_normal(sheet.corners);
    return sheet;
  }

  Box box_of(std::size_t triangle) const {
    const auto& nodes = model_.fill.triangles[triangle];
    Box box = {node_at(nodes[0]), node_at(nodes[0])};
    for (std::size_t k = 1; k < 3; ++k) join(box, {node_at(nodes[k]), node_at(nodes[k])});
    return box;
  }

  /// Whether the middle of a patch has slid past the limit since it was clipped.
  bool past(std::size_t slot) const {
    const InterfacePatch& patch = state_.interface.patches[slot];
    if (!state_.interface.used(slot) || model_.laws[std::size_t(patch.law)].kind == JointLaw::Kind::elastic)
      return false;
    const InterfaceJump j = interface_jump(model_, state_, patch);
    const Vec3 u = j.point(shape_functions(patch), 0.0, 0.0);
    return u[1] * u[1] + u[2] * u[2] > model_.slip_limit2(patch.area);
  }

  /// What becomes of a patch that has slid past the limit: one that is clipped anew, or none.
  struct Clipped {
    double energy = 0.0;  // J, of the old one
    bool stays = false;
    InterfacePatch patch;
  };

  void look_at_those_past() {
    std::vector<char> is_past(change_.gone.size(), 0);
    for_each(is_past.size(), threads_, 1000, [&](std::size_t slot) { is_past[slot] = past(slot); });
    std::vector<std::size_t> slots;
    for (std::size_t slot = 0; slot < is_past.size(); ++slot)
      if (is_past[slot]) slots.push_back(slot);
    std::vector<Clipped> clipped(slots.size());
    for_each(slots.size(), threads_, 20, [&](std::size_t i) { clipped[i] = look_at(slots[i]); });
    for (std::size_t i = 0; i < slots.size(); ++i) enter(slots[i], std::move(clipped[i]));
  }

  Clipped look_at(std::size_t slot) const {
    const InterfacePatch& old = state_.interface.patches[slot];
    const InterfaceJump j = interface_jump(model_, state_, old);
    Clipped clipped;
    clipped.energy = interface_energy(model_, state_, slot);
    const Overlap now = overlap(placed_cell(model_, state_, old.body, old.cell), old.face, sheet_of(old.triangle));
    clipped.stays = now.area >= least_area();
    if (clipped.stays) clipped.patch = moved_patch(slot, j, now);
    return clipped;
  }

  void enter(std::size_t slot, Clipped clipped) {
    change_.energy_before += clipped.energy;
    change_.gone[slot] = 1;
    if (clipped.stays) {
      note(clipped.patch);
      change_.fresh.push_back(std::move(clipped.patch));
      ++update_.clipped;
      return;
    }
    for (std::size_t c = 0; c < 3; ++c)
      state_.retired_energy()[c] += state_.interface_memory.energy[energy_index(place_of_slot(slot), c)];
    ++update_.dropped;
  }

  /// For whoever asks whether the critical step holds.
  void note(const InterfacePatch& patch) {
    update_.bodies.push_back(patch.body);
    update_.nodes.insert(update_.nodes.end(), patch.node, patch.node + 3);
  }

  double least_area() const { return least_face_share * model_.typical_size * model_.typical_size; }

  /// The old patch with another outline. It keeps what its corners have moved across the face, less the mean opening by
  /// dilation, and, along the face, the mean elastic part: no plastic jump is left, and the tractions are as before.
  InterfacePatch moved_patch(std::size_t slot, const InterfaceJump& j, const Overlap& now) const {
    const InterfacePatch& old = state_.interface.patches[slot];
    InterfacePatch patch = old;
    patch.from = std::int32_t(slot);
    set_outline(now.polygon, j.axes, j.centroid, patch);
    const std::array<double, 2> elastic = mean_elastic(slot, j);
    const Vec3 slid = j.point(shape_functions(old), 0.0, 0.0) - Vec3(0.0, elastic[0], elastic[1]);
    const Vec3 own =
        Eigen::Quaterniond(old.frame[0], old.frame[1], old.frame[2], old.frame[3]) * Vec3(0.0, slid[1], slid[2]);
    for (int c = 0; c < 3; ++c) patch.slid[c] += own[c];
    const double opened = mean_dilation(slot);
    for (std::size_t k = 0; k < 3; ++k) {
      const Vec3 moved(j.moved[k][0] - opened, elastic[0], elastic[1]);
      set_rest(j.axes, patch, k, moved);
    }
    patch.again = true;
    return patch;
  }

  /// Mean elastic jump along s and t, m.
  std::array<double, 2> mean_elastic(std::size_t slot, const InterfaceJump& j) const {
    const InterfacePatch& old = state_.interface.patches[slot];
    const Mat3 shape = shape_functions(old);
    double area = 0.0;
    Vec3 sum = Vec3::Zero();
    for (std::size_t i = 0; i < old.points.size(); ++i) {
      area += old.points[i].weight;
      sum += old.points[i].weight * elastic_point(model_, state_, slot, j, shape, i);
    }
    return {sum[1] / area, sum[2] / area};
  }

  /// Mean opening by dilation, m. It causes no traction, and the points of the new patch begin without it.
  double mean_dilation(std::size_t slot) const {
    const std::vector<PatchPoint>& points = state_.interface.patches[slot].points;
    double area = 0.0, sum = 0.0;
    for (std::size_t i = 0; i < points.size(); ++i) {
      area += points[i].weight;
      sum += points[i].weight * state_.interface_memory.point_rest[state_.interface.point_index(slot, i, 2, 0)];
    }
    return sum / area;
  }

  /// Outline, points and place of a patch whose axes are these now.
  void set_outline(const Polygon& polygon, const Mat3& axes, const Vec3& centroid, InterfacePatch& patch) const {
    PatchShape shape = patch_shape(polygon, axes.col(0), model_.contact.points_per_side);
    shape.points = moment_points(shape);
    turn_into(axes, shape);
    const Vec3 arm = rotation_of(state_, std::size_t(patch.body)).conjugate() * (shape.centroid - centroid);
    for (int c = 0; c < 3; ++c) patch.arm[c] = arm[c];
    patch.area = shape.area;
    patch.points = shape.points, patch.corners = shape.corners;
  }

  /// A shape's points in other axes of the same plane.
  static void turn_into(const Mat3& axes, PatchShape& shape) {
    const Eigen::Matrix2d turn = axes.rightCols<2>().transpose() * shape.frame.rightCols<2>();
    for (std::vector<PatchPoint>* list : {&shape.points, &shape.corners})
      for (PatchPoint& p : *list) {
        const Eigen::Vector2d q = turn * Eigen::Vector2d(p.s, p.t);
        p.s = q[0], p.t = q[1];
      }
  }

  void set_rest(const Mat3& axes, InterfacePatch& patch, std::size_t k, const Vec3& moved) const {
    const auto body = std::size_t(patch.body);
    const Vec3 origin = model_.bodies[body].centroid + Vec3(&state_.pose[pose_width * body]) +
                        rotation_of(state_, body) * Vec3(patch.arm);
    const Vec3 rest = axes.transpose() * (node_at(patch.node[k]) - origin) - moved;
    for (int c = 0; c < 3; ++c) patch.rest[k][c] = rest[c];
  }

  /// Whether some stone or node has gone so far since it was last noted that what is about it must be looked at.
  bool is_due() const {
    const double far = search_distance(model_);
    const Vec3 base = state_.base_displacement();
    std::atomic<bool> due = false;
    for_each(model_.bodies.size(), threads_, 5000, [&](std::size_t i) {
      if (moved_since(model_, state_, state_.interface_seen, i, base) > far) due.store(true, std::memory_order_relaxed);
    });
    for_each(model_.fill.nodes.size(), threads_, 10000, [&](std::size_t i) {
      if (node_moved2(i) > far * far) due.store(true, std::memory_order_relaxed);
    });
    return due;
  }

  /// How far a node has moved relative to the base since it was noted, squared, m2.
  double node_moved2(std::size_t node) const {
    double d2 = 0.0;
    for (std::size_t c = 0; c < 3; ++c) {
      const double now = state_.fill.pose[node_width * node + c] - state_.base_displacement()[Eigen::Index(c)];
      const double far = now - double(state_.fill.searched[node_width * node + c]);
      d2 += far * far;
    }
    return d2;
  }

  /// A face of a cell and a triangle that have come near each other without a patch between them.
  struct Found {
    Key key;
    Overlap overlap;
    Vec3 normal;
  };

  /// What has moved meets what it may have come near.
  void look_around() {
    const std::vector<char> bodies = moved_bodies(), triangles = moved_triangles();
    std::vector<Box> sheets(triangles.size());
    for_each(sheets.size(), threads_, 2000, [&](std::size_t i) { sheets[i] = box_of(i); });
    Box surface, moved;
    for (std::size_t i = 0; i < sheets.size(); ++i) {
      join(surface, sheets[i]);
      if (triangles[i]) join(moved, sheets[i]);
    }
    index_patches();
    const BoxIndex index(sheets, skin(model_));
    std::vector<std::vector<Found>> found(bodies.size());
    for_each(bodies.size(), threads_, 200, [&](std::size_t b) {
      if (is_near(b, bodies[b] ? surface : moved)) found[b] = look_about(b, bodies[b], triangles, index);
    });
    for (const std::vector<Found>& of_body : found)
      for (const Found& f : of_body) add(f);
  }

  bool is_near(std::size_t body, const Box& box) const {
    const Vec3 at = model_.bodies[body].centroid + Vec3(&state_.pose[pose_width * body]);
    const double reach = model_.bodies[body].radius + skin(model_);
    return !state_.lost(body) && ((box.low - at).array() <= reach).all() && ((at - box.high).array() <= reach).all();
  }

  /// Between the cells of a body, which `moves` or not, and triangles: in the order of cells, then of triangles.
  std::vector<Found> look_about(std::size_t body, bool moves, const std::vector<char>& triangles,
                                const BoxIndex& index) const {
    std::vector<Found> found;
    std::vector<int> near;
    for (std::size_t cell = 0; cell < model_.cells[body].size(); ++cell) {
      const Key key(std::int32_t(body), std::int32_t(cell), 0);
      index.near(cell_box(body, cell), near);
      std::erase_if(near, [&](int t) { return !(moves || triangles[std::size_t(t)]) || is_known(key, t); });
      if (near.empty()) continue;
      const Convex placed = placed_cell(model_, state_, std::get<0>(key), std::get<1>(key));
      for (const int t : near) {
        Overlap best = best_overlap(placed, sheet_of(t));
        if (best.face < 0) continue;
        const Vec3 normal = placed.planes[std::size_t(best.face)].normal;
        found.push_back({{std::get<0>(key), std::get<1>(key), t}, std::move(best), normal});
      }
    }
    return found;
  }

  Box cell_box(std::size_t body, std::size_t cell) const {
    const Vec3 centroid = model_.bodies[body].centroid, at = centroid + Vec3(&state_.pose[pose_width * body]);
    const Mat3 turn = rotation_of(state_, body).toRotationMatrix();
    Box box;
    for (const Vec3& v : model_.cells[body][cell].vertices) {
      const Vec3 p = at + turn * (v - centroid);
      join(box, {p, p});
    }
    return box;
  }

  static void join(Box& box, const Box& other) {
    box.low = box.low.cwiseMin(other.low), box.high = box.high.cwiseMax(other.high);
  }

  /// The patches of each triangle, and whether they stay, anew or as they are.
  void index_patches() {
    const Interface& interface = state_.interface;
    stays_.assign(interface.patches.size(), 0);
    first_slot_.assign(model_.fill.triangles.size() + 1, 0);
    for (std::size_t slot = 0; slot < stays_.size(); ++slot) {
      if (!interface.used(slot)) continue;
      stays_[slot] = !change_.gone[slot];
      ++first_slot_[std::size_t(interface.patches[slot].triangle) + 1];
    }
    for (const InterfacePatch& patch : change_.fresh) stays_[std::size_t(patch.from)] = 1;
    std::partial_sum(first_slot_.begin(), first_slot_.end(), first_slot_.begin());
    slots_.resize(first_slot_.back());
    std::vector<std::size_t> next(first_slot_.begin(), first_slot_.end() - 1);
    for (std::size_t slot = 0; slot < stays_.size(); ++slot)
      if (interface.used(slot)) slots_[next[std::size_t(interface.patches[slot].triangle)]++] = slot;
  }

  /// Slots of a triangle's patches, as they were before the search; lowest first.
  std::span<const std::size_t> slots_of(std::int32_t triangle) const {
    const std::size_t first = first_slot_[std::size_t(triangle)];
    return std::span(slots_).subspan(first, first_slot_[std::size_t(triangle) + 1] - first);
  }

  bool is_known(const Key& key, std::int32_t triangle) const {
    for (const std::size_t slot : slots_of(triangle)) {
      const InterfacePatch& patch = state_.interface.patches[slot];
      if (patch.body == std::get<0>(key) && patch.cell == std::get<1>(key) && stays_[slot]) return true;
    }
    return false;
  }

  std::vector<char> moved_bodies() {
    std::vector<char> moved(model_.bodies.size(), 0);
    const double near = moved_share * skin(model_);
    const Vec3 base = state_.base_displacement();
    for_each(moved.size(), threads_, 5000, [&](std::size_t i) {
      if (moved_since(model_, state_, state_.interface_seen, i, base) <= near) return;
      moved[i] = 1;
      note_place(state_, i, state_.interface_seen);
    });
    return moved;
  }

  std::vector<char> moved_triangles() {
    std::vector<char> nodes(model_.fill.nodes.size(), 0), moved(model_.fill.triangles.size(), 0);
    const double near = moved_share * skin(model_);
    for_each(nodes.size(), threads_, 10000, [&](std::size_t i) {
      if (node_moved2(i) <= near * near) return;
      nodes[i] = 1;
      for (std::size_t c = 0; c < 3; ++c)
        state_.fill.searched[node_width * i + c] =
            float(state_.fill.pose[node_width * i + c] - state_.base_displacement()[Eigen::Index(c)]);
    });
    for_each(moved.size(), threads_, 10000, [&](std::size_t i) {
      for (const std::int32_t node : model_.fill.triangles[i]) moved[i] |= nodes[std::size_t(node)];
    });
    return moved;
  }

  /// A patch where a face that looks at the triangle is within the skin. It has no bond; where it is found inside, it
  /// begins with no more force than the triangle's other patches have.
  void add(const Found& found) {
    const Overlap& best = found.overlap;
    InterfacePatch patch;
    std::tie(patch.body, patch.cell, patch.triangle) = found.key;
    patch.face = best.face;
    const auto& corners = model_.fill.triangles[std::size_t(patch.triangle)];
    std::copy(corners.begin(), corners.end(), patch.node);
    set_law(patch);
    const Mat3 axes = patch_shape(best.polygon, found.normal, model_.contact.points_per_side).frame;
    const auto body = std::size_t(patch.body);
    const Eigen::Quaterniond own = rotation_of(state_, body).conjugate() * Eigen::Quaterniond(axes);
    const double frame[4] = {own.w(), own.x(), own.y(), own.z()};
    std::copy(frame, frame + 4, patch.frame);
    set_outline(best.polygon, axes, model_.bodies[body].centroid + Vec3(&state_.pose[pose_width * body]), patch);
    const double lift = std::max(0.0, -best.nearest - deepest_beside(patch.triangle));
    for (std::size_t k = 0; k < 3; ++k)
      set_rest(axes, patch, k, Vec3(found.normal.dot(node_at(corners[k]) - best.polygon[0]) + lift, 0.0, 0.0));
    note(patch);
    change_.fresh.push_back(std::move(patch));
    ++update_.made;
  }

  Overlap best_overlap(const Convex& placed, const Sheet& sheet) const {
    const double within = skin(model_);
    Overlap best;
    for (int face = 0; face < int(placed.planes.size()); ++face) {
      if ((placed.planes[std::size_t(face)].normal + sheet.normal).norm() > facing) continue;
      Overlap found = overlap(placed, face, sheet);
      if (found.area < least_area() || found.area <= best.area || std::abs(found.nearest) > within) continue;
      best = std::move(found);
    }
    return best;
  }

  /// m: how far the triangle's other patches are pressed in.
  double deepest_beside(std::int32_t triangle) const {
    double deepest = 0.0;
    for (const std::size_t slot : slots_of(triangle)) {
      const InterfacePatch& other = state_.interface.patches[slot];
      const InterfaceJump j = interface_jump(model_, state_, other);
      const Mat3 shape = shape_functions(other);
      for (const PatchPoint& p : other.points) deepest = std::max(deepest, -j.point(shape, p.s, p.t)[0]);
    }
    return deepest;
  }

  /// As the stone's other patches, or the triangle's, or the first there is.
  void set_law(InterfacePatch& patch) {
    if (state_.interface.patches.empty())
      throw RunError(
          "block {} touches a fill that has no joint with any stone, so the law of the contact is not known. Give the "
          "fill at least one joint with a stone",
          model_.block_of_body[std::size_t(patch.body)]);
    const std::span<const std::size_t> beside = slots_of(patch.triangle);
    const std::int64_t same = first_slot_of_body(patch.body);
    const std::size_t slot = same >= 0 ? std::size_t(same) : beside.empty() ? 0 : beside.front();
    const InterfacePatch& like = state_.interface.patches[slot];
    patch.law = like.law, patch.kn = like.kn, patch.ks = like.ks;
  }

  /// The lowest slot with a patch of the body, −1: none.
  std::int64_t first_slot_of_body(std::int32_t body) {
    if (of_body_.empty()) {  // most searches find nothing that asks
      of_body_.assign(model_.bodies.size(), -1);
      for (std::size_t slot = stays_.size(); slot-- > 0;)
        if (state_.interface.used(slot))
          of_body_[std::size_t(state_.interface.patches[slot].body)] = std::int64_t(slot);
    }
    return of_body_[std::size_t(body)];
  }

  const Model& model_;
  State& state_;
  const Branches& branches_;
  int threads_;
  InterfaceUpdate update_;
  InterfaceChange change_;
  std::vector<char> stays_;                      // of each slot
  std::vector<std::size_t> first_slot_, slots_;  // of each triangle, and one past the end
  std::vector<std::int64_t> of_body_;
};

}  // namespace

InterfaceUpdate update_interface(const Model& model, State& state, const Branches& branches, bool clip, int threads) {
  if (model.fill.empty()) return {};
  return InterfaceSearch(model, state, branches, threads).run(clip);
}

}  // namespace voussoir
