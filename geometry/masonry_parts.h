// The parts of a masonry arch bridge, each a function that adds its stones to a layout (one small file each,
// masonry_PART.cpp). All share one description of the bridge and take their coordinates from it, so that neighbours
// meet at equal coordinates.
#pragma once
#include <utility>

#include "geometry/masonry.h"
#include "geometry/vault_shape.h"

namespace voussoir {

/// A vault over one span.
struct Vault {
  std::vector<Ring> rings;                                            // the lowest first
  Vec3 voussoir = Vec3::Ones();                                       // m: along the arc, across, thickness of a ring
  double left() const { return rings.front().intrados.front().x(); }  // m, of the opening, at the springings
  double right() const { return rings.front().intrados.back().x(); }
};

/// What vaults spring from: an abutment or a pier.
struct Support {
  double x0 = 0.0, x1 = 0.0;            // m, at the springing
  double height = 0.0;                  // m, from the base to the springing
  double base = 0.0, springing = 0.0;   // z
  double top = 0.0;                     // z of the highest end of a vault's foot on it
  double slope_x = 0.0, slope_y = 0.0;  // batter of its faces, widening downwards; x: of piers
  bool leaf = false;                    // an outer leaf and infill, or solid
  double leaf_beside_span = 0.0;        // m, of an abutment with a leaf: the rest has wing walls
};

/// Dimensions of a bridge in m (block sizes already scaled), in the axes of the whole program: x along, origin at the
/// left end; y across, 0 at mid-width; z up, 0 at the top of the lowest base.
struct Bridge {
  std::vector<Vault> vaults;      // from left to right
  std::vector<Support> supports;  // left abutment, piers, right abutment
  double width = 0.0;
  double springing = 0.0;    // z of the lowest springing, where spandrel walls, backing and fill begin
  double deck = 0.0;         // z
  double backing_top = 0.0;  // z
  double backing_over_abutment[2] = {0.0, 0.0};      // length beside the span, left and right
  double spandrel_bottom = 0.0, spandrel_top = 0.0;  // thickness
  double parapet_height = 0.0, parapet_thickness = 0.0;
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
  std::int32_t masonry = 0, vault = 0, infill_material = 0, backfill = 0;  // materials

  double length() const { return supports.back().x1; }
  double half_width() const { return 0.5 * width; }
  std::size_t last_support() const { return supports.size() - 1; }
  bool is_abutment(std::size_t support) const { return support == 0 || support == last_support(); }
  Unit unit(Component component, int part) const;  // masonry block of a component
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

/// A box of the fill; what lies within a vault's extrados does not belong to it.
struct FillRegion {
  Vec3 low = Vec3::Zero(), high = Vec3::Zero();  // m
  std::ptrdiff_t support = -1;  // the abutment between whose wing walls it lies; -1: above the springing
  int course = 0;               // number of its lowest course in the bond
};
/// The boxes of the fill, which do not overlap: between the wing walls, then those above the springing from below. The
/// rigid fill is laid in them and the deformable one is meshed in them.
std::vector<FillRegion> fill_regions(const Bridge& bridge);
double fill_space(const Bridge& bridge);  // m3, of the boxes less what lies within the vaults
/// From where to where the wing walls of an abutment go, m; of equal ends when it has none.
std::pair<double, double> wing_extent(const Bridge& bridge, std::size_t support);

/// "abutment left", "pier 0", …, "abutment right".
std::string support_name(const Bridge& bridge, std::size_t support);

void lay_vaults(Layout& layout, const Bridge& bridge);  // sets the layout's rings; groups "keystone i"
void lay_piers(Layout& layout, const Bridge& bridge);
void lay_abutments(Layout& layout, const Bridge& bridge);  // with wing walls and the fill between them
void lay_skewbacks(Layout& layout, const Bridge& bridge);  // supports from the springing to the vaults' feet
void lay_spandrels(Layout& layout, const Bridge& bridge);  // groups "spandrel y- pier 0" …
void lay_backing(Layout& layout, const Bridge& bridge);
void lay_backfill(Layout& layout, const Bridge& bridge);
void lay_parapets(Layout& layout, const Bridge& bridge);
void lay_bases(Layout& layout, const Bridge& bridge);       // groups "base pier 0" …
void lay_restraints(Layout& layout, const Bridge& bridge);  // groups "restraint left" and "restraint right"

/// A support in solid courses. Its plan at the top is [x0, x1] x [-half_width, half_width]; faces are battered outwards
/// going down by the given slopes (left, right, and both sides across).
struct Solid {
  double x0 = 0.0, x1 = 0.0, half_width = 0.0, z0 = 0.0, z1 = 0.0;
  double slope_left = 0.0, slope_right = 0.0, slope_across = 0.0;
};
void lay_solid(Layout& layout, const Solid& solid, const Unit& unit);

/// A support of box shape: an outer leaf of pieces in courses whose thickness alternates, corners bonded by turns, and
/// infill within in courses of half the height.
void lay_leaf_and_infill(Layout& layout, const Bridge& bridge, const Vec3& low, const Vec3& high, Component component,
                         int part, int support);

}  // namespace voussoir
