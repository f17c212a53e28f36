#include "solver/model/model.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "geometry/curve.h"
#include "solver/base/buckets.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/model/interface.h"

namespace voussoir {

namespace {

/// Edge of a cube as large as the block, m.
double size_of(const Assembly& assembly, const Block& block) {
  return std::cbrt(block.mass / assembly.materials.at(std::size_t(block.material)).density);
}

/// How thick the slabs of the blocks' order are, m. In thick ones fewer bodies are shared by two threads; but tiles
/// that go ahead of each other need a slab in a cache for each step, so where many blocks stand side by side they are
/// thinner.
double slab_thickness(const std::vector<Vec3>& centroids, double block_size) {
  constexpr double thinnest = 1.4, thickest = 3.0;  // of a typical block's size
  constexpr double most = 640;                      // blocks in a slab; eight steps of them are some 6 MB
  const Box box = bounding_box(centroids);
  const double length_of_most = most / double(centroids.size()) * (box.high - box.low).maxCoeff();
  return std::clamp(length_of_most, thinnest * block_size, thickest * block_size);
}

/// Along a space-filling curve, slab by slab: neighbours are near each other in the order. So tiles can go ahead of
/// each other, several steps in one sweep, where what a step reads does not fit in a cache, and few bodies are shared
/// by two threads.
std::vector<std::int64_t> order_of_blocks(const Assembly& assembly) {
  std::vector<Vec3> centroids;
  std::vector<double> sizes;
  for (const Block& block : assembly.blocks) {
    centroids.push_back(block.centroid);
    sizes.push_back(size_of(assembly, block));
  }
  if (sizes.empty()) return {};  // a fill alone
  const auto middle = sizes.begin() + std::ptrdiff_t(sizes.size() / 2);
  std::nth_element(sizes.begin(), middle, sizes.end());
  const std::vector<std::int32_t> order = in_slabs(centroids, slab_thickness(centroids, *middle));
  return {order.begin(), order.end()};
}

void add_bodies(const Assembly& assembly, Model& model) {
  model.block_of_body = order_of_blocks(assembly);
  model.body_of_block.resize(assembly.blocks.size());
  model.bodies.reserve(assembly.blocks.size()), model.cells.reserve(assembly.blocks.size());
  model.matter.reserve(assembly.blocks.size());
  std::vector<double> sizes;
  double weight = 0.0, bottom = 1e300;
  int movable = 0;
  for (std::size_t i = 0; i < model.block_of_body.size(); ++i) {
    const Block& block = assembly.blocks[model.block_of_body[i]];
    model.body_of_block[model.block_of_body[i]] = std::int32_t(i);
    Body body;
    body.centroid = block.centroid;
    body.mass = body.inertial_mass = block.mass;
    body.inertia = block.inertia;
    body.inverse_inertia = block.inertia.inverse();
    body.fixed = block.fixed;
    for (const Polyhedron& cell : block.cells)
      for (const Vec3& v : cell.vertices) body.radius = std::max(body.radius, (v - block.centroid).norm());
    model.bodies.push_back(body);
    model.cells.emplace_back().reserve(block.cells.size());
    for (const Polyhedron& cell : block.cells) {
      model.cells.back().push_back(make_convex(cell));
      for (const Vec3& v : cell.vertices) bottom = std::min(bottom, v.dot(model.up));
    }
    const Material& material = assembly.materials.at(block.material);
    model.matter.push_back({material.youngs_modulus, material.shear_modulus, std::tan(material.friction_angle)});
    if (block.fixed) continue;
    sizes.push_back(size_of(assembly, block));
    // Without gravity, other loads are related to the weight that the blocks would have.
    weight += block.mass * (model.gravity.isZero(0.0) ? 9.81 : model.gravity.norm());
    ++movable;
  }
  const std::size_t tets = assembly.fill.tets.size();
  if (movable == 0 && tets == 0)
    throw InputError("the assembly has no block that can move: all its {} blocks are fixed", assembly.blocks.size());
  if (movable == 0) {  // only fill: the weight of a tetrahedron is the reference
    double mass = 0.0;
    for (const double m : model.fill.mass) mass += m;
    const double each = mass / double(tets);
    sizes.push_back(std::cbrt(each / model.fill.laws.front().density));
    weight = each * (model.gravity.isZero(0.0) ? 9.81 : model.gravity.norm());
    movable = 1;
  }
  std::nth_element(sizes.begin(), sizes.begin() + sizes.size() / 2, sizes.end());
  model.typical_size = sizes[sizes.size() / 2];
  model.average_weight = weight / movable;
  if (!model.up.isZero(0.0)) model.bottom = bottom;
}

PatchShape joint_shape(const Joint& joint, std::size_t index, const Model& model) {
  if (!(joint.kn > 0.0) || !(joint.ks > 0.0))
    throw InputError("joint {} between blocks {} and {} has kn = {} and ks = {} Pa/m. Both must be above 0.", index,
                     joint.a, joint.b, joint.kn, joint.ks);
  if (model.laws[std::size_t(joint.law)].kind == JointLaw::Kind::tie && joint.polygon.size() != 4)
    throw InputError(
        "joint {} between blocks {} and {} is a tie with a polygon of {}. It must have 4 corners, two at each anchor.",
        index, joint.a, joint.b, counted(joint.polygon.size(), "corner"));
  return patch_shape(joint.polygon, joint.normal, model.contact.points_per_side);
}

/// Local axes (columns n, s, t) as a quaternion of a patch.
void store_axes(double* to, const Mat3& axes) {
  const Eigen::Quaterniond e(axes);
  const double q[4] = {e.w(), e.x(), e.y(), e.z()};
  std::copy(q, q + 4, to);
}

/// The bar between its anchors instead of the strip that stands for it: n from b to a, s across the strip.
void make_tie(const Assembly& assembly, const Joint& joint, Patch& patch) {
  const auto [from, to] = tie_anchors(joint);
  Mat3 axes;
  axes.col(0) = (from - to).normalized();
  axes.col(2) = axes.col(0).cross(joint.polygon[1] - joint.polygon[0]).normalized();
  axes.col(1) = axes.col(2).cross(axes.col(0));
  store_axes(patch.e_a, axes);
  store_axes(patch.e_b, axes);
  store(patch.place, from);
  store(patch.shift, to - from);
  store(patch.arm_a, from - assembly.blocks[std::size_t(joint.a)].centroid);
  store(patch.arm_b, to - assembly.blocks[std::size_t(joint.b)].centroid);
  patch.length = (to - from).norm();
  patch.ss = patch.tt = 0.0;
}

/// Everything of a joint's patch but its points and corners.
Patch joint_patch(const Assembly& assembly, const Joint& joint, const PatchShape& shape, const Model& model) {
  Patch patch;
  patch.a = model.body_of_block[joint.a];
  patch.b = model.body_of_block[joint.b];
  patch.cell_a = joint.cell_a;
  patch.cell_b = joint.cell_b;
  patch.law = joint.law;
  store(patch.place, shape.centroid);
  store(patch.arm_a, shape.centroid - assembly.blocks[joint.a].centroid);
  store(patch.arm_b, shape.centroid - assembly.blocks[joint.b].centroid);
  store_axes(patch.e_a, shape.frame);
  store_axes(patch.e_b, shape.frame);
  patch.kn = joint.kn;
  patch.ks = joint.ks;
  patch.area = shape.area;
  patch.ss = shape.ss;
  patch.tt = shape.tt;
  if (model.laws[std::size_t(joint.law)].kind == JointLaw::Kind::tie) make_tie(assembly, joint, patch);
  return patch;
}

/// Fixed bodies that no guide lets move.
void find_still(const Assembly& assembly, const std::vector<Guide>& guides, Model& model) {
  std::vector<bool> guided(model.bodies.size());
  for (const Guide& guide : guides)
    if (const auto group = assembly.groups.find(guide.group); group != assembly.groups.end())
      for (const std::int64_t block : group->second)
        guided[std::size_t(model.body_of_block[std::size_t(block)])] = true;
  model.still_of.assign(model.bodies.size(), -1);
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    if (!model.bodies[i].fixed || guided[i]) continue;
    model.still_of[i] = std::int32_t(model.still.size());
    model.still.push_back(std::int32_t(i));
  }
}

/// Large tiles have fewer batches whose joints are not computed alike, and fewer bodies that belong to others; small
/// ones are needed where there are few for each thread.
std::int32_t bodies_of_tile(std::size_t bodies) {
  return bodies >= 1024 ? 128 : 64;
}

/// The assembly's joints in the order of their batches; returns their shapes in the same, without corners, which the
/// model has by then, and rectangles without points: memory for each by itself takes time.
std::vector<PatchShape> add_joints(const Assembly& assembly, Model& model) {
  // Tile, shape, law, direction faced, pair of bodies, pair of cells, index. Bed joints are pressed, head joints open:
  // in batches of their own those that go point by point hold up fewer of the others.
  using Key = std::tuple<std::int32_t, std::int32_t, std::int32_t, int, std::int32_t, std::int32_t, std::int32_t,
                         std::int32_t, std::int64_t>;
  std::vector<Key> order;
  std::vector<PatchShape> shapes;
  order.reserve(assembly.joints.size()), shapes.reserve(assembly.joints.size());
  std::vector<PatchPoint> corners;  // of all joints as they come
  std::vector<std::size_t> first_corner;
  corners.reserve(4 * assembly.joints.size()), first_corner.reserve(assembly.joints.size() + 1);
  for (std::size_t i = 0; i < assembly.joints.size(); ++i) {
    const Joint& joint = assembly.joints[i];
    shapes.push_back(joint_shape(joint, i, model));
    first_corner.push_back(corners.size());
    corners.insert(corners.end(), shapes[i].corners.begin(), shapes[i].corners.end());
    const std::int32_t shape = shapes[i].rectangle ? 0 : std::int32_t(shapes[i].corners.size());
    using Points = std::vector<PatchPoint>;  // = {} would keep their memory
    shapes[i].corners = Points();
    if (shapes[i].rectangle) shapes[i].points = Points();
    const std::int32_t a = model.body_of_block[joint.a], b = model.body_of_block[joint.b];
    int facing = 2;
    joint.normal.cwiseAbs().maxCoeff(&facing);
    order.emplace_back(model.tile_of_joint(a, b), shape, joint.law, facing, std::min(a, b), std::max(a, b),
                       joint.cell_a, joint.cell_b, std::int64_t(i));
  }
  first_corner.push_back(corners.size());
  sort_by_place(order, model.bodies.size() / std::size_t(model.tile_bodies) + 1,
                [](const Key& key) { return std::get<0>(key); });
  model.joint_places.resize(order.size());
  model.joints.reserve(order.size()), model.joint_of_patch.reserve(order.size()),
      model.corners.reserve(2 * corners.size());
  std::vector<PatchShape> in_order;
  in_order.reserve(shapes.size());
  for (const Key& key : order) {
    const auto index = std::size_t(std::get<8>(key));
    const auto place = std::int32_t(model.joints.size());
    model.joint_places[index] = {place, place, std::get<1>(key)};
    const PatchShape& shape = in_order.emplace_back(std::move(shapes[index]));
    Patch patch = joint_patch(assembly, assembly.joints[index], shape, model);
    patch.first_corner = std::int32_t(model.corners.size() / 2);
    patch.corner_count = std::int32_t(first_corner[index + 1] - first_corner[index]);
    for (std::size_t c = first_corner[index]; c < first_corner[index + 1]; ++c)
      model.corners.insert(model.corners.end(), {corners[c].s, corners[c].t});
    model.joints.push_back(patch);
    model.joint_of_patch.push_back(std::int64_t(index));
  }
  return in_order;
}

}  // namespace

CellPair cells_of(const Patch& p) {
  return p.a < p.b ? CellPair{p.a, p.b, p.cell_a, p.cell_b} : CellPair{p.b, p.a, p.cell_b, p.cell_a};
}

std::int32_t Model::tile_of_joint(std::int32_t a, std::int32_t b) const {
  const bool a_is_still = still_of[std::size_t(a)] >= 0, b_is_still = still_of[std::size_t(b)] >= 0;
  return tile_of(a_is_still == b_is_still ? std::min(a, b) : a_is_still ? b : a);
}

void fill_lane(const Patch& patch, int lane, JointBatch& batch) {
  batch.pose_a[lane] = pose_width * patch.a;
  batch.pose_b[lane] = pose_width * patch.b;
  batch.law_of[lane] = patch.law;
  for (int i = 0; i < 3; ++i) {
    batch.arm_a[i][lane] = patch.arm_a[i];
    batch.arm_b[i][lane] = patch.arm_b[i];
    batch.place[i][lane] = patch.place[i];
  }
  for (int i = 0; i < 4; ++i) batch.frame[i][lane] = patch.e_a[i];
  batch.kn[lane] = patch.kn;
  batch.ks[lane] = patch.ks;
  batch.area[lane] = patch.area;
  batch.ss[lane] = patch.ss;
  batch.tt[lane] = patch.tt;
}

std::int32_t common_law(const PatchBatch& batch) {
  const bool same =
      std::all_of(batch.law_of, batch.law_of + lane_count, [&](auto law) { return law == *batch.law_of; });
  return same ? *batch.law_of : -1;
}

bool touches_still(const Model& model, const JointBatch& batch) {
  bool touches = false;
  for (std::size_t lane = 0; lane < lane_count; ++lane)
    for (const std::int32_t body : {batch.body_a(lane), batch.body_b(lane)})
      touches |= model.still_of[std::size_t(body)] >= 0;
  return touches;
}

namespace {

std::vector<PatchPoint> points_of(const PatchShape& shape, const Model& model) {
  return shape.rectangle ? rectangle_points(shape, model.contact.points_per_side) : shape.points;
}

std::size_t point_count(const PatchShape& shape, const Model& model) {
  const auto per_side = std::size_t(model.contact.points_per_side);
  return shape.rectangle ? per_side * per_side : shape.points.size();
}

/// Points of a batch's joints side by side; missing points and lanes repeat the last with no weight.
void add_points(Model& model, JointBatch& batch, const std::vector<PatchShape>& shapes) {
  const std::int32_t first = batch.first_joint;
  const auto shape_of = [&](std::int32_t joint) -> const PatchShape& { return shapes[std::size_t(joint)]; };
  std::size_t most = 0;
  for (int lane = 0; lane < batch.count; ++lane) most = std::max(most, point_count(shape_of(first + lane), model));
  batch.first_point = std::int32_t(model.point_rows);
  batch.points = std::int32_t(most);
  model.point_rows += most;
  model.points.resize(3 * lane_count * model.point_rows);
  for (int lane = 0; lane < lane_count; ++lane) {
    const std::vector<PatchPoint> points = points_of(shape_of(first + std::min(lane, batch.count - 1)), model);
    Patch place;
    place.first_point = batch.first_point, place.stride = lane_count, place.lane = lane;
    for (int i = 0; i < batch.points; ++i) {
      const PatchPoint& p = points[std::min<std::size_t>(i, points.size() - 1)];
      model.points[point_index(place, i, 3, 0)] = p.s;
      model.points[point_index(place, i, 3, 1)] = p.t;
      model.points[point_index(place, i, 3, 2)] = i < int(points.size()) ? p.weight : 0.0;
    }
    if (lane >= batch.count) continue;
    Patch& patch = model.joints[first + lane];
    patch.first_point = batch.first_point, patch.stride = lane_count, patch.lane = lane;
    patch.batch = std::int32_t(model.batches.size());
    patch.point_count = std::int32_t(points.size());
  }
}

void add_corners(Model& model, JointBatch& batch) {
  batch.first_corner = std::int32_t(model.batch_corners.size());
  model.batch_corners.resize(model.batch_corners.size() + 2 * std::size_t(batch.corners));
  for (int lane = 0; lane < lane_count; ++lane) {
    const Patch& patch = model.joints[std::size_t(batch.first_joint + std::min(lane, batch.count - 1))];
    for (int c = 0; c < batch.corners; ++c) {
      const PatchPoint corner = patch_corner(patch, model.corners, std::min(c, patch.corner_count - 1));
      model.batch_corners[std::size_t(batch.first_corner + 2 * c)][lane] = corner.s;
      model.batch_corners[std::size_t(batch.first_corner + 2 * c + 1)][lane] = corner.t;
    }
  }
}

/// Room for all batches: what grows bit by bit may take twice the memory.
void make_room(Model& model, const std::vector<PatchShape>& shapes) {
  std::size_t batches = 0, rows = 0, corners = 0;
  const auto tile_of = [&](std::size_t i) { return model.tile_of_joint(model.joints[i].a, model.joints[i].b); };
  for (std::size_t first = 0, i = 0; i < model.joints.size(); first = i) {
    std::size_t points = 0, most_corners = std::size_t(JointBatch{}.corners);
    for (; i < model.joints.size() && i < first + lane_count && tile_of(i) == tile_of(first); ++i) {
      points = std::max(points, point_count(shapes[i], model));
      most_corners = std::max(most_corners, std::size_t(model.joints[i].corner_count));
    }
    ++batches, rows += points, corners += most_corners;
  }
  model.batches.reserve(batches);
  model.points.reserve(3 * lane_count * rows), model.batch_corners.reserve(2 * corners);
}

/// Eight joints from `first` on, or as many as there are before `end`; missing corners repeat the last one, missing
/// joints the last joint.
void add_batch(Model& model, std::int32_t first, std::int32_t end, const std::vector<PatchShape>& shapes) {
  JointBatch batch{};
  batch.first_joint = first;
  batch.count = std::min<std::int32_t>(lane_count, end - first);
  batch.rectangles = true;
  for (int lane = 0; lane < lane_count; ++lane) {
    const auto joint = std::size_t(first + std::min(lane, batch.count - 1));
    const Patch& patch = model.joints[joint];
    fill_lane(patch, lane, batch);
    const PatchShape& shape = shapes[joint];
    batch.half_s[lane] = shape.half_s;
    batch.half_t[lane] = shape.half_t;
    batch.corners = std::max(batch.corners, patch.corner_count);
    batch.rectangles &= shape.rectangle;
  }
  batch.law = common_law(batch);
  batch.touches_still = touches_still(model, batch);
  add_corners(model, batch);
  add_points(model, batch, shapes);
  model.batches.push_back(batch);
}

/// Bodies of later tiles, and still ones of other tiles, that a tile's joints touch, each once and in order.
std::vector<std::int32_t> bodies_beyond(const Model& model, const Tile& tile) {
  std::vector<std::int32_t> bodies;
  for (std::int32_t i = tile.first_joint; i < tile.end_joint; ++i)
    for (const std::int32_t body : {model.joints[std::size_t(i)].a, model.joints[std::size_t(i)].b})
      if (body < tile.first_body || body >= tile.end_body) bodies.push_back(body);
  std::sort(bodies.begin(), bodies.end());
  bodies.erase(std::unique(bodies.begin(), bodies.end()), bodies.end());
  return bodies;
}

void place_sums(JointBatch& batch, const Tile& tile, const std::vector<std::int32_t>& beyond) {
  const auto place = [&](std::int32_t body) {
    if (body >= tile.first_body && body < tile.end_body) return tile.first_sum + body - tile.first_body;
    const auto at = std::lower_bound(beyond.begin(), beyond.end(), body) - beyond.begin();
    return tile.first_sum + tile.end_body - tile.first_body + std::int32_t(at);
  };
  for (std::size_t lane = 0; lane < lane_count; ++lane) {
    batch.sum_a[lane] = wrench_width * place(batch.body_a(lane));
    batch.sum_b[lane] = wrench_width * place(batch.body_b(lane));
  }
}

/// Where each body's sums are.
void list_sums(const std::vector<std::int32_t>& body_of_sum, Model& model) {
  model.first_sum.assign(model.bodies.size() + 1, 0);
  for (const std::int32_t body : body_of_sum) ++model.first_sum[std::size_t(body) + 1];
  for (std::size_t i = 0; i < model.bodies.size(); ++i) model.first_sum[i + 1] += model.first_sum[i];
  model.sums.resize(body_of_sum.size());
  auto next = model.first_sum;
  for (std::size_t sum = 0; sum < body_of_sum.size(); ++sum)
    model.sums[std::size_t(next[std::size_t(body_of_sum[sum])]++)] = std::int32_t(sum);
}

/// Tiles with their batches and sums; the joints are sorted by tile.
void make_tiles(Model& model, const std::vector<PatchShape>& shapes) {
  const auto bodies = std::int32_t(model.bodies.size()), joints = std::int32_t(model.joints.size());
  make_room(model, shapes);
  std::vector<std::int32_t> body_of_sum;
  body_of_sum.reserve(2 * model.bodies.size());
  std::int32_t joint = 0;
  for (std::int32_t first_body = 0; first_body < bodies; first_body += model.tile_bodies) {
    Tile tile;
    tile.first_body = first_body;
    tile.end_body = std::min(bodies, first_body + model.tile_bodies);
    tile.first_sum = std::int32_t(body_of_sum.size());
    tile.first_joint = joint;
    while (joint < joints &&
           model.tile_of_joint(model.joints[std::size_t(joint)].a, model.joints[std::size_t(joint)].b) ==
               std::int32_t(model.tiles.size()))
      ++joint;
    tile.end_joint = joint;
    const std::vector<std::int32_t> beyond = bodies_beyond(model, tile);
    tile.end_sum = tile.first_sum + tile.end_body - first_body + std::int32_t(beyond.size());
    tile.first_batch = std::int32_t(model.batches.size());
    for (std::int32_t i = tile.first_joint; i < joint; i += lane_count) add_batch(model, i, joint, shapes);
    tile.end_batch = std::int32_t(model.batches.size());
    for (std::int32_t k = tile.first_batch; k < tile.end_batch; ++k)
      place_sums(model.batches[std::size_t(k)], tile, beyond);
    const auto add_sum = [&](std::int32_t body) {
      const std::int32_t which = model.still_of[std::size_t(body)];
      if (which >= 0) tile.still_sums.push_back({which, std::int32_t(body_of_sum.size())});
      body_of_sum.push_back(body);
      return which < 0;
    };
    for (std::int32_t body = first_body; body < tile.end_body; ++body) add_sum(body);
    for (const std::int32_t body : beyond) {
      if (!add_sum(body)) continue;
      const std::int32_t later = model.tile_of(body);
      if (tile.followers.empty() || tile.followers.back() != later) tile.followers.push_back(later);
    }
    std::sort(tile.still_sums.begin(), tile.still_sums.end(),
              [](const Tile::StillSum& a, const Tile::StillSum& b) { return a.which < b.which; });
    model.tiles.push_back(std::move(tile));
  }
  list_sums(body_of_sum, model);
}

/// One unbonded, frictional law for each coefficient among the materials; a new contact takes the lower of its two
/// bodies'.
void add_contact_laws(Model& model) {
  model.contact_law.reserve(model.matter.size());
  for (const Model::Matter& matter : model.matter) {
    const auto same = [&](const LawConstants& law) {
      return law.kind == JointLaw::Kind::brittle && law.tension == 0.0 && law.cohesion == 0.0 &&
             law.residual_cohesion == 0.0 && law.tan_dilation == 0.0 && law.tan_friction == matter.tan_friction &&
             law.residual_tan_friction == matter.tan_friction;
    };
    auto found = std::find_if(model.laws.begin(), model.laws.end(), same);
    if (found == model.laws.end()) {
      LawConstants law;
      law.tan_friction = law.residual_tan_friction = matter.tan_friction;
      found = model.laws.insert(model.laws.end(), law);
    }
    model.contact_law.push_back(std::int32_t(found - model.laws.begin()));
  }
}

}  // namespace

Model build_model(const Assembly& assembly, const SolverSettings& settings) {
  Model model;
  model.contact = settings.contact;
  model.gravity = settings.gravity;
  if (!model.gravity.isZero(0.0)) model.up = -model.gravity.normalized();
  if (!settings.stages.empty() && settings.stages[0].construction)
    model.plan = construction_plan(assembly, *settings.stages[0].construction);
  model.fill = build_fill(assembly, model.plan.tet);
  add_bodies(assembly, model);
  for (const JointLaw& law : assembly.laws) model.laws.push_back(law_constants(law));
  add_contact_laws(model);
  model.rule = lobatto_rule(model.contact.points_per_side);
  model.tile_bodies = bodies_of_tile(model.bodies.size());
  find_still(assembly, settings.guides, model);
  make_tiles(model, add_joints(assembly, model));
  if (!model.plan.empty()) model.built.assign(6 * model.batches.size(), Singles{});
  model.joint_by_cells.reserve(model.joints.size());
  for (std::size_t i = 0; i < model.joints.size(); ++i)
    if (model.joints[i].length == 0.0)  // stones that a tie holds may still touch
      model.joint_by_cells.emplace_back(cells_of(model.joints[i]), std::int32_t(model.joint_of_patch[i]));
  sort_by_place(model.joint_by_cells, model.bodies.size(), [](const auto& joint) { return joint.first[0]; });
  model.interface = interface_patches(assembly, model);
  return model;
}

}  // namespace voussoir
