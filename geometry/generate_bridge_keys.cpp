// Names, defaults and ranges of the keys of the generator "bridge".
#include "geometry/generate_bridge.h"

namespace voussoir {

std::vector<Parameter> any_bridge_keys() {
  return {
      {"width", 8.0, 1.0, 40.0, "m", "from face to face of the spandrel walls"},
      {"skew", 0.0, -45.0, 45.0, "deg",
       "of the supports against the square to the bridge; lengths along it are measured square to them"},
      {"gradient", 0.0, -12.0, 12.0, "%", "rise of the deck over the way along the bridge, from left to right"},
      {"fill_over_crown", 0.5, 0.0, 20.0, "m", "from the extrados to the deck, where it is least"},
      {"surfacing_depth", 0.0, 0.0, 5.0, "m", "topmost part of the fill, of the material `surfacing`; 0: none"},
      {"deck_height", 0.0, 0.0, 60.0, "m", "of a level deck above the lowest springing; 0: from fill_over_crown"},
      {"backing_height", 1.0, 0.0, 60.0, "m", "top of the backing above the lowest springing"},
      {"backing_over_abutment", 0.0, 0.0, 60.0, "m", "length of the backing from the span on; 0: all of the abutment"},
      {"spandrel_thickness_bottom", 0.6, 0.1, 10.0, "m", "lowest course of the spandrel walls"},
      {"spandrel_thickness_top", 0.6, 0.1, 10.0, "m", "topmost course; in between as spandrel_back says"},
      {"parapet_height", 1.0, 0.0, 5.0, "m", "above the deck; 0: no parapets"},
      {"parapet_thickness", 0.35, 0.05, 5.0, "m", "flush with the outer faces"},
      {"string_course_height", 0.0, 0.0, 1.0, "m", "of a course between deck and parapets; 0: none"},
      {"string_course_projection", 0.1, 0.0, 1.0, "m", "how far it stands out of the outer faces"},
      {"transverse_walls", 0.0, 0.0, 5.0, "m", "thickness of walls across over the piers, to the deck; 0: none"},
      {"base_depth", 1.0, 0.1, 20.0, "m", "depth of the fixed block under each support"},
      {"restraint_depth", 1.0, 0.1, 20.0, "m", "length of the fixed block at each end, if restrained"},
      {"wing_wall_thickness", 0.0, 0.0, 10.0, "m",
       "of walls behind the built part of an abutment; 0: spandrel_thickness_bottom"},
      {"leaf_thickness_even", 0.3, 0.05, 5.0, "m", "leaf: thickness in courses 0, 2, … from the base"},
      {"leaf_thickness_odd", 0.5, 0.05, 5.0, "m", "leaf: thickness in courses 1, 3, …"},
      {"strip_width", 0.3, 0.05, 5.0, "m", "across, of extent = strip"},
      {"block_scale", 1.0, 0.25, 6.0, "-", "factor on all block sizes"},
      {"voussoir_length", 0.4, 0.03, 10.0, "m", "voussoirs along the intrados, at most"},
      {"voussoir_width", 0.6, 0.05, 10.0, "m", "voussoirs across"},
      {"block_length", 0.8, 0.05, 10.0, "m", "masonry in courses: along the bridge"},
      {"block_width", 0.6, 0.05, 10.0, "m", "the same, across"},
      {"block_height", 0.4, 0.05, 10.0, "m", "the same, course height"},
      {"leaf_course_height", 0.8, 0.05, 10.0, "m", "leaf: course height; the infill has two courses in one"},
      {"leaf_length", 0.7, 0.05, 10.0, "m", "leaf: length of its pieces along the face"},
      {"infill_length", 0.7, 0.05, 10.0, "m", "infill: along the bridge"},
      {"infill_width", 0.7, 0.05, 10.0, "m", "infill: across"},
      {"fill_length", 0.8, 0.05, 10.0, "m", "rigid backfill: along the bridge"},
      {"fill_width", 0.8, 0.05, 10.0, "m", "rigid backfill: across"},
      {"fill_height", 0.4, 0.05, 10.0, "m", "rigid backfill: course height"},
      {"fill_edge", 0.5, 0.05, 5.0, "m", "deformable backfill: longest edge of its tetrahedra, at any block_scale"},
      {"sliver_thickness", 0.15, 0.0, 1.0, "m", "a thinner cut block (times block_scale) joins its neighbour"},
      {"sliver_share", 0.25, 0.0, 0.9, "-", "and so does one of a smaller share of its nominal volume"},
      {"kn_vault", 0.0, 0.0, 1e15, "Pa/m", "table: normal stiffness, voussoir to voussoir; 0: from the moduli"},
      {"ks_vault", 0.0, 0.0, 1e15, "Pa/m", "table: shear"},
      {"kn_wall", 0.0, 0.0, 1e15, "Pa/m", "table: backing, spandrels, parapets"},
      {"ks_wall", 0.0, 0.0, 1e15, "Pa/m", "table: shear"},
      {"kn_support", 0.0, 0.0, 1e15, "Pa/m", "table: piers and abutments"},
      {"ks_support", 0.0, 0.0, 1e15, "Pa/m", "table: shear"},
      {"kn_infill", 0.0, 0.0, 1e15, "Pa/m", "table: infill of piers and abutments"},
      {"ks_infill", 0.0, 0.0, 1e15, "Pa/m", "table: shear"},
      {"interface_share", 0.2, 1e-6, 10.0, "-", "masonry to backfill: share of the masonry's stiffness"},
      {"interface_friction", 35.0, 0.0, 80.0, "deg", "masonry to backfill: friction, without cohesion or tension"},
      {"restraint_share", 0.5, 1e-6, 10.0, "-", "restrained ends: share of the adjacent material's stiffness"}};
}

std::vector<Choice> any_bridge_choices() {
  return {
      {"abutments", {"free", "restrained"}, "restrained: a fixed block over the whole end face at each end"},
      {"backfill", {"rigid", "deformable", "none"}, "blocks, one continuum of tetrahedra, or left out"},
      {"spandrel_back",
       {"stepped", "tapered"},
       "inner faces of the spandrel walls: stepped from course to course, or one plane from springing to deck"},
      {"skew_bond",
       {"parallel", "helicoidal", "logarithmic"},
       "beds of the vaults of a skew bridge: parallel to the supports (false skew), or square to the faces at their "
       "chord (English) or everywhere (French)"},
      {"extent",
       {"whole", "strip"},
       "strip: strip_width of it in plane strain, without walls along the faces and parapets, between fixed smooth "
       "walls"},
      {"stiffness", {"moduli", "table"}, "joints from E/dc and G/dc, or from the table kn_, ks_ per component"},
      {"ring_bond",
       {"mortar", "none"},
       "joints between the rings of a vault: as strong as the vault's, or with friction only"},
      {"fill_bond", {"stack", "running"}, "rigid backfill: joints above joints, or running bond"}};
}

namespace {

Choice material_key(const char* usual, const char* help) {
  return {"material", {usual}, std::string(help) + "; one that only this case has needs its [materials.NAME]", true};
}

KeyTable span_keys() {
  KeyTable t;
  t.name = "span", t.help = "the vaults from left to right; `repeat` = 3 stands for three alike";
  t.least = 1, t.most = most_spans;
  t.choices = {{"shape", vault_shapes(), "of the intrados"}, material_key("vault", "of the vault's stones")};
  t.parameters = {
      {"clear_span", 8.0, 0.3, 100.0, "m", "between the springings; of a surveyed vault its intrados says it"},
      {"rise", 0.0, 0.0, 60.0, "m",
       "of the crown; 0: half the span, of a pointed vault 0.6, of other shapes a quarter"},
      {"ring_thickness", 0.5, 0.03, 5.0, "m", "at the crown, of all rings together"},
      {"springing_thickness", 0.0, 0.0, 5.0, "m", "at the springings, likewise; 0: as at the crown"},
      {"rings", 1.0, 1.0, 8.0, "-", "rings of equal thickness, joint over joint", true},
      {"headers_every", 0.0, 0.0, 100.0, "-",
       "courses from one of headers, stones through two rings, to the next; 0: none", true},
      {"voussoirs", 0.0, 0.0, 400.0, "-", "of each ring; 0: an even number from voussoir_length", true},
      {"springing_left", 0.0, -20.0, 20.0, "m", "above the level that the heights of piers and abutments reach to"},
      {"springing_right", 0.0, -20.0, 20.0, "m", "likewise"}};
  t.profiles = {{"intrados", "surveyed, from springing to springing, x and z from any origin"},
                {"ring_thicknesses",
                 "of every ring, the lowest first, instead of rings, ring_thickness and springing_thickness",
                 "[crown, springing]",
                 false,
                 {"rings", "ring_thickness", "springing_thickness"}}};
  return t;
}

std::vector<Choice> makeup() {
  return {{"makeup", {"solid", "leaf", "hollow"}, "solid courses, or an outer leaf around infill or around nothing"}};
}

KeyTable pier_keys() {
  KeyTable t;
  t.name = "pier", t.help = "the piers from left to right; one entry holds for all";
  t.least = 1, t.most = most_spans;
  t.choices = makeup();
  t.choices.push_back(material_key("masonry", "of its stones, with those of cutwaters"));
  t.choices.push_back({"cutwater", {"none", "triangular", "round"}, "noses on both side faces"});
  t.parameters = {{"height", 5.0, 0.1, 100.0, "m", "from the base to the level of the springings"},
                  {"thickness", 1.5, 0.1, 20.0, "m", "along the bridge, at the springing"},
                  {"batter_x", 0.0, 0.0, 0.3, "-", "slope of its faces along the bridge, widening downwards"},
                  {"batter_y", 0.0, 0.0, 0.3, "-", "slope of its side faces"},
                  {"width", 0.0, 0.0, 60.0, "m", "across, at the springing; 0: as the bridge"},
                  {"cutwater_length", 0.0, 0.0, 20.0, "m", "out of the side face; 0: half the thickness"},
                  {"cutwater_height", 0.0, 0.0, 100.0, "m", "above the base; 0: to the springing"}};
  return t;
}

KeyTable backing_keys() {
  KeyTable t;
  t.name = "backing", t.help = "a backing whose top is not level, instead of backing_height";
  t.profiles = {{"profile", "its top; x from the left end, square to the supports, z above the lowest springing"}};
  return t;
}

KeyTable internal_keys() {
  KeyTable t;
  t.name = "internal", t.help = "walls along the bridge between the spandrel walls, on the vaults and the backing";
  t.choices = {{"between", {"fill", "void"}, "walls to the deck with fill between, or to slabs with nothing below"}};
  t.parameters = {{"walls", 0.0, 0.0, 12.0, "-", "how many, equally spaced; 0: none", true},
                  {"thickness", 0.4, 0.1, 5.0, "m", ""},
                  {"slab_thickness", 0.2, 0.05, 2.0, "m", "void: of the slabs from wall to wall"},
                  {"fill_over_slabs", 0.3, 0.0, 10.0, "m", "void: from the slabs to the deck, where it is lowest"}};
  return t;
}

KeyTable beam_keys() {
  KeyTable t;
  t.name = "beam",
  t.help = "a fixed beam on the fill from wall to wall, group `load`, for a stage to drive down as in a test";
  t.parameters = {{"length", 0.0, 0.0, 10.0, "m", "along the bridge, square to the supports; 0: no beam"},
                  {"height", 0.3, 0.05, 5.0, "m", ""},
                  {"span", 1.0, 1.0, double(most_spans), "-", "over which span, counted from the left", true},
                  {"at", 0.25, 0.0, 1.0, "-", "its middle, over the clear span from the left"}};
  return t;
}

KeyTable abutment_keys(const std::string& side) {
  KeyTable t;
  t.name = "abutment." + side, t.help = "the " + side + " abutment";
  t.choices = makeup();
  t.choices.push_back(material_key("masonry", "of its stones, with those of its wing walls and counterforts"));
  t.parameters = {{"length", 4.0, 0.3, 60.0, "m", "from the end of the bridge to the springing"},
                  {"height", 4.0, 0.1, 100.0, "m", "from the base to the level of the springings"},
                  {"batter_y", 0.0, 0.0, 0.3, "-", "slope of its side faces"},
                  {"width", 0.0, 0.0, 60.0, "m", "across, at the springing; 0: as the bridge"},
                  {"built_length", 0.0, 0.0, 60.0, "m",
                   "leaf: the part beside the span; the rest has wing walls with fill between; 0: all"},
                  {"wing_length", 0.0, 0.0, 60.0, "m", "of walls beyond the end, along the bridge; 0: none"},
                  {"wing_thickness", 0.6, 0.1, 10.0, "m", "across the bridge"},
                  {"wing_splay", 0.0, 0.0, 60.0, "deg", "angle outwards against the bridge's axis; 0: straight on"},
                  {"wing_height", 0.0, 0.0, 100.0, "m", "above the base; 0: to the deck at the end"},
                  {"counterforts", 0.0, 0.0, 20.0, "-", "buttresses against the end face", true},
                  {"counterfort_length", 1.0, 0.1, 20.0, "m", "along the bridge"},
                  {"counterfort_thickness", 0.6, 0.1, 10.0, "m", "across"},
                  {"counterfort_height", 0.0, 0.0, 100.0, "m", "above the base; 0: to the springing"}};
  return t;
}

}  // namespace

std::vector<KeyTable> any_bridge_tables() {
  return {span_keys(),     pier_keys(), abutment_keys("left"), abutment_keys("right"), backing_keys(),
          internal_keys(), beam_keys()};
}

}  // namespace voussoir
