// Small hand-made assemblies with known displacements for the tests of pictures and VTK files.
#pragma once
#include <array>
#include <cmath>
#include <numbers>

#include "geometry/assembly.h"
#include "geometry/fill_mesh.h"
#include "geometry/joints.h"
#include "io/vtk/grid.h"
#include "solver/model/fill_memory.h"

namespace voussoir::test {

inline Block make_block(const Polyhedron& shape, Component component, bool fixed = false) {
  Block block;
  block.cells = {shape};
  block.component = component;
  block.fixed = fixed;
  return block;
}

inline void finish(Assembly& assembly) {
  Material stone;
  stone.name = "stone";
  stone.density = 2000.0;
  assembly.materials = {stone};
  JointLaw law;
  law.tension = 1e5;
  law.cohesion = 1e5;
  law.friction_angle = 0.5;
  assembly.laws = {law};
  finish_blocks(assembly);
  find_joints(assembly);
}

/// Two unit cubes, one on the other, the lower one fixed.
inline Assembly two_cubes() {
  Assembly assembly;
  assembly.blocks.push_back(make_block(make_box({0, 0, 0}, {1, 1, 1}), Component::base, true));
  assembly.blocks.push_back(make_block(make_box({0, 0, 1}, {1, 1, 2}), Component::wall));
  finish(assembly);
  return assembly;
}

/// A heap of four tetrahedra about the middle of its base: on a fixed cube, 1 m high.
inline Assembly heap_on_cube() {
  Assembly assembly;
  assembly.blocks.push_back(make_block(make_box({0, 0, -1}, {1, 1, 0}), Component::base, true));
  finish(assembly);
  assembly.materials.push_back(assembly.materials[0]);
  assembly.materials[1].name = "soil";
  FillMesh& fill = assembly.fill;
  fill.nodes = {{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}, {0.5, 0.5, 0}, {0.5, 0.5, 1}};
  fill.tets = {{0, 1, 4, 5}, {1, 2, 4, 5}, {2, 3, 4, 5}, {3, 0, 4, 5}};
  fill.material.assign(4, 1);
  find_surface(fill);
  return assembly;
}

/// Its top moves along x; the four tetrahedra are elastic, have yielded, yield in shear and yield in tension.
inline Snapshot heap_flowing(const Assembly& assembly) {
  Snapshot snapshot = rest_snapshot(assembly);
  snapshot.time = 3.25;
  snapshot.base_displacement = {0.5, 0, 0};
  for (Vec3& u : snapshot.displacement) u += snapshot.base_displacement;
  for (Vec3& u : snapshot.fill.displacement) u += snapshot.base_displacement;
  snapshot.fill.displacement[5] += Vec3(0.1, 0, 0);
  snapshot.fill.velocity[5] = {1, 2, 3};
  for (std::size_t i = 0; i < 4; ++i) {
    TetSnapshot& tet = snapshot.fill.tets[i];
    tet.stress = {-1e3, -2e3, -6e3, 100, 200, 300};
    tet.plastic_shear = 0.01 * double(i);
    tet.plastic_volume = 0.001 * double(i);
    tet.yield = std::array<std::uint8_t, 4>{0, has_yielded_in_shear, yields_in_shear | has_yielded_in_shear,
                                            yields_in_tension | has_yielded_in_shear | has_yielded_in_tension}[i];
  }
  return snapshot;
}

/// A wedge of a ring in the xz plane between two angles (rad, from +x), from y = 0 to `depth`.
inline Polyhedron voussoir_stone(double inner, double outer, double from, double to, double depth) {
  const auto at = [](double r, double angle) { return Vec3(r * std::cos(angle), 0.0, r * std::sin(angle)); };
  return make_prism({at(inner, from), at(outer, from), at(outer, to), at(inner, to)}, Vec3(0, depth, 0));
}

/// A half-circle arch of `n` stones on two fixed blocks, beside it a wall of `courses` rows in running bond.
inline Assembly arch_and_wall(int n = 15, int courses = 6) {
  Assembly assembly;
  auto& blocks = assembly.blocks;
  const double depth = 1.2, inner = 3.0, outer = 3.6, step = std::numbers::pi / n;
  for (int i = 0; i < n; ++i)
    blocks.push_back(make_block(voussoir_stone(inner, outer, i * step, (i + 1) * step, depth), Component::arch));
  blocks.push_back(make_block(make_box({inner, 0, -0.6}, {outer, depth, 0}), Component::base, true));
  blocks.push_back(make_block(make_box({-outer, 0, -0.6}, {-inner, depth, 0}), Component::base, true));
  blocks.push_back(make_block(make_box({4.4, 0, -0.6}, {8.4, depth, 0}), Component::base, true));
  for (int row = 0; row < courses; ++row)
    for (int k = 0; k < 5; ++k) {
      const double shift = row % 2 ? 0.4 : 0.0;
      const double low = std::max(4.4, 4.4 + 0.8 * k - shift), high = std::min(8.4, 4.4 + 0.8 * (k + 1) - shift);
      blocks.push_back(make_block(make_box({low, 0.3, 0.5 * row}, {high, 0.9, 0.5 * (row + 1)}), Component::spandrel));
    }
  finish(assembly);
  return assembly;
}

/// The arch sags and opens near the crown, the wall slides at its third course and its top leans outwards.
inline Snapshot damaged(const Assembly& assembly) {
  Snapshot snapshot = rest_snapshot(assembly);
  snapshot.time = 12.5;
  snapshot.base_displacement = {0.05, 0.02, 0.0};
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    const Block& block = assembly.blocks[i];
    Vec3 u = Vec3::Zero();
    double turn = 0.0;
    const Vec3 c = block.centroid;
    if (block.component == Component::arch) {
      u = Vec3(0.006 * c.x(), 0, -0.03 * std::max(0.0, 1.0 - std::abs(c.x()) / 2.0));
      turn = 0.012 * c.x() / 3.3 * std::max(0.0, 1.0 - std::abs(c.x()) / 3.3);
    } else if (block.component == Component::spandrel && c.z() > 1.0) {
      u = Vec3(0.03, -0.01 * c.z(), 0.0);
      if (c.x() > 6.5) u += Vec3(0.01 * (c.z() - 0.5), 0, 0.002 * c.z());
    }
    snapshot.displacement[i] = u + snapshot.base_displacement;
    snapshot.rotation[i] = Eigen::AngleAxisd(turn, Vec3::UnitY());
  }
  for (std::size_t j = 0; j < snapshot.patches.size(); ++j) {
    PatchSnapshot& patch = snapshot.patches[j];
    const auto place = [&](std::int64_t i, const Vec3& x) {
      const Vec3& c = assembly.blocks[i].centroid;
      return Vec3(c + snapshot.displacement[i] + snapshot.rotation[i] * (x - c));
    };
    for (Vec3& x : patch.polygon) {
      const Vec3 a = place(patch.a, x), b = place(patch.b, x), jump = b - a;
      const double open = jump.dot(patch.normal), slip = (jump - open * patch.normal).norm();
      patch.opening = patch.largest_opening = std::max(patch.largest_opening, open);
      patch.slip = patch.largest_slip = std::max(patch.largest_slip, slip);
      x = 0.5 * (a + b);
    }
    if (patch.largest_opening > 1e-3 || patch.largest_slip > 1e-3) patch.bonded = 0.0;
  }
  return snapshot;
}

}  // namespace voussoir::test
