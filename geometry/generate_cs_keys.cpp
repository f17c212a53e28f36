// Names, defaults and ranges of the bridges' keys.
#include <fmt/format.h>

#include "geometry/generate_cs.h"

namespace voussoir {

namespace {

/// One row: both defaults side by side. A * in the help marks a value that the paper of the two bridges
/// (generate_cs.cpp) does not give.
struct Row {
  const char* name;
  double cs1, cs2, low, high;
  const char* unit;
  const char* help;
};

const Row kDimensions[] = {
    {"clear_span", 10.0, 15.0, 1.0, 60.0, "m", "clear span of each semicircular vault"},
    {"width", 7.1, 7.0, 1.0, 40.0, "m", "width of the bridge at the springing and above"},
    {"pier_height", 9.5, 13.0, 0.2, 80.0, "m", "height from base to springing of the piers whose pier_i_height is 0"},
    {"abutment_height", 9.5, 7.2, 0.2, 80.0, "m", "height from base to springing (cs2 *)"},
    {"abutment_length", 4.8, 7.5, 0.5, 60.0, "m", "length from the end of the bridge to the first springing (cs1 *)"},
    {"pier_thickness", 1.6, 3.5, 0.3, 20.0, "m", "thickness along the bridge, at the springing *"},
    {"batter_x", 0.0, 0.03, 0.0, 0.3, "-", "slope of the pier faces along the bridge, widening downwards (cs2 *)"},
    {"batter_y", 0.0, 0.02, 0.0, 0.3, "-", "slope of the side faces of piers and abutments (cs2 *)"},
    {"ring_thickness", 0.70, 0.78, 0.1, 5.0, "m", "thickness of the vaults *"},
    {"fill_over_crown", 1.1, 1.2, 0.0, 10.0, "m", "depth of fill from the crown of the extrados to the deck *"},
    {"backing_height", 3.0, 8.0, 0.0, 60.0, "m", "height of the top of the backing above the springing *"},
    {"backing_over_abutment", 4.8, 7.5, 0.1, 60.0, "m",
     "length of the backing over the abutment, measured from the span *"},
    {"spandrel_thickness_bottom", 0.45, 1.5, 0.1, 10.0, "m", "thickness of the lowest course of the spandrel walls"},
    {"spandrel_thickness_top", 0.45, 1.0, 0.1, 10.0, "m",
     "thickness of the topmost course; the courses between are stepped"},
    {"parapet_height", 1.2, 0.0, 0.0, 5.0, "m", "height of the parapets above the deck; 0: no parapets"},
    {"parapet_thickness", 0.35, 0.35, 0.05, 5.0, "m",
     "thickness of the parapets, which are flush with the outer faces"},
    {"abutment_leaf_length", 4.8, 4.8, 0.3, 60.0, "m",
     "leaf: length of the part of the abutment next to the span, which has infill; the rest has wing walls *"},
    {"wing_wall_thickness", 0.45, 0.45, 0.1, 10.0, "m",
     "leaf: thickness of the wing walls, with backfill between them *"},
    {"leaf_thickness_even", 0.20, 0.20, 0.05, 5.0, "m", "leaf: thickness of the leaf in courses 0, 2, … from the base"},
    {"leaf_thickness_odd", 0.60, 0.60, 0.05, 5.0, "m", "leaf: thickness of the leaf in courses 1, 3, …"},
    {"base_depth", 1.0, 1.0, 0.1, 20.0, "m", "depth of the fixed block under each support"},
    {"restraint_depth", 1.0, 1.0, 0.1, 20.0, "m", "length of the fixed block at each end, if restrained"},
};

const Row kBlocks[] = {
    {"block_scale", 1.0, 1.0, 0.25, 6.0, "-",
     "factor on all block sizes; the stiffnesses kn_ and ks_ of the table are divided by it"},
    {"voussoir_length", 0.45, 0.60, 0.05, 10.0, "m", "largest length of a voussoir along the middle of the ring"},
    {"voussoir_width", 0.50, 0.60, 0.05, 10.0, "m", "width of a voussoir across the bridge"},
    {"block_length", 0.75, 1.56, 0.05, 10.0, "m",
     "masonry in courses (walls, backing, solid piers): block length along the bridge"},
    {"block_width", 0.70, 1.20, 0.05, 10.0, "m", "masonry in courses: block width across the bridge"},
    {"block_height", 0.45, 1.00, 0.05, 10.0, "m", "masonry in courses: course height"},
    {"leaf_course_height", 0.80, 0.80, 0.05, 10.0, "m",
     "leaf: course height; the infill has two courses in one course of the leaf"},
    {"leaf_length", 0.70, 0.70, 0.05, 10.0, "m", "leaf: block length along the face"},
    {"infill_length", 0.75, 0.75, 0.05, 10.0, "m", "infill: block length along the bridge"},
    {"infill_width", 0.70, 0.70, 0.05, 10.0, "m", "infill: block width across the bridge"},
    {"fill_length", 0.70, 1.56, 0.05, 10.0, "m", "rigid backfill: block length along the bridge"},
    {"fill_width", 0.45, 1.20, 0.05, 10.0, "m", "rigid backfill: block width across the bridge"},
    {"fill_height", 0.40, 1.00, 0.05, 10.0, "m", "rigid backfill: course height"},
    {"fill_edge", 0.5, 0.5, 0.05, 5.0, "m",
     "deformable backfill: longest edge of its tetrahedra; block_scale does not change it"},
    {"sliver_thickness", 0.15, 0.15, 0.0, 1.0, "m",
     "thickness, times block_scale, below which a cut block is merged with its neighbour"},
    {"sliver_share", 0.25, 0.25, 0.0, 0.9, "-",
     "share of its nominal volume below which a cut block is merged with its neighbour"},
};

const Row kJoints[] = {
    {"kn_vault", 8890e6, 2740e6, 1.0, 1e15, "Pa/m", "table: normal stiffness between voussoirs"},
    {"ks_vault", 3560e6, 876e6, 1.0, 1e15, "Pa/m", "table: shear stiffness between voussoirs"},
    {"kn_wall", 5520e6, 1150e6, 1.0, 1e15, "Pa/m", "table: normal stiffness in backing, spandrel walls and parapets"},
    {"ks_wall", 2210e6, 368e6, 1.0, 1e15, "Pa/m", "table: shear stiffness in backing, spandrel walls and parapets"},
    {"kn_support", 5310e6, 1150e6, 1.0, 1e15, "Pa/m", "table: normal stiffness in piers and abutments"},
    {"ks_support", 2120e6, 368e6, 1.0, 1e15, "Pa/m", "table: shear stiffness in piers and abutments"},
    {"kn_infill", 1330e6, 1150e6, 1.0, 1e15, "Pa/m", "table: normal stiffness in the infill of piers and abutments"},
    {"ks_infill", 531e6, 368e6, 1.0, 1e15, "Pa/m", "table: shear stiffness in the infill of piers and abutments"},
    {"interface_share", 0.20, 0.20, 1e-6, 10.0, "-",
     "masonry to backfill: stiffness as a share of the masonry's value in the table"},
    {"interface_friction", 35.0, 35.0, 0.0, 80.0, "deg",
     "masonry to backfill: friction angle; no cohesion and no tensile strength"},
    {"restraint_share", 0.50, 0.50, 1e-6, 10.0, "-",
     "restrained ends: stiffness as a share of that of the adjacent material"},
};

}  // namespace

std::vector<Parameter> bridge_parameters(bool cs1) {
  std::vector<Parameter> parameters = {
      {"spans", cs1 ? 4.0 : 3.0, 1.0, 8.0, "-", "number of vaults", true},
      {"voussoirs", 0.0, 0.0, 400.0, "-", "number of voussoirs of a vault; 0: an even number from voussoir_length",
       true}};
  const auto add = [&](const Row& row) {
    parameters.push_back({row.name, cs1 ? row.cs1 : row.cs2, row.low, row.high, row.unit, row.help});
  };
  for (const Row& row : kDimensions) add(row);
  for (int i = 0; i < 7; ++i) {
    const double own = !cs1 && i == 1 ? 11.3 : 0.0;
    parameters.push_back(
        {fmt::format("pier_{}_height", i), own, 0.0, 80.0, "m",
         fmt::format("height from base to springing of pier {} (from 0 at the left); 0: pier_height", i)});
  }
  for (int i = 0; i < 8; ++i)
    parameters.push_back(
        {fmt::format("span_{}_clear", i), 0.0, 0.0, 60.0, "m",
         fmt::format("clear span of vault {} (from 0 at the left), under the same deck; 0: clear_span", i)});
  for (const Row& row : kBlocks) add(row);
  for (const Row& row : kJoints) add(row);
  return parameters;
}

}  // namespace voussoir
