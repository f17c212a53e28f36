// Shapes and motions that the geometry tests share.
#pragma once
#include <algorithm>
#include <cmath>
#include <random>

#include "geometry/assembly.h"

namespace voussoir::test {

constexpr double k_pi = 3.14159265358979323846;

inline Mat3 turn(const Vec3& axis, double angle) {
  return Eigen::AngleAxisd(angle, axis.normalized()).toRotationMatrix();
}

inline Polyhedron placed(Polyhedron shape, const Mat3& rotation, const Vec3& shift) {
  for (Vec3& p : shape.vertices) p = rotation * p + shift;
  return shape;
}

/// A unit cube with its low corner at the origin.
inline Polyhedron unit_cube() {
  return make_box(Vec3::Zero(), Vec3::Ones());
}

inline Polyhedron tetrahedron(const Vec3& o, const Vec3& a, const Vec3& b, const Vec3& c) {
  return {{o, a, b, c}, {{0, 2, 1}, {0, 1, 3}, {1, 2, 3}, {0, 3, 2}}};
}

/// The same shape with vertices, faces and the starts of the loops in another order.
inline Polyhedron renumbered(const Polyhedron& shape, unsigned seed) {
  std::mt19937 random(seed);
  const int n = static_cast<int>(shape.vertices.size());
  std::vector<int> to(n);
  for (int i = 0; i < n; ++i) to[i] = i;
  std::shuffle(to.begin(), to.end(), random);
  Polyhedron out{std::vector<Vec3>(n), shape.faces};
  for (int i = 0; i < n; ++i) out.vertices[to[i]] = shape.vertices[i];
  for (auto& face : out.faces) {
    for (int& v : face) v = to[v];
    std::rotate(face.begin(), face.begin() + static_cast<int>(random() % face.size()), face.end());
  }
  std::shuffle(out.faces.begin(), out.faces.end(), random);
  return out;
}

inline Block block_of(std::vector<Polyhedron> cells, Component component = Component::block) {
  Block block;
  block.cells = std::move(cells);
  block.component = component;
  return block;
}

/// Blocks of one material of 2000 kg/m3.
inline Assembly assembly_of(std::vector<Block> blocks) {
  Assembly out;
  out.materials = {{"stone", 2000.0, 1e9, 4e8, 0.0, 0.0, 0.5}};
  out.blocks = std::move(blocks);
  return out;
}

/// The text of the InputError that `work` throws; empty when it throws none.
template <class Work>
std::string error_of(const Work& work) {
  try {
    work();
  } catch (const std::exception& error) {
    return error.what();
  }
  return "";
}

}  // namespace voussoir::test
