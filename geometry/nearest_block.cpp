#include "geometry/nearest_block.h"

#include <algorithm>

namespace voussoir {

namespace {

/// Distance of a point outside a convex cell: the largest distance beyond a face plane; negative inside.
double outside(const Polyhedron& cell, const Vec3& point) {
  double distance = -1e300;
  for (std::size_t f = 0; f < cell.faces.size(); ++f) {
    const Plane plane = face_plane(cell, int(f));
    distance = std::max(distance, plane.normal.dot(point) - plane.offset);
  }
  return distance;
}

}  // namespace

NearestBlock nearest_block(const Assembly& assembly, const Vec3& point) {
  NearestBlock nearest;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    if (assembly.blocks[i].component == Component::restraint) continue;
    const Box box = block_box(assembly.blocks[i]);
    const double apart = std::max((box.low - point).maxCoeff(), (point - box.high).maxCoeff());
    if (apart >= nearest.distance) continue;
    for (const Polyhedron& cell : assembly.blocks[i].cells)
      if (const double d = std::max(0.0, outside(cell, point)); d < nearest.distance) nearest = {std::int64_t(i), d};
  }
  return nearest;
}

}  // namespace voussoir
