// An orthographic view of an assembly: its faces projected onto a sheet, with an optional cutting plane.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

/// The axes of a sheet in world coordinates. All are unit vectors; right × up points to the reader.
struct SheetAxes {
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitZ(), forward = Vec3::UnitY();
  double u(const Vec3& x) const { return right.dot(x); }
  double v(const Vec3& x) const { return up.dot(x); }
};
SheetAxes seen_from_front();   // along y, x to the right
SheetAxes seen_from_behind();  // along −y, −x to the right
SheetAxes seen_from_above();   // along −z, x to the right
SheetAxes seen_from_left();    // along x, −y to the right

/// A convex face turned to the reader. Corners (u, v, 0) in m, counter-clockwise.
struct FlatFace {
  Polygon corners;
  Vec3 depth = Vec3::Zero();   // distance of (u, v) along the view: depth·(u, v, 1), m
  Vec3 normal = Vec3::Zero();  // in the world
  Component component = Component::block;
  std::int32_t part = 0;
  std::int64_t block = -1;  // −1: the deformable fill
  bool fixed = false;
  bool cut = false;  // lies in the cutting plane
};

struct FlatView {
  SheetAxes axes;
  std::vector<FlatFace> faces;
};

/// The section of the assembly with a plane square to `axes.forward`: convex pieces, block by block. If two cells meet
/// in the plane, the nearer one is used.
std::vector<FlatFace> cut_faces(const Assembly& assembly, const SheetAxes& axes, double place);

/// A section shows the cut at forward·x = place and everything behind it, up to `to`.
struct ViewCut {
  double place = 0.0, to = 1e300;  // m
};

/// All faces turned to the reader. Faces of which joints or patches of the fill cover more than 99.9 % of the area are
/// left out, and so are the blocks in `without`.
FlatView flat_view(const Assembly& assembly, const SheetAxes& axes,
                   const std::optional<ViewCut>& section = std::nullopt, const std::vector<std::int64_t>& without = {});

/// Bounds of u and v of all corners; zero if there are no faces.
Box extent_of(const std::vector<FlatFace>& faces);
/// Whether a point (u, v) is in the face, including its edge.
bool holds(const FlatFace& face, const Vec3& at);

}  // namespace voussoir
