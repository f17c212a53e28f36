// Rings of voussoirs in the plane x-z, and the parts of polygons outside them.
#pragma once
#include <optional>
#include <vector>

#include "geometry/polyhedron.h"

namespace voussoir {

/// A ring of flat-faced wedges in the plane x-z: joint i runs from intrados[i] to extrados[i], from left to right.
struct Ring {
  Polygon intrados, extrados;  // y = 0, m; one more point than there are wedges
  /// m, for a semicircle: the point at the springing level where the planes of the joints meet. Without it the plane of
  /// a joint passes through its ends.
  std::optional<Vec3> centre = {};
  int wedges() const { return int(intrados.size()) - 1; }
  Polygon wedge(int i) const {  // counter-clockwise seen from -y
    const auto k = std::size_t(i);
    return {intrados[k], intrados[k + 1], extrados[k + 1], extrados[k]};
  }
};

/// A semicircular ring of `wedges` equal wedges. The feet are exactly at the springing level, and the halves are mirror
/// images about `centre` bit for bit.
Ring make_semicircle(const Vec3& centre, double inner_radius, double outer_radius, int wedges);

/// 0 for a wedge above the left quarter point of the span in plan, 1 for the right one, −1 for neither. If a joint is
/// above the quarter point, both its neighbours count.
int quarter_of(const Polygon& intrados, int wedge);

/// The upright rectangle [x0, x1] × [z0, z1] in the plane y = 0.
Polygon rectangle(double x0, double x1, double z0, double z1);

/// Thickness in m below which a piece of a polygon is due to rounding and not masonry.
constexpr double no_masonry = 1e-7;
/// Whether a polygon is thinner than no_masonry everywhere.
bool is_nothing(const Polygon& polygon);

/// The parts of a convex polygon in the plane x-z that lie outside a ring and outside the opening below it, as convex
/// polygons. They meet along the planes of the ring's joints.
std::vector<Polygon> outside(const Polygon& polygon, const Ring& ring);

/// The limits of the stones of a section, in the plane x-z.
struct SectionLimits {
  std::vector<Ring> rings;  // no stones in them or in the openings below them
  std::vector<Box> taken;   // supports: no stones in them, and no polygon reaches below them
  std::vector<Plane> past;  // such as a sloping deck: no stones beyond them
};
/// The parts of a convex polygon within the limits, as convex polygons.
std::vector<Polygon> within(const Polygon& polygon, const SectionLimits& limits);
/// Whether the limits may cut a polygon.
bool reach(const SectionLimits& limits, const Polygon& polygon);

}  // namespace voussoir
