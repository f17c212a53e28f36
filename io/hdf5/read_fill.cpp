#include "io/hdf5/read_fill.h"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

#include "geometry/fill_mesh.h"
#include "io/hdf5/check_patch.h"
#include "io/hdf5/shape_arrays.h"
#include "solver/base/counted.h"

namespace voussoir {

namespace {

/// Rows of N node numbers.
template <std::size_t N>
std::vector<std::array<std::int32_t, N>> read_rows(const h5::File& file, const std::string& name, std::size_t nodes) {
  const auto values = file.read<std::int64_t>(name, {h5::any, N});
  std::vector<std::array<std::int32_t, N>> rows(values.size() / N);
  for (std::size_t i = 0; i < values.size(); ++i) {
    if (values[i] < 0 || values[i] >= std::int64_t(nodes))
      file.fail(name, fmt::format("row {}: node {} is out of range, expected 0 to {}", i / N, values[i],
                                  std::int64_t(nodes) - 1));
    rows[i / N][i % N] = std::int32_t(values[i]);
  }
  return rows;
}

/// The triangles may stand in any order, and begin with any of their corners.
void check_triangles(const h5::File& file, const FillMesh& fill) {
  FillMesh own;
  own.nodes = fill.nodes;
  own.tets = fill.tets;
  find_surface(own);
  std::vector<char> there(own.triangles.size(), 0);
  for (std::size_t i = 0; i < fill.triangles.size(); ++i) {
    auto triangle = fill.triangles[i];
    std::rotate(triangle.begin(), std::min_element(triangle.begin(), triangle.end()), triangle.end());
    const auto at = std::lower_bound(own.triangles.begin(), own.triangles.end(), triangle);
    if (at == own.triangles.end() || *at != triangle)
      file.fail("fill/triangles",
                fmt::format("row {}: nodes {}, {} and {} are not a face of the surface, counter-clockwise "
                            "seen from outside",
                            i, triangle[0], triangle[1], triangle[2]));
    if (std::exchange(there[std::size_t(at - own.triangles.begin())], 1))
      file.fail("fill/triangles", fmt::format("row {}: this triangle is listed twice", i));
  }
  if (fill.triangles.size() != own.triangles.size())
    file.fail("fill/triangles", fmt::format("{}, but the surface has {}", counted(fill.triangles.size(), "triangle"),
                                            own.triangles.size()));
}

}  // namespace

FillMesh read_fill(const h5::File& file, std::size_t materials) {
  FillMesh fill;
  if (!file.has("fill/nodes")) return fill;
  const std::vector<double> nodes = read_places(file, "fill/nodes", h5::any);
  for (std::size_t i = 0; i < nodes.size(); i += 3) fill.nodes.emplace_back(nodes[i], nodes[i + 1], nodes[i + 2]);
  fill.tets = read_rows<4>(file, "fill/tets", fill.nodes.size());
  if (fill.tets.empty()) file.fail("fill/tets", "there are no tetrahedra: leave the group out");
  fill.material = file.read<std::int32_t>("fill/material", {fill.tets.size()});
  for (std::size_t i = 0; i < fill.material.size(); ++i)
    if (fill.material[i] < 0 || std::size_t(fill.material[i]) >= materials)
      file.fail("fill/material", fmt::format("row {}: {} is out of range, expected 0 to {}, a row of materials/*", i,
                                             fill.material[i], std::int64_t(materials) - 1));
  check_fill(fill, file.path() + ": fill/tets");
  if (!file.has("fill/triangles")) {
    find_surface(fill);
    return fill;
  }
  fill.triangles = read_rows<3>(file, "fill/triangles", fill.nodes.size());
  check_triangles(file, fill);
  return fill;
}

void check_fill_joint(const h5::File& file, std::size_t row, const Assembly& assembly, const FillJoint& joint) {
  const auto fail = [&](const char* name, const std::string& reason) {
    file.fail(name, fmt::format("row {} (block {} and triangle {} of the fill): {}", row, joint.block, joint.triangle,
                                reason));
  };
  check_patch(joint, fail);
  const Polygon triangle = triangle_polygon(assembly.fill, joint.triangle);
  const Vec3 outward = polygon_normal(triangle);
  if (outward.dot(joint.normal) > -0.99) fail("joints/normal", "it must point out of the stone into the fill");
  const double size = std::sqrt(polygon_area(triangle));
  for (const Vec3& p : joint.polygon)
    if (std::abs(outward.dot(p - triangle[0])) > 0.01 * size)
      fail("joints/polygon", "it is not in the plane of the triangle");
  const auto& cells = assembly.blocks[std::size_t(joint.block)].cells;
  if (joint.cell < 0 || joint.cell >= std::int32_t(cells.size()))
    fail("joints/cells", fmt::format("block {} has no cell {}", joint.block, joint.cell));
  if (joint.face < 0 || joint.face >= std::int32_t(cells[std::size_t(joint.cell)].faces.size()))
    fail("joints/faces", fmt::format("cell {} of block {} has no face {}", joint.cell, joint.block, joint.face));
}

void sort_fill_joints(const h5::File& file, std::vector<FillJoint>& joints) {
  const auto key = [](const FillJoint& j) { return std::tie(j.block, j.cell, j.face, j.triangle); };
  std::stable_sort(joints.begin(), joints.end(),
                   [&](const FillJoint& p, const FillJoint& q) { return key(p) < key(q); });
  const auto twice = std::adjacent_find(joints.begin(), joints.end(),
                                        [&](const FillJoint& p, const FillJoint& q) { return key(p) == key(q); });
  if (twice != joints.end())
    file.fail("joints/blocks", fmt::format("the patch between block {} (face {}) and triangle {} of the fill is listed "
                                           "twice",
                                           twice->block, twice->face, twice->triangle));
}

}  // namespace voussoir
