// The parts of a masonry arch bridge. Each is a function that adds its stones to a layout (one file each,
// masonry_PART.cpp). All take their coordinates from one description of the bridge, so that neighbouring parts have
// equal coordinates where they meet. Coordinates (x, y, z) are in m, in the axes of Bridge.
#pragma once
#include <algorithm>
#include <numeric>
#include <utility>

#include "geometry/masonry.h"
#include "geometry/vault_shape.h"

namespace voussoir {

/// A vault over one span.
struct Vault {
  std::vector<Ring> rings;        // the lowest first
  std::vector<double> thickness;  // m, of each ring at the crown
  Vec3 voussoir = Vec3::Ones();   // m: along the arc, across, thickness of the highest ring
  std::int32_t material = 0;
  /// Number of courses from one course of headers (stones through two rings) to the next; 0: no headers.
  std::size_t headers_every = 0;
  /// Nominal size of a stone through `through` rings from `ring` on.
  Vec3 stone(std::size_t ring, std::size_t through) const {
    const auto from = thickness.begin() + std::ptrdiff_t(ring);
    return {voussoir.x(), voussoir.y(), std::accumulate(from, from + std::ptrdiff_t(through), 0.0)};
  }
  double left() const { return rings.front().intrados.front().x(); }  // m, of the opening, at the springings
  double right() const { return rings.front().intrados.back().x(); }
};

/// The cutwaters on both side faces of a pier, from its base upwards.
struct Cutwater {
  double length = 0.0;  // m, beyond the side face; 0: no cutwaters
  double height = 0.0;  // m, above the base
  bool round = false;   // half an ellipse in flat facets, or a triangle
};

/// Walls beyond the end of a bridge, on the base of its abutment: two wing walls that continue the side faces and splay
/// outwards, and counterforts against the end face between them.
struct Wings {
  double length = 0.0, thickness = 0.0;  // m, along the bridge and across it; length 0: none
  double slope = 0.0;                    // tangent of the splay angle
  double top = 0.0;                      // z
  int counterforts = 0;
  double counterfort_length = 0.0, counterfort_thickness = 0.0, counterfort_top = 0.0;  // m; z
};

/// Make-up of a support: solid courses, or an outer leaf around infill or around a void.
enum class Makeup { solid, leaf, hollow };

/// Walls along the bridge between the spandrel walls, on the vaults and the backing. They reach the deck with fill
/// between them, or slabs from wall to wall with voids below.
struct InternalWalls {
  int number = 0;
  double thickness = 0.0;  // m
  bool hollow = false;
  double slab_top = 0.0, slab_thickness = 0.0;  // z; m
  double bearing = 0.1;                         // m, of the slabs on the spandrel walls
  double slab_bottom() const { return slab_top - slab_thickness; }
};

/// The beam of a loading test, across the fill from wall to wall.
struct LoadBeam {
  double length = 0.0, height = 0.0;  // m, along the bridge, and its depth; length 0: none
  double middle = 0.0;                // x
};

/// A support of vaults: an abutment or a pier.
struct Support {
  double x0 = 0.0, x1 = 0.0;            // m, at the springing
  double height = 0.0;                  // m, from the base to the springing
  double base = 0.0, springing = 0.0;   // z
  double top = 0.0;                     // z of the highest foot of a vault on it
  double slope_x = 0.0, slope_y = 0.0;  // batter, horizontal over vertical, widening downwards; x: piers only
  double width = 0.0;                   // m, across, at the springing
  std::int32_t material = 0;            // material of its stones, not of its infill
  Makeup makeup = Makeup::solid;
  Cutwater cutwater = {};         // of a pier
  Wings wings = {};               // of an abutment
  double leaf_beside_span = 0.0;  // m, length next to the span of an abutment with a leaf; the rest has wing walls
};

/// Direction of the bed joints of a skew vault: along its axis, or square to the faces at the chord or everywhere.
enum class SkewBond { parallel, helicoidal, logarithmic };

/// Dimensions of a bridge in m (block sizes already scaled), in the axes of the whole program: x along, origin at the
/// left end; y across, 0 at mid-width; z up, 0 at the top of the lowest base. A skew bridge is laid out square, with x
/// square to its supports; turn_to_skew() skews it when all stones are laid.
struct Bridge {
  std::vector<Vault> vaults;      // from left to right
  std::vector<Support> supports;  // left abutment, piers, right abutment
  InternalWalls internal = {};
  LoadBeam beam = {};
  bool strip = false;  // in plane strain: no walls along the faces, no parapets
  double width = 0.0;
  double skew = 0.0;  // rad, skew angle of the supports
  SkewBond skew_bond = SkewBond::parallel;
  double springing = 0.0;    // z of the lowest springing, where spandrel walls, backing and fill begin
  double deck = 0.0;         // z, where it is highest
  double gradient = 0.0;     // rise of the deck over x
  double deck_start = 0.0;   // z of a deck with a gradient at x = 0
  double backing_top = 0.0;  // z
  Polygon backing_line;      // top of the backing from end to end if it is not level; otherwise empty
  double backing_over_abutment[2] = {0.0, 0.0};      // length over the abutment from the span, left and right
  double spandrel_bottom = 0.0, spandrel_top = 0.0;  // thickness, stepped by course in between
  bool tapered = false;  // walls whose back is one plane: laid out with `spandrel_bottom` everywhere, see taper()
  double taper_bottom = 0.0, taper_top = 0.0;  // m, their thickness at the springing and at the deck
  double parapet_height = 0.0, parapet_thickness = 0.0;
  double string_height = 0.0, string_projection = 0.0;  // of a string course between deck and parapet
  double transverse_thickness = 0.0;                    // of transverse walls over the piers; 0: none
  double surfacing_depth = 0.0;                         // m, of the topmost part of the fill; 0: none
  double base_depth = 1.0, restraint_depth = 1.0;
  double wing_wall_thickness = 0.0;
  double leaf_thickness[2] = {0.0, 0.0};  // even and odd courses
  bool rigid_backfill = true;
  bool deformable_backfill = false;
  double fill_edge = 0.5;   // longest edge of its tetrahedra
  bool fill_bonded = true;  // rigid backfill in running bond, or stacked
  bool restrained = false;
  Vec3 block = Vec3::Ones();       // masonry laid in courses: along x, across y, height
  Vec3 leaf_piece = Vec3::Ones();  // along the face, -, course height
  Vec3 infill = Vec3::Ones();
  Vec3 fill = Vec3::Ones();
  // Indices of materials. Each vault and each support also has its own.
  std::int32_t masonry = 0, vault = 0, infill_material = 0, backfill = 0;
  std::int32_t surfacing = 0;

  double length() const { return supports.back().x1; }
  double half_width() const { return 0.5 * width; }
  double spandrel_at(double z) const;  // m, thickness of tapered walls
  double spread_at(double z) const;    // factor on y between tapered walls, relative to the layout
  double half_width(std::size_t support) const { return 0.5 * supports[support].width; }
  double deck_at(double x) const { return gradient == 0.0 ? deck : deck_start + gradient * x; }
  std::size_t last_support() const { return supports.size() - 1; }
  bool is_abutment(std::size_t support) const { return support == 0 || support == last_support(); }
  Unit unit(Component component, int part) const;  // masonry block of a component
  Unit support_unit(std::size_t support) const;    // masonry block of an abutment or a pier
  Unit fill_unit() const;                          // rigid backfill
  SectionLimits limits() const;                    // the space of vaults and supports above the springing
};

/// A part of the height above the springing with spandrel walls of one thickness.
struct Band {
  double z0 = 0.0, z1 = 0.0;  // m
  double thickness = 0.0;     // m, of each spandrel wall
};
/// The courses of the spandrel walls. A course ends at the top of the backing; thickness goes from the bottom one in
/// the first course to the top one in the last.
std::vector<Band> spandrel_courses(const Bridge& bridge);
/// The same, where courses with equal thickness on one side of the top of the backing are one band. The space between
/// the walls is laid in these bands.
std::vector<Band> interior_bands(const Bridge& bridge);

/// Moves the stones from index `first` on across the bridge, from walls of one thickness to tapered walls.
void taper(Layout& layout, const Bridge& bridge, std::size_t first);
/// Largest factor by which taper() lengthens an edge between the walls.
double longest_stretch(const Bridge& bridge);

/// The ranges of x of the transverse walls over the piers, and the ranges between them, both from left to right, m.
std::vector<std::pair<double, double>> transverse_walls(const Bridge& bridge);
std::vector<std::pair<double, double>> between_transverse_walls(const Bridge& bridge);
void lay_transverse_walls(Layout& layout, const Bridge& bridge);

/// The ranges of y of the internal walls, and the ranges between them from -inner to inner, m.
std::vector<std::pair<double, double>> internal_walls(const Bridge& bridge);
std::vector<std::pair<double, double>> lanes(const Bridge& bridge, double inner);
void lay_internal_walls(Layout& layout, const Bridge& bridge);
/// Lays the part of a box above the backing in courses.
void lay_above_backing(Layout& layout, const Bridge& bridge, const Vec3& low, const Vec3& high, const Unit& unit,
                       int course);

/// Calls `piece` for each straight piece of the top of the backing between x0 and x1, with the half-plane below it.
template <class Piece>
void along_backing(const Bridge& bridge, double x0, double x1, Piece&& piece);

/// The half-plane below a straight piece of the top of the backing, given from left to right, and the opposite one.
Plane under_backing(const Vec3& from, const Vec3& to);
Plane opposite(const Plane& plane);

template <class Piece>
void along_backing(const Bridge& bridge, double x0, double x1, Piece&& piece) {
  const Polygon& line = bridge.backing_line;
  for (std::size_t i = 0; i + 1 < line.size(); ++i) {
    const double from = std::max(x0, line[i].x()), to = std::min(x1, line[i + 1].x());
    if (to - from > no_masonry) piece(from, to, under_backing(line[i], line[i + 1]));
  }
}

/// A box of the fill, without the space within the extrados of vaults.
struct FillRegion {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  // m
  std::ptrdiff_t support = -1;                   // the abutment between whose wing walls it is; -1: above the springing
  int course = 0;                                // number of its lowest course in the bond
  /// No fill beyond these planes, in addition to the limits of the bridge: the top of the backing below the box, and
  /// the underside of the surfacing.
  std::vector<Plane> past = {};
  int lane = 0;            // number of the space between internal walls to which it belongs
  bool surfacing = false;  // whether it has the material of the surfacing
};
/// The boxes of the fill, which do not overlap: those between the wing walls, then those above the springing upwards.
/// They are used for rigid and for deformable fill. They overlap a backing that is not level; `past` then limits the
/// fill.
std::vector<FillRegion> fill_regions(const Bridge& bridge);
/// The parts of the boxes above the springing that are not fill, besides the vaults, as polygons: the backing, and the
/// space above the deck.
std::vector<Polygon> beside_fill(const Bridge& bridge);
double fill_space(const Bridge& bridge);  // m3, of the boxes without the space of the vaults
/// Range of x of the wing walls of an abutment, m; empty (equal ends) if it has none.
std::pair<double, double> wing_extent(const Bridge& bridge, std::size_t support);

/// "abutment left", "pier 0", …, "abutment right".
std::string support_name(const Bridge& bridge, std::size_t support);

/// Number of rings of a stone of a course that begins in `ring`; 0: the stone is a header that begins in the ring
/// below. With more than two rings the pairs of rings that headers bond alternate.
std::size_t rings_of_stone(const Vault& vault, std::size_t ring, std::int64_t course);
/// Whether a wedge belongs to the keystone: the middle wedge, or those on both sides of a joint at the crown.
bool at_crown(int wedge, int wedges);
/// Adds the stones from index `from` on to the groups of their rings.
void name_rings(Layout& layout, std::size_t vault, std::size_t first_ring, std::size_t rings, std::size_t from);

/// Adds the stones from index `from` on to the group of a quarter point of a vault: 0 left, 1 right, −1 none.
void name_quarter(Layout& layout, std::size_t vault, int quarter, std::size_t from);

/// Lays one vault in helicoidal or logarithmic bond. Throws InputError for an intrados that is vertical or overhangs.
void lay_oblique(Layout& layout, const Bridge& bridge, std::size_t vault);
/// Skews the layout: x becomes x / cos + y tan of the skew angle.
void turn_to_skew(Layout& layout, double skew);
Vec3 at_skew(const Vec3& p, double skew);

/// Also sets the rings of the limits of the layout. Groups "keystone i", "quarter i left", …
void lay_vaults(Layout& layout, const Bridge& bridge);
void lay_piers(Layout& layout, const Bridge& bridge);      // groups "pier top 0" …
void lay_abutments(Layout& layout, const Bridge& bridge);  // with wing walls and the fill between them
/// The supports from the springing to the feet of the vaults. Then sets the limits of the layout for all later parts.
void lay_skewbacks(Layout& layout, const Bridge& bridge);
void lay_spandrels(Layout& layout, const Bridge& bridge);  // groups "spandrel y- pier 0" …
void lay_backing(Layout& layout, const Bridge& bridge);
void lay_backfill(Layout& layout, const Bridge& bridge);
/// One box of the rigid fill.
void lay_region(Layout& layout, const Bridge& bridge, const FillRegion& region);
void lay_parapets(Layout& layout, const Bridge& bridge);
void lay_load_beam(Layout& layout, const Bridge& bridge);    // group "load"
void lay_strip_walls(Layout& layout, const Bridge& bridge);  // group "walls"
void smooth_strip_walls(Assembly& assembly);                 // removes friction and bond on them
void lay_bases(Layout& layout, const Bridge& bridge);        // groups "base pier 0" …
void lay_restraints(Layout& layout, const Bridge& bridge);   // groups "restraint left" and "restraint right"

/// A support in solid courses. Its plan at the top is [x0, x1] x [-half_width, half_width]; faces are battered outwards
/// going down by the given slopes (left, right, and both sides across).
struct Solid {
  double x0 = 0.0, x1 = 0.0, half_width = 0.0, z0 = 0.0, z1 = 0.0;
  double slope_left = 0.0, slope_right = 0.0, slope_across = 0.0;
};
void lay_solid(Layout& layout, const Solid& solid, const Unit& unit);

/// A support with the shape of a box: an outer leaf in courses of alternating thickness with bonded corners, and infill
/// in courses of half the height. A hollow support has no infill, and slabs from face to face as its top course.
void lay_leaf_and_infill(Layout& layout, const Bridge& bridge, const Vec3& low, const Vec3& high, std::size_t support);
void lay_cutwaters(Layout& layout, const Bridge& bridge, std::size_t support);
/// Wing walls and counterforts of an abutment, and the part of its base below them.
void lay_wing_walls(Layout& layout, const Bridge& bridge, std::size_t support);
std::vector<Polyhedron> base_of_wings(const Bridge& bridge, std::size_t support);

}  // namespace voussoir
