// Lays stones: courses of boxes in running bond, cut by the vaults, collected in a Layout. Parts of a bridge (vault,
// pier, spandrel …) are functions that add stones to a Layout; see masonry_parts.h.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "geometry/ring.h"

namespace voussoir {

/// A stone before slivers are merged with their neighbours.
struct Stone {
  std::vector<Polyhedron> cells;  // convex, m
  Component component = Component::block;
  std::int32_t part = 0;
  std::int32_t material = 0;
  bool fixed = false;
  bool was_cut = false;         // only cut stones can be slivers
  std::uint32_t layers = 1;     // bits; slivers are merged with stones that share a bit, such as a ring of a vault
  Vec3 nominal = Vec3::Ones();  // m, size of the uncut stone (length, width, height)
};

/// The stones of a course: their target size (m), component, part and material.
struct Unit {
  Component component = Component::block;
  std::int32_t part = 0;
  std::int32_t material = 0;
  Vec3 size = Vec3::Ones();  // m: along x, across y, height
  bool bonded = true;        // running bond; otherwise stacked, joints above joints
};

/// The stones laid so far, and the limits that cut further stones.
struct Layout {
  std::vector<Stone> stones;
  SectionLimits limits;
  std::map<std::string, std::vector<std::int64_t>> groups;  // indices into `stones`
};

/// Throws InputError if a layout would have more stones than a model may have.
void check_stones(double stones);

/// Boundaries that divide [from, to] into round(length / size) equal parts, at least one. With `half` the parts are
/// shifted by half of one, with half parts at both ends; a single part is never halved.
std::vector<double> split(double from, double to, double size, bool half = false);

/// Lays stones next to each other across the bridge, between the given y (m, ascending). Each has one cell for every
/// polygon (in the plane x-z, counter-clockwise seen from -y).
void lay_across(Layout& layout, const std::vector<Polygon>& polygons, const std::vector<double>& y, const Unit& unit,
                const Vec3& nominal);

/// Lays the wedges of a ring across [y0, y1] in stretcher bond: alternate wedges are offset half a stone, with half
/// stones at the edges. Returns the first index of the stones of each wedge in the layout, and one past the last.
/// `bond`: number of the first wedge in the bond, for rings on top of each other.
std::vector<std::int64_t> lay_ring(Layout& layout, const Ring& ring, double y0, double y1, const Unit& unit,
                                   int bond = 0);

/// Fills a box with horizontal courses in running bond: along x (a course is offset half a length against the ones
/// above and below) and across y (each row is offset against its neighbours in the course), unless the unit is stacked.
/// The limits of the layout cut stones; separate pieces become separate stones. `first` is the number of the lowest
/// course in the bond, for walls laid in several calls.
void lay_courses(Layout& layout, const Vec3& low, const Vec3& high, const Unit& unit, int first = 0);

/// Adds one stone of the given cells.
void lay_stone(Layout& layout, std::vector<Polyhedron> cells, const Unit& unit, const Vec3& nominal, bool was_cut);

/// Rule for cut stones that are too small to be separate stones.
struct SliverRule {
  double thickness = 0.15;  // m: smallest thickness (or half the nominal size, if less) along a face normal
  double share = 0.25;      // smallest share of its nominal volume
  double most = 2.0;        // times its nominal volume: a larger stone is merged with slivers only if no other can be
};

/// Makes an assembly of the layout: finds the joints, merges each sliver (as further cells) with a neighbour of the
/// same component, material and layer, and finishes the blocks. Neighbours that do not become too large are preferred,
/// then neighbours that are not slivers, then the one with the largest common area. Stiffness and laws of joints are
/// not set yet. `gap` as in JointSearch.
Assembly assemble(Layout layout, const std::vector<Material>& materials, const SliverRule& slivers, double gap);

}  // namespace voussoir
