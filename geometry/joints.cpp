#include "geometry/joints.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <tuple>

#include "geometry/convex.h"
#include "geometry/neighbours.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {
namespace {

constexpr double k_exact = 1e-9;    // m: gaps below this are rounding
constexpr double k_watched = 10.0;  // opposed faces up to this many gaps apart are reported as left open

struct StoneFace {
  Vec3 normal, centre;
  double radius = 0.0;  // of the sphere about `centre` that holds the face
  Box box;
};

struct StoneCell {
  std::int64_t block = 0;
  std::int32_t cell = 0;
  const Polyhedron* shape = nullptr;
  std::vector<StoneFace> faces;
};

StoneFace make_face(const Polyhedron& shape, int face) {
  const Polygon polygon = face_polygon(shape, face);
  StoneFace out{polygon_normal(polygon), polygon_centroid(polygon), 0.0, bounding_box(polygon)};
  for (const Vec3& p : polygon) out.radius = std::max(out.radius, (p - out.centre).norm());
  return out;
}

std::vector<StoneCell> collect_cells(const Assembly& assembly) {
  std::vector<StoneCell> cells;
  for (std::size_t b = 0; b < assembly.blocks.size(); ++b) {
    const Block& block = assembly.blocks[b];
    for (std::size_t c = 0; c < block.cells.size(); ++c) {
      StoneCell& cell = cells.emplace_back();
      cell.block = static_cast<std::int64_t>(b);
      cell.cell = static_cast<std::int32_t>(c);
      cell.shape = &block.cells[c];
      for (std::size_t f = 0; f < cell.shape->faces.size(); ++f)
        cell.faces.push_back(make_face(*cell.shape, static_cast<int>(f)));
    }
  }
  return cells;
}

std::vector<Box> collect_boxes(const Assembly& assembly) {
  std::vector<Box> boxes;
  for (std::size_t b = 0; b < assembly.blocks.size(); ++b)
    for (const Polyhedron& cell : assembly.blocks[b].cells) {
      boxes.push_back(bounding_box(cell));
      if (!boxes.back().low.allFinite() || !boxes.back().high.allFinite())
        throw InputError(
            "{}: a cell has vertices that are not finite numbers. Coordinates must be finite, in metres. Correct them.",
            block_label(assembly, static_cast<std::int64_t>(b)));
    }
  return boxes;
}

bool boxes_apart(const Box& a, const Box& b, double distance) {
  return ((b.low - a.high).array() > distance).any() || ((a.low - b.high).array() > distance).any();
}

/// Whether two faces may be a joint: a cheap test that lets all real ones through.
bool opposed(const StoneFace& a, const StoneFace& b, double distance, double angle) {
  if (a.normal.dot(b.normal) > -0.5 || (a.normal + b.normal).norm() > angle) return false;
  const double slack = distance + angle * (a.radius + b.radius);
  const Vec3 d = b.centre - a.centre;
  if (std::abs(a.normal.dot(d)) > slack || d.norm() > a.radius + b.radius + slack) return false;
  return !boxes_apart(a.box, b.box, slack);
}

/// The overlap of two opposed faces on the plane midway between them, and how far they are apart there.
struct FaceOverlay {
  Polygon polygon;
  Vec3 normal;
  double area = 0.0, gap = 0.0;
};

Polygon projected(const Polyhedron& shape, int face, const Vec3& on, const Vec3& normal) {
  Polygon out = face_polygon(shape, face);
  for (Vec3& p : out) p -= normal.dot(p - on) * normal;
  return out;
}

FaceOverlay overlay(const StoneCell& a, int face_a, const StoneCell& b, int face_b) {
  const StoneFace &fa = a.faces[face_a], &fb = b.faces[face_b];
  FaceOverlay out;
  out.normal = (fa.normal - fb.normal).normalized();
  const Vec3 on = 0.5 * (fa.centre + fb.centre);
  const Polygon pa = projected(*a.shape, face_a, on, out.normal);
  Polygon pb = projected(*b.shape, face_b, on, out.normal);
  std::reverse(pb.begin(), pb.end());
  out.polygon = cleaned(intersect(pa, pb, out.normal));
  if (out.polygon.empty()) return out;
  out.area = polygon_area(out.polygon);
  // Heights of the two face planes over the overlap's centroid; `on` is near, so nothing cancels.
  const Vec3 centre = polygon_centroid(out.polygon);
  const double ha = fa.normal.dot(fa.centre - centre) / fa.normal.dot(out.normal);
  const double hb = fb.normal.dot(fb.centre - centre) / fb.normal.dot(out.normal);
  out.gap = hb - ha;
  for (Vec3& p : out.polygon) p += 0.5 * (ha + hb) * out.normal;
  return out;
}

/// Twice the area over the perimeter, which is the width of a long strip.
double width_of(const FaceOverlay& overlay) {
  double outline = 0.0;
  for (std::size_t i = 0; i < overlay.polygon.size(); ++i)
    outline += (overlay.polygon[(i + 1) % overlay.polygon.size()] - overlay.polygon[i]).norm();
  return outline > 0.0 ? 2.0 * overlay.area / outline : 0.0;
}

bool is_sliver(const FaceOverlay& overlay, const JointSearch& search) {
  return overlay.area < search.smallest_area ||
         (search.smallest_width > 0.0 && width_of(overlay) < search.smallest_width);
}

/// The result of the search for one pair of cells: the joint, or the smallest open gap.
struct Found {
  std::optional<Joint> joint;
  double gap = 0.0;
  std::optional<double> open;
};

Found search_pair(const StoneCell& a, const StoneCell& b, const JointSearch& search) {
  Found out;
  for (int i = 0; i < static_cast<int>(a.faces.size()); ++i)
    for (int j = 0; j < static_cast<int>(b.faces.size()); ++j) {
      if (!opposed(a.faces[i], b.faces[j], k_watched * search.gap, search.angle)) continue;
      FaceOverlay found = overlay(a, i, b, j);
      if (is_sliver(found, search) || std::abs(found.gap) > k_watched * search.gap) continue;
      if (std::abs(found.gap) > search.gap) {
        if (found.gap > 0.0) out.open = std::min(out.open.value_or(found.gap), found.gap);
        continue;
      }
      // Convex cells touch in one plane; tolerance may offer a second pair of faces, and the larger overlap is meant.
      if (out.joint && out.joint->area >= found.area) continue;
      out.gap = found.gap;
      out.joint = Joint{a.block, b.block, a.cell, b.cell, i, j, std::move(found.polygon), found.normal, found.area};
    }
  return out;
}

void count(JointReport& report, const Found& found) {
  if (found.joint) {
    ++report.joints;
    if (std::abs(found.gap) <= k_exact) return;
    ++report.closed_gaps;
    report.largest_closed_gap = std::max(report.largest_closed_gap, std::abs(found.gap));
  } else if (found.open) {
    report.smallest_open_gap = report.open_gaps ? std::min(report.smallest_open_gap, *found.open) : *found.open;
    ++report.open_gaps;
  }
}

/// Depths of overlap of the pairs of cells that need a look, by separating axes; shapes are prepared when first needed.
class OverlapCheck {
 public:
  OverlapCheck(const std::vector<const Polyhedron*>& shapes, double tolerance)
      : shapes_(shapes), convex_(shapes.size()), tolerance_(tolerance) {}

  void look(int i, int j, std::int64_t a, std::int64_t b) {
    const double apart = separation(prepared(i), prepared(j), -tolerance_);
    if (apart >= -tolerance_) return;
    double& depth = depths_[{a, b}];
    depth = std::max(depth, -apart);
  }

  /// Deepest first.
  std::vector<Overlap> result() const {
    std::vector<Overlap> out;
    for (const auto& [pair, depth] : depths_) out.push_back({pair.first, pair.second, depth});
    std::stable_sort(out.begin(), out.end(), [](const Overlap& p, const Overlap& q) { return p.depth > q.depth; });
    return out;
  }

 private:
  const Convex& prepared(int i) {
    if (convex_[i].faces.empty()) convex_[i] = make_convex(*shapes_[i]);
    return convex_[i];
  }

  const std::vector<const Polyhedron*>& shapes_;
  std::vector<Convex> convex_;
  double tolerance_;
  std::map<std::pair<std::int64_t, std::int64_t>, double> depths_;
};

[[noreturn]] void complain(const Assembly& assembly, const std::vector<Overlap>& overlaps, double gap) {
  const Overlap& worst = overlaps.front();
  const std::string more = overlaps.size() == 1
                               ? ""
                               : fmt::format(" {}.", counted(overlaps.size() - 1, "more pair of blocks overlaps",
                                                             "more pairs of blocks overlap"));
  throw InputError(
      "{} and {} overlap by {:.3g} m. The overlap must be at most the gap tolerance, {:g} m. Move or trim one of them, "
      "join them as cells of one block, or raise gap_tolerance if the drawing is not more accurate.{}",
      block_label(assembly, worst.a), block_label(assembly, worst.b), worst.depth, gap, more);
}

std::vector<const Polyhedron*> collect_shapes(const Assembly& assembly) {
  std::vector<const Polyhedron*> shapes;
  for (const Block& block : assembly.blocks)
    for (const Polyhedron& cell : block.cells) shapes.push_back(&cell);
  return shapes;
}

}  // namespace

JointReport find_joints(Assembly& assembly, const JointSearch& search) {
  const std::vector<Box> boxes = collect_boxes(assembly);
  const std::vector<StoneCell> cells = collect_cells(assembly);
  const std::vector<const Polyhedron*> shapes = collect_shapes(assembly);
  OverlapCheck overlaps(shapes, search.gap);
  JointReport report;
  assembly.joints.clear();
  for (const auto& [i, j] : neighbours(boxes, k_watched * search.gap)) {
    const StoneCell &a = cells[i], &b = cells[j];  // i < j, so a.block <= b.block
    if (a.block == b.block || (assembly.blocks[a.block].fixed && assembly.blocks[b.block].fixed)) continue;
    Found found = search_pair(a, b, search);
    count(report, found);
    if (found.joint) {
      assembly.joints.push_back(std::move(*found.joint));
    } else if (!boxes_apart(boxes[i], boxes[j], -search.gap)) {
      overlaps.look(i, j, a.block, b.block);
    }
  }
  const std::vector<Overlap> bad = overlaps.result();
  if (!bad.empty()) complain(assembly, bad, search.gap);
  const auto key = [](const Joint& q) { return std::tie(q.a, q.b, q.cell_a, q.cell_b, q.face_a, q.face_b); };
  std::sort(assembly.joints.begin(), assembly.joints.end(),
            [&](const Joint& p, const Joint& q) { return key(p) < key(q); });
  return report;
}

std::vector<Overlap> find_overlaps(const Assembly& assembly, double tolerance) {
  const std::vector<Box> boxes = collect_boxes(assembly);
  const std::vector<const Polyhedron*> shapes = collect_shapes(assembly);
  std::vector<std::int64_t> owner;
  for (std::size_t b = 0; b < assembly.blocks.size(); ++b)
    owner.insert(owner.end(), assembly.blocks[b].cells.size(), static_cast<std::int64_t>(b));
  OverlapCheck check(shapes, tolerance);
  for (const auto& [i, j] : neighbours(boxes, -tolerance))
    if (owner[i] != owner[j]) check.look(i, j, owner[i], owner[j]);
  return check.result();
}

}  // namespace voussoir
