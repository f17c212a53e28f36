// Many polyhedra in flat arrays with offsets, as assembly files store them.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/polyhedron.h"
#include "io/hdf5/h5.h"

namespace voussoir {

/// Shape i has the vertex rows vertex_offset[i] … vertex_offset[i+1]−1 and the faces shape_face_offset[i] …; face f has
/// the entries face_offset[f] … of face_vertices, which count from the first vertex of the shape.
struct ShapeArrays {
  std::vector<double> vertices;  // (V,3), m
  std::vector<std::int64_t> vertex_offset = {0}, face_vertices, face_offset = {0}, shape_face_offset = {0};

  std::size_t size() const { return vertex_offset.size() - 1; }
  void add(const Polyhedron& shape);
  Polyhedron shape(std::size_t i) const;
};

/// Reads GROUP/vertices, vertex_offset, face_vertices, face_offset and the named offsets of the faces. Throws
/// InputError with file, dataset and row if offsets do not fit, an index is out of range or a number is not finite.
ShapeArrays read_shapes(const h5::File& file, const std::string& group, const std::string& face_offset_name);

/// The fault of a shape as a convex cell: not closed, without volume, inside-out, not convex; empty: no fault.
std::string find_fault(const Polyhedron& cell);

/// Checks that offsets begin with 0, never decrease and end with `last`.
void check_offsets(const h5::File& file, const std::string& name, const std::vector<std::int64_t>& offsets,
                   std::size_t last);
/// Reads doubles. Throws InputError with the row of a number that is not finite.
std::vector<double> read_finite(const h5::File& file, const std::string& name, const h5::Shape& expected);
/// The same for coordinates (n,3), m, which must be within the limit of geometry/extent.h.
std::vector<double> read_places(const h5::File& file, const std::string& name, std::size_t rows);

}  // namespace voussoir
