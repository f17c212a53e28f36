// Shapes as the texts of surface files.
#pragma once
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>
#include <vector>

#include "geometry/polyhedron.h"
#include "io/vtk/import.h"

namespace voussoir::test {

inline std::vector<std::array<int, 3>> triangles(const Polyhedron& shape) {
  std::vector<std::array<int, 3>> out;
  for (const auto& loop : shape.faces)
    for (std::size_t k = 1; k + 1 < loop.size(); ++k) out.push_back({loop[0], loop[k], loop[k + 1]});
  return out;
}

inline std::string obj_text(const Polyhedron& shape, const std::string& name, int& first, bool reversed = false) {
  std::string text = "o " + name + "\n";
  for (const Vec3& v : shape.vertices) text += fmt::format("v {} {} {}\n", v.x(), v.y(), v.z());
  for (auto loop : shape.faces) {
    if (reversed) std::reverse(loop.begin(), loop.end());
    text += "f";
    for (int v : loop) text += fmt::format(" {}//1", v + first);
    text += "\n";
  }
  first += int(shape.vertices.size());
  return text;
}

inline std::string stl_text(const std::vector<Polyhedron>& shapes, bool one_solid) {
  std::string text = one_solid ? "solid all\n" : "";
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (!one_solid) text += fmt::format("solid s{}\n", i);
    for (const auto& t : triangles(shapes[i])) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (int v : t) {
        const Vec3& p = shapes[i].vertices[v];
        text += fmt::format("vertex {} {} {}\n", p.x(), p.y(), p.z());
      }
      text += "endloop\nendfacet\n";
    }
    if (!one_solid) text += fmt::format("endsolid s{}\n", i);
  }
  return text + (one_solid ? "endsolid all\n" : "");
}

inline std::string ply_text(const std::vector<Polyhedron>& shapes) {
  std::string vertices, faces;
  int first = 0, count = 0;
  for (const Polyhedron& shape : shapes) {
    for (const Vec3& v : shape.vertices) vertices += fmt::format("{} {} {}\n", v.x(), v.y(), v.z());
    for (const auto& t : triangles(shape)) {
      faces += fmt::format("3 {} {} {}\n", t[0] + first, t[1] + first, t[2] + first);
      ++count;
    }
    first += int(shape.vertices.size());
  }
  return fmt::format(
             "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
             "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
             first, count) +
         vertices + faces;
}

inline std::string obj_of(const std::vector<std::pair<std::string, Polyhedron>>& stones) {
  std::string text;
  int first = 1;
  for (const auto& [name, shape] : stones) text += obj_text(shape, name, first);
  return text;
}

inline bool has_note(const Import& import, const std::string& piece) {
  return std::any_of(import.notes.begin(), import.notes.end(),
                     [&](const std::string& note) { return note.find(piece) != std::string::npos; });
}

}  // namespace voussoir::test
