// Finding the joints of an assembly: every pair of opposed coplanar faces of two stones, clipped against each other.
#pragma once
#include "geometry/assembly.h"

namespace voussoir {

struct JointSearch {
  double gap = 1e-4;            // m: faces at most this far apart (either way) are in contact
  double angle = 1e-3;          // rad: largest angle between opposed faces
  double smallest_area = 1e-8;  // m2: smaller overlaps are not joints
  /// m: nor are narrower ones (twice the area over the outline). Stones that meet along an edge and whose coordinates
  /// are rounded overlap by such strips.
  double smallest_width = 0.0;
};

/// For shapes from elsewhere, whose coordinates are rounded: overlaps narrower than the gap are no joints.
inline JointSearch careful_search(double gap = JointSearch().gap) {
  JointSearch search;
  search.gap = search.smallest_width = gap;
  return search;
}

/// What the search closed or left open, for the log.
struct JointReport {
  std::int64_t joints = 0;
  std::int64_t closed_gaps = 0;     // joints whose faces were apart or overlapping by more than 1e-9 m
  double largest_closed_gap = 0.0;  // m
  std::int64_t open_gaps = 0;       // pairs of cells left without a joint though opposed faces are 1 to 10 `gap` apart
  double smallest_open_gap = 0.0;   // m, of those
};

/// Finds all joints (geometry only: kn, ks and law are left at zero), sorted by their canonical key. Each joint's
/// polygon lies midway between the two faces. Throws InputError naming the two blocks when cells overlap by more than
/// `gap`.
JointReport find_joints(Assembly& assembly, const JointSearch& search = {});

/// Two blocks whose cells interpenetrate, and the depth of the deepest pair of cells.
struct Overlap {
  std::int64_t a = 0, b = 0;
  double depth = 0.0;  // m
};
/// Pairs of blocks that interpenetrate deeper than `tolerance`, by separating axes over the pairs whose boxes meet;
/// deepest first. find_joints() makes the same check, but leaves out pairs of fixed blocks.
std::vector<Overlap> find_overlaps(const Assembly& assembly, double tolerance);

double covered_area(const Assembly& assembly);  // m2, sum over the joints
/// Surface of all stones that no joint covers: sum of the stones' outer faces less twice the joints' area and less that
/// of the patches with a deformable fill, m2.
double uncovered_surface(const Assembly& assembly);

/// Outer faces of one block: the faces of its cells less what they share with sibling cells, as planar convex loops.
std::vector<Polygon> outer_faces(const Block& block, double gap = 1e-6);

}  // namespace voussoir
