// Finds the joints of an assembly: pairs of opposed coplanar faces of two stones, clipped against each other.
#pragma once
#include "geometry/assembly.h"

namespace voussoir {

struct JointSearch {
  double gap = 1e-4;            // m: faces with a gap or an overlap up to this are in contact
  double angle = 1e-3;          // rad: largest angle between opposed faces
  double smallest_area = 1e-8;  // m2: smaller overlaps are not joints
  /// m: narrower overlaps (twice the area over the perimeter) are not joints. Stones that meet along an edge overlap by
  /// such strips if their coordinates are rounded.
  double smallest_width = 0.0;
};

/// A search for imported shapes, whose coordinates are rounded: overlaps narrower than the gap are not joints.
inline JointSearch careful_search(double gap = JointSearch().gap) {
  JointSearch search;
  search.gap = search.smallest_width = gap;
  return search;
}

/// The result of the search, for the log.
struct JointReport {
  std::int64_t joints = 0;
  std::int64_t closed_gaps = 0;     // joints whose faces had a gap or an overlap of more than 1e-9 m
  double largest_closed_gap = 0.0;  // m
  std::int64_t open_gaps = 0;       // pairs of cells without a joint whose opposed faces are 1 to 10 `gap` apart
  double smallest_open_gap = 0.0;   // m, of these pairs
};

/// Finds all joints (geometry only: kn, ks and law stay zero), in the order of Assembly::joints. Two cells have at most
/// one joint; two fixed blocks have none. The polygon of a joint is midway between the two faces. Throws InputError
/// with the names of two blocks whose cells overlap by more than `gap`.
JointReport find_joints(Assembly& assembly, const JointSearch& search = {});

/// Two blocks whose cells overlap, and the depth of the deepest overlap of two cells.
struct Overlap {
  std::int64_t a = 0, b = 0;
  double depth = 0.0;  // m
};
/// Pairs of blocks that overlap by more than `tolerance` (m), found with separating axes for pairs whose boxes meet,
/// the deepest first. find_joints() does the same check, but without pairs of fixed blocks.
std::vector<Overlap> find_overlaps(const Assembly& assembly, double tolerance);

double covered_area(const Assembly& assembly);  // m2, sum over the joints
/// Surface of all stones that is not covered by joints, m2: the outer faces of the stones less twice the area of the
/// joints and less the area of the patches with a deformable fill.
double uncovered_surface(const Assembly& assembly);

/// Outer faces of one block as planar convex loops: the faces of its cells without the parts shared with other cells of
/// the block. Faces of two cells count as shared if they are at most `gap` m apart.
std::vector<Polygon> outer_faces(const Block& block, double gap = 1e-6);

}  // namespace voussoir
