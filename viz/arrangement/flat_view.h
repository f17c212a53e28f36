// An assembly as it is seen from afar: its faces projected square onto a sheet, cut by a plane where there is one.
#pragma once
#include <cstdint>
#include <optional>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

/// The axes of a sheet in the world; all are units, right × up points to the reader.
struct SheetAxes {
  Vec3 right = Vec3::UnitX(), up = Vec3::UnitZ(), forward = Vec3::UnitY();
  double u(const Vec3& x) const { return right.dot(x); }
  double v(const Vec3& x) const { return up.dot(x); }
};
SheetAxes seen_from_front();   // along y, x to the right
SheetAxes seen_from_behind();  // along −y, −x to the right
SheetAxes seen_from_above();   // along −z, x to the right
SheetAxes seen_from_left();    // along x, −y to the right

/// A convex face that looks at the reader. Corners (u, v, 0) in m, counter-clockwise.
struct FlatFace {
  Polygon corners;
  Vec3 depth = Vec3::Zero();   // how far off (u, v) lies: depth·(u, v, 1), m
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

/// Where a plane cuts the assembly: convex pieces, block by block, as seen along `axes.forward` (which the plane is
/// square to). Of two cells that meet in the plane the one before it counts.
std::vector<FlatFace> cut_faces(const Assembly& assembly, const SheetAxes& axes, double place);

/// A section shows the cut at forward·x = place and what lies beyond it, up to `to`.
struct ViewCut {
  double place = 0.0, to = 1e300;  // m
};

/// All faces that can be seen: those that joints or patches of the fill cover are left out, and the blocks in
/// `without`.
FlatView flat_view(const Assembly& assembly, const SheetAxes& axes,
                   const std::optional<ViewCut>& section = std::nullopt, const std::vector<std::int64_t>& without = {});

/// u and v of all corners; zero where there are no faces.
Box extent_of(const std::vector<FlatFace>& faces);
/// Whether a point (u, v) lies in the face, its rim included.
bool holds(const FlatFace& face, const Vec3& at);

}  // namespace voussoir
