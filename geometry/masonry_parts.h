// The parts of a masonry arch bridge, each a function that adds its stones to a layout (one small file each,
// masonry_PART.cpp). All share one description of the bridge and take their coordinates from it, so that neighbours
// meet at equal coordinates.
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
  Vec3 voussoir = Vec3::Ones();   // m: along the arc, across, thickness of the highest ring, which the fill lies on
  std::int32_t material = 0;
  std::size_t headers_every = 0;  // courses, from one of headers (stones through two rings) to the next; 0: none
  /// Nominal size of a stone through some rings from one on.
  Vec3 stone(std::size_t ring, std::size_t through) const {
    const auto from = thickness.begin() + std::ptrdiff_t(ring);
    return {voussoir.x(), voussoir.y(), std::accumulate(from, from + std::ptrdiff_t(through), 0.0)};
  }
  double left() const { return rings.front().intrados.front().x(); }  // m, of the opening, at the springings
  double right() const { return rings.front().intrados.back().x(); }
};

/// A nose of stones on each side face of a pier, from its base on.
struct Cutwater {
  double length = 0.0;  // m, out of the side face; 0: none
  double height = 0.0;  // m, above the base
  bool round = false;   // half an ellipse in flat facets, or a triangle
};

/// Walls beyond the end of a bridge, on the base of its abutment: two wings that go on from the side faces and splay
/// outwards, and counterforts against the end face between them.
struct Wings {
  double length = 0.0, thickness = 0.0;  // m, along the bridge and across it; length 0: none
  double slope = 0.0;                    // way outwards over way along
  double top = 0.0;                      // z
  int counterforts = 0;
  double counterfort_length = 0.0, counterfort_thickness = 0.0, counterfort_top = 0.0;  // m; z
};

/// What a support is made of: solid courses, or an outer leaf around loose infill or around nothing.
enum class Makeup { solid, leaf, hollow };

/// Walls along the bridge between the spandrel walls, from the vaults and the backing to the deck with fill between
/// them, or to slabs from wall to wall with nothing below.
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

/// What vaults spring from: an abutment or a pier.
struct Support {
  double x0 = 0.0, x1 = 0.0;            // m, at the springing
  double height = 0.0;                  // m, from the base to the springing
  double base = 0.0, springing = 0.0;   // z
  double top = 0.0;                     // z of the highest end of a vault's foot on it
  double slope_x = 0.0, slope_y = 0.0;  // batter of its faces, widening downwards; x: of piers
  double width = 0.0;                   // m, across, at the springing
  std::int32_t material = 0;            // of its stones, not of its infill
  Makeup makeup = Makeup::solid;
  Cutwater cutwater = {};         // of a pier
  Wings wings = {};               // of an abutment
  double leaf_beside_span = 0.0;  // m, of an abutment with a leaf: the rest has wing walls
};

/// How the beds of a skew vault run: along its axis, or square to the faces at the chord or everywhere.
enum class SkewBond { parallel, helicoidal, logarithmic };

/// Dimensions of a bridge in m (block sizes already scaled), in the axes of the whole program: x along, origin at the
/// left end; y across, 0 at mid-width; z up, 0 at the top of the lowest base. A skew bridge is laid out square, with x
/// square to its supports, and turned by turn_to_skew() once all is laid.
struct Bridge {
  std::vector<Vault> vaults;      // from left to right
  std::vector<Support> supports;  // left abutment, piers, right abutment
  InternalWalls internal = {};
  LoadBeam beam = {};
  bool strip = false;  // in plane strain: no walls along the faces, no parapets
  double width = 0.0;
  double skew = 0.0;  // rad, of the supports against the square to the axis
  SkewBond skew_bond = SkewBond::parallel;
  double springing = 0.0;    // z of the lowest springing, where spandrel walls, backing and fill begin
  double deck = 0.0;         // z, where it is highest
  double gradient = 0.0;     // rise of the deck over x
  double deck_start = 0.0;   // z of a deck with a gradient at x = 0
  double backing_top = 0.0;  // z
  Polygon backing_line;      // its top from end to end, where it is not level; otherwise empty
  double backing_over_abutment[2] = {0.0, 0.0};      // length beside the span, left and right
  double spandrel_bottom = 0.0, spandrel_top = 0.0;  // thickness, stepped by course in between
  bool tapered = false;  // walls whose back is one plane: laid out with `spandrel_bottom` everywhere, see taper()
  double taper_bottom = 0.0, taper_top = 0.0;  // m, their thickness at the springing and at the deck
  double parapet_height = 0.0, parapet_thickness = 0.0;
  double string_height = 0.0, string_projection = 0.0;  // of a string course between deck and parapet
  double transverse_thickness = 0.0;                    // of walls across over the piers; 0: none
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
  std::int32_t masonry = 0, vault = 0, infill_material = 0, backfill = 0;  // materials; of vaults and supports as usual
  std::int32_t surfacing = 0;

  double length() const { return supports.back().x1; }
  double half_width() const { return 0.5 * width; }
  double spandrel_at(double z) const;  // m, thickness of walls that are tapered
  double spread_at(double z) const;    // factor on y of what lies between them, against the layout
  double half_width(std::size_t support) const { return 0.5 * supports[support].width; }
  double deck_at(double x) const { return gradient == 0.0 ? deck : deck_start + gradient * x; }
  std::size_t last_support() const { return supports.size() - 1; }
  bool is_abutment(std::size_t support) const { return support == 0 || support == last_support(); }
  Unit unit(Component component, int part) const;  // masonry block of a component
  Unit support_unit(std::size_t support) const;    // masonry block of an abutment or a pier
  Unit fill_unit() const;                          // rigid backfill
  SectionLimits limits() const;                    // what vaults and supports take up above the springing
};

/// A part of the height above the springing with spandrel walls of one thickness.
struct Band {
  double z0 = 0.0, z1 = 0.0;  // m
  double thickness = 0.0;     // m, of each spandrel wall
};
/// The courses of the spandrel walls. A course ends at the top of the backing; thickness goes from the bottom one in
/// the first course to the top one in the last.
std::vector<Band> spandrel_courses(const Bridge& bridge);
/// The same with courses of equal thickness on one side of the backing's top taken together: what the space between the
/// walls is laid in.
std::vector<Band> interior_bands(const Bridge& bridge);

/// Moves the stones from one on across, from walls of one thickness to tapered ones.
void taper(Layout& layout, const Bridge& bridge, std::size_t first);
/// By how much that lengthens an edge between the walls at most.
double longest_stretch(const Bridge& bridge);

/// Where walls stand across over the piers, and what they leave of the length, both from left to right: from and to, m.
std::vector<std::pair<double, double>> transverse_walls(const Bridge& bridge);
std::vector<std::pair<double, double>> between_transverse_walls(const Bridge& bridge);
void lay_transverse_walls(Layout& layout, const Bridge& bridge);

/// From where to where internal walls stand across, and what they leave between -inner and inner, m.
std::vector<std::pair<double, double>> internal_walls(const Bridge& bridge);
std::vector<std::pair<double, double>> lanes(const Bridge& bridge, double inner);
void lay_internal_walls(Layout& layout, const Bridge& bridge);
/// What of a box lies above the backing, in courses.
void lay_above_backing(Layout& layout, const Bridge& bridge, const Vec3& low, const Vec3& high, const Unit& unit,
                       int course);

/// Calls `piece` for each straight piece of the backing's top between x0 and x1, with the half-plane under it.
template <class Piece>
void along_backing(const Bridge& bridge, double x0, double x1, Piece&& piece);

/// The half-plane under a straight piece of the backing's top, which goes from left to right, and the other one.
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

/// A box of the fill; what lies within a vault's extrados does not belong to it.
struct FillRegion {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  // m
  std::ptrdiff_t support = -1;   // the abutment between whose wing walls it lies; -1: above the springing
  int course = 0;                // number of its lowest course in the bond
  std::vector<Plane> past = {};  // beside the bridge's limits: of the backing below it
  int lane = 0;                  // which of the spaces between internal walls it belongs to
  bool surfacing = false;        // of the material of the surfacing
};
/// The boxes of the fill, which do not overlap: between the wing walls, then those above the springing from below. The
/// rigid fill is laid in them and the deformable one is meshed in them. Over a backing that is not level they overlap
/// it, and `past` says where the fill ends.
std::vector<FillRegion> fill_regions(const Bridge& bridge);
/// What is not fill in the boxes above the springing beside the vaults, as polygons: the backing, what is above the
/// deck.
std::vector<Polygon> beside_fill(const Bridge& bridge);
double fill_space(const Bridge& bridge);  // m3, of the boxes less what lies within the vaults
/// From where to where the wing walls of an abutment go, m; of equal ends when it has none.
std::pair<double, double> wing_extent(const Bridge& bridge, std::size_t support);

/// "abutment left", "pier 0", …, "abutment right".
std::string support_name(const Bridge& bridge, std::size_t support);

/// Over how many rings a stone of a course reaches that begins in `ring`; 0: the ring below has it as a header. With
/// more than two rings the pairs that headers bind alternate.
std::size_t rings_of_stone(const Vault& vault, std::size_t ring, std::int64_t course);
/// Whether a wedge is of the keystone: the middle one, or those on both sides of a joint at the crown.
bool at_crown(int wedge, int wedges);
/// Puts the stones from number `from` on into the groups of their rings.
void name_rings(Layout& layout, std::size_t vault, std::size_t first_ring, std::size_t rings, std::size_t from);

/// Puts the stones from number `from` on into the group of a quarter point of a vault, 0 left and 1 right; −1: none.
void name_quarter(Layout& layout, std::size_t vault, int quarter, std::size_t from);

/// The barrel of one vault in helicoidal or logarithmic bond. Throws InputError for an intrados that is upright or
/// overhangs.
void lay_oblique(Layout& layout, const Bridge& bridge, std::size_t vault);
/// From where things are laid out to where they are: x to x / cos + y tan, so that what was square to the supports is.
void turn_to_skew(Layout& layout, double skew);
Vec3 at_skew(const Vec3& p, double skew);

void lay_vaults(Layout& layout,
                const Bridge& bridge);  // sets the layout's rings; groups "keystone i", "quarter i left", …
void lay_piers(Layout& layout, const Bridge& bridge);      // groups "pier top 0" …
void lay_abutments(Layout& layout, const Bridge& bridge);  // with wing walls and the fill between them
void lay_skewbacks(Layout& layout, const Bridge& bridge);  // supports from the springing to the vaults' feet
void lay_spandrels(Layout& layout, const Bridge& bridge);  // groups "spandrel y- pier 0" …
void lay_backing(Layout& layout, const Bridge& bridge);
void lay_backfill(Layout& layout, const Bridge& bridge);
/// One box of the rigid fill.
void lay_region(Layout& layout, const Bridge& bridge, const FillRegion& region);
void lay_parapets(Layout& layout, const Bridge& bridge);
void lay_load_beam(Layout& layout, const Bridge& bridge);    // group "load"
void lay_strip_walls(Layout& layout, const Bridge& bridge);  // group "walls"
void smooth_strip_walls(Assembly& assembly);                 // neither friction nor bond on them
void lay_bases(Layout& layout, const Bridge& bridge);        // groups "base pier 0" …
void lay_restraints(Layout& layout, const Bridge& bridge);   // groups "restraint left" and "restraint right"

/// A support in solid courses. Its plan at the top is [x0, x1] x [-half_width, half_width]; faces are battered outwards
/// going down by the given slopes (left, right, and both sides across).
struct Solid {
  double x0 = 0.0, x1 = 0.0, half_width = 0.0, z0 = 0.0, z1 = 0.0;
  double slope_left = 0.0, slope_right = 0.0, slope_across = 0.0;
};
void lay_solid(Layout& layout, const Solid& solid, const Unit& unit);

/// A support of box shape: an outer leaf of pieces in courses whose thickness alternates, corners bonded by turns, and
/// infill within in courses of half the height. A hollow one has no infill, and slabs from face to face as its top
/// course.
void lay_leaf_and_infill(Layout& layout, const Bridge& bridge, const Vec3& low, const Vec3& high, std::size_t support);
void lay_cutwaters(Layout& layout, const Bridge& bridge, std::size_t support);
/// Wings and counterforts of an abutment, and what its base has below them.
void lay_wing_walls(Layout& layout, const Bridge& bridge, std::size_t support);
std::vector<Polyhedron> base_of_wings(const Bridge& bridge, std::size_t support);

}  // namespace voussoir
