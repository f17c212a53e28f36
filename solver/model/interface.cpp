#include "solver/model/interface.h"

#include <algorithm>
#include <numeric>
#include <tuple>

#include "solver/base/error.h"

namespace voussoir {

namespace {

InterfacePatch make_patch(const Assembly& assembly, const FillJoint& joint, const Model& model) {
  const PatchShape shape = patch_shape(joint.polygon, joint.normal, model.contact.points_per_side);
  InterfacePatch patch;
  patch.body = model.body_of_block[std::size_t(joint.block)];
  patch.cell = joint.cell, patch.face = joint.face, patch.triangle = joint.triangle;
  patch.law = joint.law;
  patch.kn = joint.kn, patch.ks = joint.ks, patch.area = shape.area;
  store(patch.arm, shape.centroid - assembly.blocks[std::size_t(joint.block)].centroid);
  const Eigen::Quaterniond q(shape.frame);
  const double frame[4] = {q.w(), q.x(), q.y(), q.z()};
  std::copy(frame, frame + 4, patch.frame);
  for (std::size_t k = 0; k < 3; ++k) {
    patch.node[k] = model.fill.node_of[std::size_t(assembly.fill.triangles[std::size_t(joint.triangle)][k])];
    store(patch.rest[k], shape.frame.transpose() * (model.fill.nodes[std::size_t(patch.node[k])] - shape.centroid));
  }
  patch.points = moment_points(shape), patch.corners = shape.corners;
  return patch;
}

void fill_lane(const InterfacePatch& patch, const Model& model, int lane, InterfaceBatch& batch) {
  PatchBatch& b = batch.patch;
  b.pose_a[lane] = pose_width * patch.body;
  b.law_of[lane] = patch.law;
  b.kn[lane] = patch.kn, b.ks[lane] = patch.ks, b.area[lane] = patch.area;
  const Vec3 at = model.bodies[std::size_t(patch.body)].centroid + Vec3(patch.arm);
  for (int c = 0; c < 3; ++c) b.arm_a[c][lane] = patch.arm[c], b.place[c][lane] = at[c];
  for (int c = 0; c < 4; ++c) b.frame[c][lane] = patch.frame[c];
  for (std::size_t i = 0; i < 2; ++i)
    batch.point[i][0][lane] = patch.points[i].s, batch.point[i][1][lane] = patch.points[i].t;
  for (int k = 0; k < 3; ++k) {
    batch.node[k][lane] = patch.node[k];
    for (int c = 0; c < 3; ++c) {
      batch.lever[k][c][lane] = model.fill.nodes[std::size_t(patch.node[k])][c] - at[c];
      batch.rest[k][c][lane] = patch.rest[k][c];
    }
  }
}

/// The patches of each node, in ascending order.
void index_nodes(std::size_t nodes, Interface& interface) {
  const auto each = [&](const auto& use) {
    for (std::size_t slot = 0; slot < interface.patches.size(); ++slot)
      for (std::size_t k = 0; interface.used(slot) && k < 3; ++k)
        use(std::size_t(interface.patches[slot].node[k]), std::int32_t(3 * slot + k));
  };
  interface.first_of_node.assign(nodes + 1, 0);
  each([&](std::size_t node, std::int32_t) { ++interface.first_of_node[node + 1]; });
  std::partial_sum(interface.first_of_node.begin(), interface.first_of_node.end(), interface.first_of_node.begin());
  interface.of_node.resize(std::size_t(interface.first_of_node.back()));
  std::vector<std::int32_t> next(interface.first_of_node.begin(), interface.first_of_node.end() - 1);
  each([&](std::size_t node, std::int32_t entry) { interface.of_node[std::size_t(next[node]++)] = entry; });
}

/// The nodes that the batches from `first` to `end` touch, each once and in order.
std::vector<std::int32_t> nodes_of(const Interface& interface, std::int32_t first, std::int32_t end) {
  std::vector<std::int32_t> nodes;
  for (auto k = std::size_t(first); k < std::size_t(end); ++k)
    for (const auto& corner : interface.batches[k].node) nodes.insert(nodes.end(), corner, corner + lane_count);
  std::sort(nodes.begin(), nodes.end());
  nodes.erase(std::unique(nodes.begin(), nodes.end()), nodes.end());
  return nodes;
}

/// Gives every tile of bodies a sum for each node it touches.
void place_sums(std::size_t nodes, Interface& interface) {
  std::vector<std::pair<std::int32_t, std::int32_t>> sums;  // node, sum
  interface.first_sum.assign(1, 0);
  for (std::size_t tile = 0; tile + 1 < interface.first_batch.size(); ++tile) {
    const std::int32_t first = interface.first_batch[tile], end = interface.first_batch[tile + 1];
    const std::vector<std::int32_t> touched = nodes_of(interface, first, end);
    for (auto k = std::size_t(first); k < std::size_t(end); ++k)
      for (int i = 0; i < 3; ++i)
        for (int lane = 0; lane < lane_count; ++lane) {
          const auto at = std::lower_bound(touched.begin(), touched.end(), interface.batches[k].node[i][lane]);
          interface.batches[k].sum[i][lane] = interface.first_sum.back() + std::int32_t(at - touched.begin());
        }
    for (const std::int32_t node : touched) sums.emplace_back(node, std::int32_t(sums.size()));
    interface.first_sum.push_back(std::int32_t(sums.size()));
  }
  std::sort(sums.begin(), sums.end());
  interface.first_sum_of_node.assign(nodes + 1, 0), interface.sum_of_node.clear();
  for (const auto& [node, sum] : sums) {
    ++interface.first_sum_of_node[std::size_t(node) + 1];
    interface.sum_of_node.push_back(sum);
  }
  std::partial_sum(interface.first_sum_of_node.begin(), interface.first_sum_of_node.end(),
                   interface.first_sum_of_node.begin());
}

}  // namespace

Mat3 shape_functions(const InterfacePatch& patch) {
  Mat3 corners;
  for (int k = 0; k < 3; ++k) corners.row(k) << 1.0, patch.rest[k][1], patch.rest[k][2];
  return corners.inverse().transpose();
}

std::vector<InterfacePatch> interface_patches(const Assembly& assembly, const Model& model) {
  std::vector<InterfacePatch> patches;
  for (const FillJoint& joint : assembly.fill_joints) {
    if (!(joint.kn > 0.0) || !(joint.ks > 0.0))
      throw InputError(
          "the patch between block {} and triangle {} of the fill has kn = {} and ks = {} Pa/m. Both must be above 0.",
          joint.block, joint.triangle, joint.kn, joint.ks);
    patches.push_back(make_patch(assembly, joint, model));
  }
  return patches;
}

namespace {

/// Calls `use` with every number of a patch that a row holds, in order.
template <class Patch, class Use>
void each_number(Patch& p, const Use& use) {
  for (auto* whole : {&p.body, &p.cell, &p.face, &p.triangle, &p.law}) use(*whole);
  for (auto* number : {&p.kn, &p.ks, &p.area}) use(*number);
  for (auto& x : p.arm) use(x);
  for (auto& x : p.frame) use(x);
  for (auto& corner : p.rest)
    for (auto& x : corner) use(x);
  for (auto& x : p.slid) use(x);
}

}  // namespace

void flatten(const Interface& interface, Array<double>& rows, Array<double>& points, Array<double>& corners) {
  rows.clear(), points.clear(), corners.clear();
  for (std::size_t slot = 0; slot < interface.patches.size(); ++slot) {
    if (interface.spare(slot)) continue;
    const InterfacePatch& p = interface.patches[slot];
    each_number(p, [&](auto x) { rows.push_back(double(x)); });
    rows.insert(rows.end(), {double(p.points.size()), double(p.corners.size())});
    for (const PatchPoint& q : p.points) points.insert(points.end(), {q.s, q.t, q.weight});
    for (const PatchPoint& q : p.corners) corners.insert(corners.end(), {q.s, q.t});
  }
}

std::vector<InterfacePatch> unflatten(const Array<double>& rows, const Array<double>& points,
                                      const Array<double>& corners, const FillModel& fill) {
  std::vector<InterfacePatch> patches;
  const double *point = points.data(), *corner = corners.data();
  for (std::size_t row = 0; row + interface_columns <= rows.size(); row += interface_columns) {
    const double* at = &rows[row];
    InterfacePatch p;
    each_number(p, [&](auto& x) { x = std::remove_reference_t<decltype(x)>(*at++); });
    for (std::size_t k = 0; k < 3; ++k) p.node[k] = fill.triangles.at(std::size_t(p.triangle))[k];
    for (auto left = std::int64_t(at[0]); left > 0; --left, point += 3)
      p.points.push_back({point[0], point[1], point[2]});
    for (auto left = std::int64_t(at[1]); left > 0; --left, corner += 2)
      p.corners.push_back({corner[0], corner[1], 0.0});
    patches.push_back(std::move(p));
  }
  return patches;
}

namespace {

/// Tile by tile those that are computed alike side by side.
std::vector<InterfacePatch> sorted(std::vector<InterfacePatch> patches, const Model& model) {
  const auto key = [&model](const InterfacePatch& p) {
    int facing = 0;
    const Eigen::Quaterniond q(p.frame[0], p.frame[1], p.frame[2], p.frame[3]);
    (q * Vec3::UnitX()).cwiseAbs().maxCoeff(&facing);
    return std::tuple(model.tile_of(p.body), p.points.size(), p.law, facing, p.body, p.cell, p.face, p.triangle);
  };
  std::vector<std::pair<decltype(key(patches[0])), std::size_t>> order;
  order.reserve(patches.size());
  for (std::size_t i = 0; i < patches.size(); ++i) order.emplace_back(key(patches[i]), i);
  std::sort(order.begin(), order.end());
  std::vector<InterfacePatch> out;
  out.reserve(patches.size());
  for (const auto& [of, i] : order) out.push_back(std::move(patches[i]));
  return out;
}

}  // namespace

Interface make_interface(std::vector<InterfacePatch> patches, const Model& model) {
  Interface interface;
  patches = sorted(std::move(patches), model);
  interface.first_batch.assign(model.tiles.size() + 1, 0);
  for (std::size_t i = 0; i < patches.size();) {
    const InterfacePatch& head = patches[i];
    const auto like = [&](const InterfacePatch& p) {
      return model.tile_of(p.body) == model.tile_of(head.body) && p.points.size() == head.points.size();
    };
    int count = 1;
    while (count < lane_count && i + std::size_t(count) < patches.size() && like(patches[i + std::size_t(count)]))
      ++count;
    InterfaceBatch batch{};
    batch.tile = model.tile_of(head.body);
    batch.patch.count = count;
    for (int lane = 0; lane < lane_count; ++lane) {
      const InterfacePatch& patch = patches[i + std::size_t(std::min(lane, count - 1))];
      fill_lane(patch, model, lane, batch);
      interface.patches.push_back(patch);
      if (lane >= count) interface.patches.back().area = 0.0;
    }
    batch.patch.law = common_law(batch.patch);
    batch.patch.first_point = std::int32_t(interface.point_rows);
    batch.patch.points = std::int32_t(head.points.size());
    interface.point_rows += head.points.size();
    interface.batches.push_back(batch);
    ++interface.first_batch[std::size_t(batch.tile) + 1];
    i += std::size_t(count);
  }
  std::partial_sum(interface.first_batch.begin(), interface.first_batch.end(), interface.first_batch.begin());
  index_nodes(model.fill.nodes.size(), interface);
  place_sums(model.fill.nodes.size(), interface);
  return interface;
}

void replace_patch(std::size_t slot, const InterfacePatch& patch, const Model& model, Interface& interface) {
  InterfaceBatch& batch = interface.batches[slot / lane_count];
  const std::size_t first = slot - slot % lane_count;
  const bool repeated = slot - first + 1 == std::size_t(batch.patch.count);  // by spare lanes
  for (std::size_t s = slot; s < first + lane_count; ++s) {
    if (s != slot && !(repeated && interface.spare(s))) continue;
    fill_lane(patch, model, int(s - first), batch);
    interface.patches[s] = patch;
    if (s != slot) interface.patches[s].area = 0.0;
  }
}

void empty_patch(std::size_t slot, const Model& model, Interface& interface) {
  InterfacePatch patch = interface.patches[slot];
  patch.area = 0.0;
  for (PatchPoint& point : patch.points) point.weight = 0.0;
  replace_patch(slot, patch, model, interface);
}

}  // namespace voussoir
