// Laying stones: courses of boxes in running bond, cut by the vaults, collected in a Layout. Parts of a bridge (vault,
// pier, spandrel …) are functions that add stones to a Layout; see masonry_parts.h.
#pragma once
#include <string>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

/// A stone as it is laid, before slivers are joined to their neighbours.
struct Stone {
  std::vector<Polyhedron> cells;  // convex, m
  Component component = Component::block;
  std::int32_t part = 0;
  std::int32_t material = 0;
  bool fixed = false;
  bool was_cut = false;         // only cut stones can be slivers
  Vec3 nominal = Vec3::Ones();  // m, size of the uncut stone (length, width, height)
};

/// What a course is made of: the size aimed at (m) and what the stones belong to.
struct Unit {
  Component component = Component::block;
  std::int32_t part = 0;
  std::int32_t material = 0;
  Vec3 size = Vec3::Ones();  // m: along x, across y, height
  bool bonded = true;        // running bond; otherwise stacked, joints above joints
};

/// A ring of flat-faced wedges in the plane x-z: joint i runs from intrados[i] to extrados[i], from left to right.
struct Ring {
  Polygon intrados, extrados;  // y = 0, m; one more point than there are wedges
  Vec3 centre = Vec3::Zero();  // m, where the joints' planes meet (springing level)
  int wedges() const { return int(intrados.size()) - 1; }
};

/// The stones laid so far, and the rings that cut whatever is laid above the springing.
struct Layout {
  std::vector<Stone> stones;
  std::vector<Ring> rings;
  std::map<std::string, std::vector<std::int64_t>> groups;  // indices into `stones`
};

/// Boundaries that divide [from, to] into round(length / size) equal parts, at least one. With `half` the parts are
/// shifted by half of one, with half parts at both ends; a single part is never halved.
std::vector<double> split(double from, double to, double size, bool half = false);

/// A semicircular ring of `wedges` equal wedges. The feet lie exactly at the springing level and the two halves mirror
/// one another bit for bit about `centre`.
Ring make_semicircle(const Vec3& centre, double inner_radius, double outer_radius, int wedges);

/// Lays the wedges of a ring across [y0, y1] in stretcher bond: alternate wedges are offset half a stone, with half
/// stones at the edges. Returns the first index of each wedge's stones in the layout, and one past the last.
std::vector<std::int64_t> lay_ring(Layout& layout, const Ring& ring, double y0, double y1, const Unit& unit);

/// The parts of a convex polygon in the plane x-z that lie outside a ring's extrados, as convex polygons. They meet
/// along the planes of the ring's joints.
std::vector<Polygon> outside(const Polygon& polygon, const Ring& ring);

/// The part of the rectangle between two corners in the plane x-z that lies outside the extrados of all rings, as
/// convex polygons.
std::vector<Polygon> outside(const Vec3& low, const Vec3& high, const std::vector<Ring>& rings);

/// Fills a box with horizontal courses in running bond: along x (a course is offset half a length against the ones
/// above and below) and across y (a row is so against its neighbours in the course), unless the unit is stacked. Stones
/// that meet a ring of the layout are cut by its extrados; what falls apart becomes separate stones. `first` is the
/// number of the lowest course in the bond, for walls laid in several calls.
void lay_courses(Layout& layout, const Vec3& low, const Vec3& high, const Unit& unit, int first = 0);

/// Adds one stone of the given cells.
void lay_stone(Layout& layout, std::vector<Polyhedron> cells, const Unit& unit, const Vec3& nominal, bool was_cut);

/// When a cut stone is too small to stand for itself.
struct SliverRule {
  double thickness = 0.15;  // m: thinner than this (or half its nominal size, if that is less) along a face normal
  double share = 0.25;      // of its nominal volume
};

/// Turns the layout into an assembly: finds the joints, joins each sliver to the neighbour of the same component and
/// material it shares most area with (as further cells of that stone), and finishes the blocks. Joint stiffness and
/// laws are left to set; materials are taken over. `gap` as in JointSearch.
Assembly assemble(Layout layout, const std::vector<Material>& materials, const SliverRule& slivers, double gap);

}  // namespace voussoir
