// The parts of a masonry arch bridge, each a function that adds its stones to a layout (one small file each,
// masonry_PART.cpp). All share one description of the bridge and take their coordinates from it, so that neighbours
// meet at equal coordinates.
#pragma once
#include <utility>

#include "geometry/masonry.h"

namespace voussoir {

/// Dimensions of a bridge in m (block sizes already scaled), in the axes of the whole program: x along, origin at the
/// left end; y across, 0 at mid-width; z up, 0 at the top of the lowest base.
struct Bridge {
  int spans = 1;
  double clear_span = 0.0, width = 0.0;
  std::vector<double> own_spans;     // clear spans of the vaults, `spans` of them
  double pier_thickness = 0.0;       // at the springing
  std::vector<double> pier_heights;  // base to springing, spans - 1 of them
  double abutment_height = 0.0, abutment_length = 0.0;
  double batter_x = 0.0, batter_y = 0.0;  // per face, widening downwards; x: piers only
  double ring_thickness = 0.0;
  int voussoirs = 0;  // a vault
  double fill_over_crown = 0.0;
  double backing_height = 0.0;                       // above the springing
  double backing_over_abutment = 0.0;                // length beside the span
  double spandrel_bottom = 0.0, spandrel_top = 0.0;  // thickness
  double parapet_height = 0.0, parapet_thickness = 0.0;
  double base_depth = 1.0, restraint_depth = 1.0;
  bool leaf = false;                     // piers and abutments: outer leaf and infill, or solid
  double leaf_length_beside_span = 0.0;  // abutments with a leaf: the rest has wing walls
  double wing_wall_thickness = 0.0;
  double leaf_thickness[2] = {0.0, 0.0};  // even and odd courses
  bool rigid_backfill = true;
  bool deformable_backfill = false;
  double fill_edge = 0.5;   // longest edge of its tetrahedra
  bool fill_bonded = true;  // rigid backfill in running bond, or stacked
  bool restrained = false;
  Vec3 voussoir = Vec3::Ones();    // along the arc, across, ring thickness
  Vec3 block = Vec3::Ones();       // masonry laid in courses: along x, across y, height
  Vec3 leaf_piece = Vec3::Ones();  // along the face, -, course height
  Vec3 infill = Vec3::Ones();
  Vec3 fill = Vec3::Ones();
  std::int32_t masonry = 0, vault = 0, infill_material = 0, backfill = 0;  // materials

  double springing() const;  // z
  double deck() const;       // z
  double length() const;
  double span_start(int i) const;  // x of the left springing of vault i
  double span_end(int i) const { return span_start(i) + own_spans[std::size_t(i)]; }
  double half_width() const { return 0.5 * width; }
  int supports() const { return spans + 1; }  // left abutment, piers, right abutment
  bool is_abutment(int support) const { return support == 0 || support == spans; }
  double support_height(int support) const;
  double support_base(int support) const { return springing() - support_height(support); }  // z
  double support_start(int support) const;                                                  // x at the springing
  double support_end(int support) const;
  Unit unit(Component component, int part) const;  // masonry block of a component
  Unit fill_unit() const;                          // rigid backfill
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
  int support = -1;  // the abutment between whose wing walls it lies; -1: above the springing
  int course = 0;    // number of its lowest course in the bond
};
/// The boxes of the fill, which do not overlap: between the wing walls, then those above the springing from below. The
/// rigid fill is laid in them and the deformable one is meshed in them.
std::vector<FillRegion> fill_regions(const Bridge& bridge);
double fill_space(const Bridge& bridge);  // m3, of the boxes less what lies within the vaults
/// From where to where the wing walls of an abutment go, m; of equal ends when it has none.
std::pair<double, double> wing_extent(const Bridge& bridge, int support);

/// "abutment left", "pier 0", …, "abutment right".
std::string support_name(const Bridge& bridge, int support);

std::vector<Ring> vault_rings(const Bridge& bridge);
void lay_vaults(Layout& layout, const Bridge& bridge);  // sets layout.rings; groups "keystone i"
void lay_piers(Layout& layout, const Bridge& bridge);
void lay_abutments(Layout& layout, const Bridge& bridge);  // with wing walls and the fill between them
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
