#include "geometry/decompose.h"

#include <dlfcn.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <optional>
#include <set>

#include "geometry/cgal/cut_shape.h"
#include "geometry/hull.h"
#include "geometry/repair.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/shipped.h"

namespace voussoir {
namespace {

constexpr double k_plane = 1e-6;   // of the size: corners so near a plane lie in it
constexpr double k_volume = 1e-6;  // of the volume: by so much the pieces may differ from the whole

/// The planes of a shape's faces, each plane once, whichever way its faces look.
class FacePlanes {
 public:
  explicit FacePlanes(const Polyhedron& shape) {
    const Box box = bounding_box(shape);
    const double near = k_plane * (box.high - box.low).norm();
    std::vector<int> order(shape.faces.size());
    std::vector<double> areas;
    for (std::size_t f = 0; f < order.size(); ++f) {
      order[f] = int(f);
      areas.push_back(polygon_area(face_polygon(shape, int(f))));
    }
    std::stable_sort(order.begin(), order.end(),
                     [&](int a, int b) { return areas[std::size_t(a)] > areas[std::size_t(b)]; });
    of_face.assign(shape.faces.size(), -1);
    for (const int f : order) {
      const Polygon polygon = face_polygon(shape, f);
      const auto lies_in = [&](const Plane& plane) {
        return std::all_of(polygon.begin(), polygon.end(),
                           [&](const Vec3& p) { return std::abs(plane.normal.dot(p) - plane.offset) <= near; });
      };
      const auto found = std::find_if(planes.begin(), planes.end(), lies_in);
      of_face[std::size_t(f)] = int(found - planes.begin());
      if (found == planes.end()) planes.push_back(squared(face_plane(shape, f), polygon));
    }
  }
  std::vector<Plane> planes;
  std::vector<int> of_face;

 private:
  /// Parallel to an axis, or to two, where it is so but for rounding: then walls along that axis lie in it.
  static Plane squared(Plane plane, const Polygon& polygon) {
    for (double& component : plane.normal)
      if (std::abs(component) < 1e-9) component = 0.0;
    plane.normal.normalize();
    plane.offset = plane.normal.dot(polygon_centroid(polygon));
    return plane;
  }
};

/// Axes to try for the cut. CGAL makes walls along x from reflex edges. If x is in a face of such an edge and across
/// the edge, the wall continues the face, which gives fewer pieces than a wall at another angle, which cuts on both
/// sides of the edge. The best face depends on the others, so a few faces are tried, those of the longest edges first.
std::vector<Mat3> axes_for(const Polyhedron& shape) {
  constexpr std::size_t most = 4;
  std::map<std::pair<int, int>, int> face_of;
  for (std::size_t f = 0; f < shape.faces.size(); ++f)
    for (std::size_t k = 0; k < shape.faces[f].size(); ++k)
      face_of[{shape.faces[f][k], shape.faces[f][(k + 1) % shape.faces[f].size()]}] = int(f);
  std::vector<std::pair<double, Mat3>> found;  // length of the edge
  for (const auto& [edge, face] : face_of) {
    const auto twin = face_of.find({edge.second, edge.first});
    if (twin == face_of.end()) continue;
    const Vec3 along = shape.vertices[std::size_t(edge.second)] - shape.vertices[std::size_t(edge.first)];
    const Vec3 normal = polygon_normal(face_polygon(shape, face));
    const Vec3 other = polygon_normal(face_polygon(shape, twin->second));
    if (normal.cross(other).dot(along) > -1e-6 * along.norm()) continue;
    const Vec3 z = along.normalized(), x = z.cross(normal).normalized();
    Mat3 axes;
    axes << x.transpose(), z.cross(x).transpose(), z.transpose();
    found.push_back({along.norm(), axes});
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const auto& a, const auto& b) { return a.first > b.first * (1.0 + 1e-9); });
  std::vector<Mat3> out;
  for (const auto& [length, axes] : found) {
    const auto like = [&, &own = axes](const Mat3& known) {  // x and z may point either way
      return std::abs(known.row(0).dot(own.row(0))) > 1.0 - 1e-9 && std::abs(known.row(2).dot(own.row(2))) > 1.0 - 1e-9;
    };
    if (out.size() < most && std::none_of(out.begin(), out.end(), like)) out.push_back(axes);
  }
  if (out.empty()) out.push_back(Mat3::Identity());
  return out;
}

/// The three of the planes that meet at the corner most squarely; where there are fewer, further ones through it.
std::array<Plane, 3> planes_at(const Vec3& corner, const std::vector<Plane>& planes, const std::vector<int>& meeting) {
  std::vector<Plane> candidates;
  for (const int i : meeting) candidates.push_back(planes[std::size_t(i)]);
  std::array<Plane, 3> best;
  double squarest = 0.0;
  const std::size_t own = candidates.size();
  for (int axis = 0; axis < 3; ++axis) candidates.push_back({Vec3::Unit(axis), corner[axis]});
  // First only the shape's own planes; then with one axis, with two, with three.
  for (std::size_t helpers = 0; helpers <= 3 && squarest < 1e-3; ++helpers)
    for (std::size_t a = 0; a < candidates.size(); ++a)
      for (std::size_t b = a + 1; b < candidates.size(); ++b)
        for (std::size_t c = b + 1; c < candidates.size(); ++c) {
          if (std::size_t(a >= own) + (b >= own) + (c >= own) != helpers) continue;
          const double square = std::abs(candidates[a].normal.cross(candidates[b].normal).dot(candidates[c].normal));
          if (square <= squarest) continue;
          squarest = square;
          best = {candidates[a], candidates[b], candidates[c]};
        }
  return best;
}

bool inside_triangle(const Vec3& p, const Vec3& a, const Vec3& b, const Vec3& c, const Vec3& normal) {
  return (b - a).cross(p - a).dot(normal) >= 0.0 && (c - b).cross(p - b).dot(normal) >= 0.0 &&
         (a - c).cross(p - c).dot(normal) >= 0.0;
}

/// Ear clipping (Meisters 1975).
void add_triangles(const std::vector<Vec3>& points, std::vector<int> loop, std::vector<std::vector<int>>& to) {
  Polygon polygon;
  for (const int v : loop) polygon.push_back(points[std::size_t(v)]);
  const Vec3 normal = polygon_normal(polygon);
  const auto at = [&](std::size_t i) -> const Vec3& { return points[std::size_t(loop[i % loop.size()])]; };
  const auto is_ear = [&](std::size_t i) {
    const Vec3 &a = at(i + loop.size() - 1), &b = at(i), &c = at(i + 1);
    if ((b - a).cross(c - b).dot(normal) <= 0.0) return false;
    for (std::size_t k = 2; k + 1 < loop.size(); ++k)
      if (inside_triangle(at(i + k), a, b, c, normal)) return false;
    return true;
  };
  while (loop.size() > 3) {
    std::size_t ear = 0;
    while (ear + 1 < loop.size() && !is_ear(ear)) ++ear;  // of rounding alone there may be none: then the last
    to.push_back({loop[(ear + loop.size() - 1) % loop.size()], loop[ear], loop[(ear + 1) % loop.size()]});
    loop.erase(loop.begin() + std::ptrdiff_t(ear));
  }
  to.push_back(loop);
}

/// Coordinates are rounded, so faces of more than three corners are plane only nearly. Exactly plane they are when
/// every corner is where three of the planes meet; faces with a corner where their own plane is not among these become
/// triangles.
ExactShape exact_shape(const Polyhedron& shape) {
  const FacePlanes faces(shape);
  std::vector<std::set<int>> at_corner(shape.vertices.size());
  for (std::size_t f = 0; f < shape.faces.size(); ++f)
    for (const int v : shape.faces[f]) at_corner[std::size_t(v)].insert(faces.of_face[f]);
  ExactShape exact;
  std::vector<std::set<int>> true_at(shape.vertices.size());
  for (std::size_t v = 0; v < shape.vertices.size(); ++v) {
    const std::vector<int> meeting(at_corner[v].begin(), at_corner[v].end());
    exact.corners.push_back(planes_at(shape.vertices[v], faces.planes, meeting));
    for (const int i : meeting)
      for (const Plane& own : exact.corners.back())
        if (own.normal == faces.planes[std::size_t(i)].normal && own.offset == faces.planes[std::size_t(i)].offset)
          true_at[v].insert(i);
  }
  for (std::size_t f = 0; f < shape.faces.size(); ++f) {
    const auto& loop = shape.faces[f];
    if (loop.size() == 3 || std::all_of(loop.begin(), loop.end(),
                                        [&](int v) { return true_at[std::size_t(v)].contains(faces.of_face[f]); }))
      exact.faces.push_back(loop);
    else
      add_triangles(shape.vertices, loop, exact.faces);
  }
  return exact;
}

constexpr const char* cutter_name = "libvoussoir_cutter.so";

CutShape* cutter() {
  static CutShape* const function = [] {
    std::string file;
    try {
      file = shipped_library(cutter_name);
    } catch (const RunError&) {
      throw InputError(
          "the program was built without CGAL, which cuts shapes. Install it (Debian: libcgal-dev) and build the "
          "program again.");
    }
    void* const library = dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
    if (!library)
      throw RunError("the library that cuts shapes cannot be loaded: {}. Build the whole program again.", dlerror());
    auto* const found = reinterpret_cast<CutShape*>(dlsym(library, "voussoir_cut_shape"));
    if (!found) throw RunError("{} has another version. Build the whole program again.", cutter_name);
    return found;
  }();
  return function;
}

struct ConvexPiece {
  Polyhedron shape;
  Box box;
  double volume = 0.0, surface = 0.0;  // m3, m2
};

ConvexPiece make_convex_piece(const Polyhedron& shape) {
  const Polyhedron clean = merge_coplanar_faces(shape, 1e-6);
  return {clean, bounding_box(clean), mass_properties(clean).volume, surface_area(clean)};
}

/// Two pieces that may become one: how large the face between them is.
struct UnionOfTwo {
  std::size_t a = 0, b = 0;
  double face = 0.0;  // m2
  ConvexPiece whole;
};

/// The union is convex if the volume of its hull equals that of the two pieces.
std::optional<UnionOfTwo> union_of(const std::vector<ConvexPiece>& pieces, std::size_t a, std::size_t b, double slack) {
  const ConvexPiece &p = pieces[a], &q = pieces[b];
  const double near = 1e-9 * ((p.box.high - p.box.low).norm() + (q.box.high - q.box.low).norm());
  if (((q.box.low - p.box.high).array() > near).any() || ((p.box.low - q.box.high).array() > near).any()) return {};
  std::vector<Vec3> points = p.shape.vertices;
  points.insert(points.end(), q.shape.vertices.begin(), q.shape.vertices.end());
  const Polyhedron hull = convex_hull(points);
  if (mass_properties(hull).volume > p.volume + q.volume + slack) return {};
  UnionOfTwo out{a, b, 0.0, make_convex_piece(hull)};
  out.face = 0.5 * (p.surface + q.surface - out.whole.surface);
  return out;
}

void join_pieces(std::vector<ConvexPiece>& pieces, double slack) {
  while (true) {
    std::optional<UnionOfTwo> best;
    for (std::size_t a = 0; a < pieces.size(); ++a)
      for (std::size_t b = a + 1; b < pieces.size(); ++b)
        if (auto found = union_of(pieces, a, b, slack); found && (!best || found->face > best->face)) best = found;
    if (!best) return;
    pieces[best->a] = best->whole;
    pieces.erase(pieces.begin() + std::ptrdiff_t(best->b));
  }
}

/// The pieces of one try.
std::vector<Polyhedron> cut_along(const Polyhedron& shape, const Mat3& axes) {
  std::vector<Polyhedron> cut;
  std::string trouble;
  const Vec3 origin = shape.vertices.empty() ? Vec3::Zero() : shape.vertices[0];
  Polyhedron turned = shape;
  for (Vec3& v : turned.vertices) v = axes * (v - origin);
  cutter()(exact_shape(turned), cut, trouble);
  if (!trouble.empty()) throw InputError("{}", trouble);
  for (Polyhedron& piece : cut)
    for (Vec3& v : piece.vertices) v = axes.transpose() * v + origin;
  const double volume = mass_properties(shape).volume;
  std::vector<ConvexPiece> pieces;
  double sum = 0.0;
  for (const Polyhedron& piece : cut) {
    ConvexPiece made = make_convex_piece(piece);
    sum += made.volume;
    // Smaller pieces are due to rounding; the sum of volumes shows if they are not.
    if (made.volume > 1e-9 * volume) pieces.push_back(std::move(made));
  }
  join_pieces(pieces, 1e-9 * volume);
  std::vector<Polyhedron> out;
  double kept = 0.0;
  for (ConvexPiece& piece : pieces) {
    kept += piece.volume;
    out.push_back(std::move(piece.shape));
  }
  if (out.empty() || std::abs(sum - volume) > k_volume * volume || std::abs(kept - volume) > k_volume * volume)
    throw InputError("its {} a volume of {:.9g} m3 instead of {:.9g} m3: its surface may intersect itself",
                     counted(cut.size(), "piece has", "pieces have"), kept, volume);
  return out;
}

}  // namespace

std::vector<Polyhedron> decompose(const Polyhedron& shape) {
  std::vector<Polyhedron> best;
  std::string trouble;
  for (const Mat3& axes : axes_for(shape)) {
    try {
      std::vector<Polyhedron> pieces = cut_along(shape, axes);
      if (best.empty() || pieces.size() < best.size()) best = std::move(pieces);
    } catch (const InputError& error) {
      if (trouble.empty()) trouble = error.what();
    }
    if (best.size() == 2) break;
  }
  if (best.empty()) throw InputError("{}", trouble);
  return best;
}

}  // namespace voussoir
