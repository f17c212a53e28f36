// A fill without stones that the caller advances, for the rungs of the continuum and the tests of its elements.
#pragma once
#include <algorithm>
#include <map>

#include "solver/fill/fill_pass.h"

namespace voussoir::ladder {

/// A box of nx × ny × nz cells, each cut into six tetrahedra along its long diagonal (Kuhn 1960), so that neighbours
/// share whole faces. Every second cell is mirrored, so that no direction of diagonals is preferred.
inline FillMesh box_mesh(const Vec3& low, const Vec3& high, int nx, int ny, int nz) {
  FillMesh mesh;
  const auto node = [&](int i, int j, int k) { return std::int32_t(i + (nx + 1) * (j + (ny + 1) * k)); };
  const Vec3 size = (high - low).cwiseQuotient(Vec3(nx, ny, nz));
  for (int k = 0; k <= nz; ++k)
    for (int j = 0; j <= ny; ++j)
      for (int i = 0; i <= nx; ++i) mesh.nodes.push_back(low + Vec3(i, j, k).cwiseProduct(size));
  constexpr int ways[6][3] = {{0, 1, 2}, {1, 2, 0}, {2, 0, 1}, {0, 2, 1}, {2, 1, 0}, {1, 0, 2}};
  for (int k = 0; k < nz; ++k)
    for (int j = 0; j < ny; ++j)
      for (int i = 0; i < nx; ++i) {
        const int flip[3] = {i % 2, j % 2, k % 2};
        for (const auto& way : ways) {
          int at[3] = {0, 0, 0};
          std::array<std::int32_t, 4> tet;
          for (int c = 0; c < 4; ++c) {
            if (c > 0) at[way[c - 1]] = 1;
            tet[std::size_t(c)] = node(i + (at[0] ^ flip[0]), j + (at[1] ^ flip[1]), k + (at[2] ^ flip[2]));
          }
          const auto x = [&](int c) { return mesh.nodes[std::size_t(tet[std::size_t(c)])]; };
          if ((x(1) - x(0)).dot((x(2) - x(0)).cross(x(3) - x(0))) < 0.0) std::swap(tet[2], tet[3]);
          mesh.tets.push_back(tet);
        }
      }
  mesh.material.assign(mesh.tets.size(), 0);
  return mesh;
}

/// The triangles of the surface whose corners `where` picks, counter-clockwise seen from outside.
template <class Where>
std::vector<std::array<std::int32_t, 3>> surface(const FillMesh& mesh, const Where& where) {
  std::map<std::array<std::int32_t, 3>, std::vector<std::array<std::int32_t, 3>>> faces;  // by sorted corners
  for (const auto& t : mesh.tets)
    for (const auto& [a, b, c] : {std::array{t[1], t[2], t[3]}, std::array{t[0], t[3], t[2]},
                                  std::array{t[0], t[1], t[3]}, std::array{t[0], t[2], t[1]}}) {
      std::array<std::int32_t, 3> key = {a, b, c};
      std::sort(key.begin(), key.end());
      faces[key].push_back({a, b, c});
    }
  std::vector<std::array<std::int32_t, 3>> found;
  for (const auto& [key, same] : faces)
    if (same.size() == 1 &&
        std::all_of(key.begin(), key.end(), [&](auto n) { return where(mesh.nodes[std::size_t(n)]); }))
      found.push_back(same.front());
  return found;
}

/// A material by κ and μ that never yields.
inline Material elastic_fill(double density, double bulk, double shear) {
  Material m;
  m.name = "fill";
  m.density = density;
  m.youngs_modulus = 9.0 * bulk * shear / (3.0 * bulk + shear);
  m.shear_modulus = shear;
  m.cohesion = m.tensile_strength = 1e30;
  return m;
}

struct FillRig {
  FillModel fill;
  FillMemory memory;
  Array<double> sums, volume_sums, outside;
  std::vector<std::int32_t> first_of_node, of_node;
  std::vector<FillEnergy> energies;
  FillPass pass;
  double time = 0.0;  // s

  /// Applies a pressure to these triangles (of the mesh) from outside, Pa.
  void press(const FillMesh& mesh, const std::vector<std::array<std::int32_t, 3>>& triangles, double pressure) {
    for (const auto& t : triangles) {
      const auto x = [&](std::size_t k) { return mesh.nodes[std::size_t(t[k])]; };
      const Vec3 share = -pressure / 6.0 * (x(1) - x(0)).cross(x(2) - x(0));
      for (const std::int32_t node : t)
        for (std::size_t c = 0; c < 3; ++c)
          outside[node_width * std::size_t(fill.node_of[std::size_t(node)]) + c] += share[Eigen::Index(c)];
    }
  }

  FillRig(const FillMesh& mesh, const Material& material) {
    Assembly assembly;
    assembly.materials = {material};
    assembly.fill = mesh;
    fill = build_fill(assembly);
    memory = initial_fill(fill);
    sums.resize(node_width * fill.sum_count());
    volume_sums.resize(fill.sum_count());
    outside.assign(node_width * fill.nodes.size(), 0.0);
    for (std::size_t i = 0; i < fill.nodes.size(); ++i) of_node.push_back(std::int32_t(i));  // one slot a node
    first_of_node = of_node;
    first_of_node.push_back(std::int32_t(fill.nodes.size()));
    energies.resize(fill.tiles.size());
    connect();
  }
  FillRig(const FillRig&) = delete;
  FillRig& operator=(const FillRig&) = delete;

  void connect() {
    pass.fill = &fill, pass.memory = &memory;
    pass.sums = sums.data(), pass.volume_sums = volume_sums.data();
    pass.outside = outside.data(), pass.first_of_node = &first_of_node, pass.of_node = &of_node;
    pass.energies = energies.data();
  }
  void set_branches(const Branches& branches) {
    pass.branches = branches;
    set_fill_branches(fill, memory, branches.count);
  }

  Vec3 displacement(std::size_t node) const { return Vec3(&memory.pose[node_width * node]); }
  void set_displacement(std::size_t node, const Vec3& u) {
    for (std::size_t c = 0; c < 3; ++c) memory.pose[node_width * node + c] = u[Eigen::Index(c)];
  }
  void set_velocity(std::size_t node, const Vec3& v) {
    for (std::size_t c = 0; c < 3; ++c) memory.motion[node_width * node + c] = v[Eigen::Index(c)];
  }
  /// Holds displacement `c` of the nodes that `where` picks.
  template <class Where>
  void hold(int c, const Where& where) {
    for (std::size_t i = 0; i < fill.nodes.size(); ++i)
      if (where(fill.nodes[i])) fill.held[i] |= std::uint8_t(1 << c);
  }

  /// Stresses at the present position.
  FillReport stresses() {
    FillReport report;
    for (std::size_t t = 0; t < fill.tiles.size(); ++t) pass.volumes(t);
    for (std::size_t t = 0; t < fill.tiles.size(); ++t) pass.means(t);
    for (std::size_t t = 0; t < fill.tiles.size(); ++t) report.merge(pass.stresses(t));
    return report;
  }
  FillReport step() {
    FillReport report = stresses();
    for (std::size_t t = 0; t < fill.tiles.size(); ++t) report.merge(pass.nodes(t));
    time += pass.dt;
    return report;
  }
  /// Number of tetrahedra that have yielded since the beginning.
  std::int64_t flowed() const {
    std::int64_t count = 0;
    for (std::size_t i = 0; i < fill.tet_of_lane.size(); ++i)
      count += fill.tet_of_lane[i] >= 0 && memory.yield[i] & (has_yielded_in_shear | has_yielded_in_tension);
    return count;
  }
  /// Nodal forces of the last stresses(), with gravity and external loads.
  Vec3 force(std::size_t node) const {
    const Quad f = pass.update(node).force;
    return {f[0], f[1], f[2]};
  }
  /// Sum of component `c` of the forces on the nodes that `where` picks, N.
  template <class Where>
  double force_on(int c, const Where& where) const {
    double sum = 0.0;
    for (std::size_t i = 0; i < fill.nodes.size(); ++i)
      if (where(fill.nodes[i])) sum += force(i)[c];
    return sum;
  }
  double elastic_energy() const {
    double sum = 0.0;
    for (const FillEnergy& e : energies) sum += e.elastic;
    return sum;
  }
  /// A stable time step, s: smallest height divided by the speed of compressive waves.
  double safe_step(double share = 0.8) const {
    double least = 1e300;
    for (std::size_t b = 0; b < fill.batches.size(); ++b) {
      const FillLaw& law = fill.law_of(b);
      const double speed = std::sqrt(law.stiff() / law.density);
      for (int lane = 0; lane < fill.batches[b].count; ++lane)
        for (const Vec3& g : tet_shape(fill, b, lane).gradient) least = std::min(least, 1.0 / (g.norm() * speed));
    }
    return share * least;
  }
};

}  // namespace voussoir::ladder
