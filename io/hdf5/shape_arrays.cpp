#include "io/hdf5/shape_arrays.h"

#include <fmt/format.h>

#include <cmath>

#include "geometry/extent.h"
#include "solver/base/counted.h"

namespace voussoir {

void ShapeArrays::add(const Polyhedron& shape) {
  for (const Vec3& v : shape.vertices) vertices.insert(vertices.end(), v.data(), v.data() + 3);
  vertex_offset.push_back(vertex_offset.back() + std::int64_t(shape.vertices.size()));
  for (const auto& face : shape.faces) {
    face_vertices.insert(face_vertices.end(), face.begin(), face.end());
    face_offset.push_back(std::int64_t(face_vertices.size()));
  }
  shape_face_offset.push_back(std::int64_t(face_offset.size()) - 1);
}

Polyhedron ShapeArrays::shape(std::size_t i) const {
  Polyhedron shape;
  for (std::int64_t v = vertex_offset[i]; v < vertex_offset[i + 1]; ++v)
    shape.vertices.emplace_back(Eigen::Map<const Vec3>(vertices.data() + 3 * v));
  for (std::int64_t f = shape_face_offset[i]; f < shape_face_offset[i + 1]; ++f)
    shape.faces.emplace_back(face_vertices.begin() + face_offset[std::size_t(f)],
                             face_vertices.begin() + face_offset[std::size_t(f) + 1]);
  return shape;
}

void check_offsets(const h5::File& file, const std::string& name, const std::vector<std::int64_t>& offsets,
                   std::size_t last) {
  if (offsets.empty() || offsets[0] != 0) file.fail(name, "the first offset must be 0");
  for (std::size_t i = 1; i < offsets.size(); ++i)
    if (offsets[i] < offsets[i - 1])
      file.fail(name, fmt::format("row {}: offset {} is less than the previous offset, {}: offsets must not decrease",
                                  i, offsets[i], offsets[i - 1]));
  if (offsets.back() != std::int64_t(last))
    file.fail(name, fmt::format("the last offset is {}, expected {}, the number of rows to which it points",
                                offsets.back(), last));
}

std::vector<double> read_finite(const h5::File& file, const std::string& name, const h5::Shape& expected) {
  std::vector<double> values = file.read<double>(name, expected);
  const std::size_t columns = expected.size() > 1 ? expected[1] : 1;
  for (std::size_t i = 0; i < values.size(); ++i)
    if (!std::isfinite(values[i]))
      file.fail(name, fmt::format("row {}: {} is not a finite number", i / columns, values[i]));
  return values;
}

std::vector<double> read_places(const h5::File& file, const std::string& name, std::size_t rows) {
  std::vector<double> values = read_finite(file, name, {rows, 3});
  for (std::size_t i = 0; i < values.size(); ++i)
    if (std::abs(values[i]) > farthest)
      file.fail(name, fmt::format("row {}: {} m, expected coordinates up to {:g} m", i / 3, values[i], farthest));
  return values;
}

ShapeArrays read_shapes(const h5::File& file, const std::string& group, const std::string& face_offset_name) {
  const auto path = [&](const char* name) { return group + "/" + name; };
  ShapeArrays arrays;
  arrays.vertices = read_places(file, path("vertices"), h5::any);
  arrays.vertex_offset = file.read<std::int64_t>(path("vertex_offset"));
  arrays.face_vertices = file.read<std::int64_t>(path("face_vertices"));
  arrays.face_offset = file.read<std::int64_t>(path("face_offset"));
  const std::string shape_faces = group + "/" + face_offset_name;
  arrays.shape_face_offset = file.read<std::int64_t>(shape_faces);
  check_offsets(file, path("vertex_offset"), arrays.vertex_offset, arrays.vertices.size() / 3);
  check_offsets(file, path("face_offset"), arrays.face_offset, arrays.face_vertices.size());
  check_offsets(file, shape_faces, arrays.shape_face_offset, arrays.face_offset.size() - 1);
  if (arrays.shape_face_offset.size() != arrays.vertex_offset.size())
    file.fail(shape_faces, fmt::format("{} rows, expected {} as in {}", arrays.shape_face_offset.size(),
                                       arrays.vertex_offset.size(), path("vertex_offset")));

  for (std::size_t i = 0; i < arrays.size(); ++i) {
    const std::int64_t count = arrays.vertex_offset[i + 1] - arrays.vertex_offset[i];
    for (std::int64_t f = arrays.shape_face_offset[i]; f < arrays.shape_face_offset[i + 1]; ++f) {
      const std::int64_t begin = arrays.face_offset[std::size_t(f)], end = arrays.face_offset[std::size_t(f) + 1];
      if (end - begin < 3)
        file.fail(path("face_offset"), fmt::format("row {}: face of {}, expected at least 3", f,
                                                   counted(end - begin, "vertex", "vertices")));
      for (std::int64_t k = begin; k < end; ++k)
        if (const std::int64_t v = arrays.face_vertices[std::size_t(k)]; v < 0 || v >= count)
          file.fail(path("face_vertices"),
                    fmt::format("row {}: vertex {} is out of range: shape {} has {} vertices, counted from 0", k, v, i,
                                count));
    }
  }
  return arrays;
}

std::string find_fault(const Polyhedron& cell) {
  if (cell.faces.size() < 4) return fmt::format("{}, expected at least 4", counted(cell.faces.size(), "face"));
  Vec3 open = Vec3::Zero();
  double surface = 0.0, deepest = 0.0;
  const Box box = bounding_box(cell);
  for (std::size_t f = 0; f < cell.faces.size(); ++f) {
    const Polygon polygon = face_polygon(cell, int(f));
    const double area = polygon_area(polygon);
    if (!(area > 0.0)) continue;
    const Plane plane = face_plane(cell, int(f));
    open += area * plane.normal;
    surface += area;
    for (const Vec3& v : cell.vertices) deepest = std::max(deepest, plane.normal.dot(v) - plane.offset);
  }
  if (open.norm() > 1e-6 * surface) return "its faces do not close it: a face is missing or listed clockwise";
  const double volume = mass_properties(cell).volume, size = (box.high - box.low).norm();
  if (std::abs(volume) < 1e-12 * size * size * size) return "it has no volume: give it a thickness";
  if (volume < 0.0) return "inside-out: its faces must run counter-clockwise seen from outside";
  if (deepest > 1e-3 * size)
    return fmt::format("not convex: a vertex lies {:.3g} m outside one of its faces; split it into convex cells",
                       deepest);
  return "";
}

}  // namespace voussoir
