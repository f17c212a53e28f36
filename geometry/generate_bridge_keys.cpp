// Names, defaults and ranges of the keys of the generator "bridge".
#include "geometry/generate_bridge.h"

namespace voussoir {

std::vector<Parameter> any_bridge_keys() {
  return {
      {"width", 8.0, 1.0, 40.0, "m", "width between the outer faces of the spandrel walls"},
      {"skew", 0.0, -45.0, 45.0, "deg",
       "skew angle of the supports; lengths along the bridge are measured square to the supports"},
      {"gradient", 0.0, -12.0, 12.0, "%", "gradient of the deck along the bridge, rising from left to right"},
      {"fill_over_crown", 0.5, 0.0, 20.0, "m", "depth of fill from the extrados to the deck, where it is least"},
      {"surfacing_depth", 0.0, 0.0, 5.0, "m",
       "depth of the topmost part of the fill, of the material `surfacing`; 0: none"},
      {"deck_height", 0.0, 0.0, 60.0, "m",
       "height of a level deck above the lowest springing; 0: from fill_over_crown"},
      {"backing_height", 1.0, 0.0, 60.0, "m", "height of the top of the backing above the lowest springing"},
      {"backing_over_abutment", 0.0, 0.0, 60.0, "m",
       "length of the backing over the abutment, measured from the span; 0: the whole abutment"},
      {"spandrel_thickness_bottom", 0.6, 0.1, 10.0, "m", "thickness of the lowest course of the spandrel walls"},
      {"spandrel_thickness_top", 0.6, 0.1, 10.0, "m",
       "thickness of the topmost course; spandrel_back sets the courses between"},
      {"parapet_height", 1.0, 0.0, 5.0, "m", "height of the parapets above the deck; 0: no parapets"},
      {"parapet_thickness", 0.35, 0.05, 5.0, "m", "thickness of the parapets, which are flush with the outer faces"},
      {"string_course_height", 0.0, 0.0, 1.0, "m", "height of a string course between deck and parapets; 0: none"},
      {"string_course_projection", 0.1, 0.0, 1.0, "m", "projection of the string course beyond the outer faces"},
      {"transverse_walls", 0.0, 0.0, 5.0, "m", "thickness of transverse walls over the piers, up to the deck; 0: none"},
      {"base_depth", 1.0, 0.1, 20.0, "m", "depth of the fixed block under each support"},
      {"restraint_depth", 1.0, 0.1, 20.0, "m", "length of the fixed block at each end, if restrained"},
      {"wing_wall_thickness", 0.0, 0.0, 10.0, "m",
       "thickness of the wing walls behind the built_length of an abutment; 0: spandrel_thickness_bottom"},
      {"leaf_thickness_even", 0.3, 0.05, 5.0, "m", "leaf: thickness of the leaf in courses 0, 2, … from the base"},
      {"leaf_thickness_odd", 0.5, 0.05, 5.0, "m", "leaf: thickness of the leaf in courses 1, 3, …"},
      {"strip_width", 0.3, 0.05, 5.0, "m", "strip: width across the bridge"},
      {"block_scale", 1.0, 0.25, 6.0, "-",
       "factor on all block sizes; the stiffnesses kn_ and ks_ of the table are divided by it"},
      {"voussoir_length", 0.4, 0.03, 10.0, "m", "largest length of a voussoir along the intrados"},
      {"voussoir_width", 0.6, 0.05, 10.0, "m", "width of a voussoir across the bridge"},
      {"block_length", 0.8, 0.05, 10.0, "m", "masonry in courses: block length along the bridge"},
      {"block_width", 0.6, 0.05, 10.0, "m", "masonry in courses: block width across the bridge"},
      {"block_height", 0.4, 0.05, 10.0, "m", "masonry in courses: course height"},
      {"leaf_course_height", 0.8, 0.05, 10.0, "m",
       "leaf: course height; the infill has two courses in one course of the leaf"},
      {"leaf_length", 0.7, 0.05, 10.0, "m", "leaf: block length along the face"},
      {"infill_length", 0.7, 0.05, 10.0, "m", "infill: block length along the bridge"},
      {"infill_width", 0.7, 0.05, 10.0, "m", "infill: block width across the bridge"},
      {"fill_length", 0.8, 0.05, 10.0, "m", "rigid backfill: block length along the bridge"},
      {"fill_width", 0.8, 0.05, 10.0, "m", "rigid backfill: block width across the bridge"},
      {"fill_height", 0.4, 0.05, 10.0, "m", "rigid backfill: course height"},
      {"fill_edge", 0.5, 0.05, 5.0, "m",
       "deformable backfill: longest edge of its tetrahedra; block_scale does not change it"},
      {"sliver_thickness", 0.15, 0.0, 1.0, "m",
       "thickness, times block_scale, below which a cut block is merged with its neighbour"},
      {"sliver_share", 0.25, 0.0, 0.9, "-",
       "share of its nominal volume below which a cut block is merged with its neighbour"},
      {"kn_vault", 0.0, 0.0, 1e15, "Pa/m", "table: normal stiffness between voussoirs; 0: from the moduli"},
      {"ks_vault", 0.0, 0.0, 1e15, "Pa/m", "table: shear stiffness between voussoirs; 0: from the moduli"},
      {"kn_wall", 0.0, 0.0, 1e15, "Pa/m",
       "table: normal stiffness in backing, spandrel walls and parapets; 0: from the moduli"},
      {"ks_wall", 0.0, 0.0, 1e15, "Pa/m",
       "table: shear stiffness in backing, spandrel walls and parapets; 0: from the moduli"},
      {"kn_support", 0.0, 0.0, 1e15, "Pa/m", "table: normal stiffness in piers and abutments; 0: from the moduli"},
      {"ks_support", 0.0, 0.0, 1e15, "Pa/m", "table: shear stiffness in piers and abutments; 0: from the moduli"},
      {"kn_infill", 0.0, 0.0, 1e15, "Pa/m",
       "table: normal stiffness in the infill of piers and abutments; 0: from the moduli"},
      {"ks_infill", 0.0, 0.0, 1e15, "Pa/m",
       "table: shear stiffness in the infill of piers and abutments; 0: from the moduli"},
      {"interface_share", 0.2, 1e-6, 10.0, "-", "masonry to backfill: stiffness as a share of that of the masonry"},
      {"interface_friction", 35.0, 0.0, 80.0, "deg",
       "masonry to backfill: friction angle; no cohesion and no tensile strength"},
      {"restraint_share", 0.5, 1e-6, 10.0, "-",
       "restrained ends: stiffness as a share of that of the adjacent material"}};
}

std::vector<Choice> any_bridge_choices() {
  return {{"abutments", {"free", "restrained"}, "restrained: a fixed block over the whole end face at each end"},
          {"backfill",
           {"rigid", "deformable", "none"},
           "rigid: blocks; deformable: one continuum of tetrahedra; none: no backfill"},
          {"spandrel_back",
           {"stepped", "tapered"},
           "inner faces of the spandrel walls: stepped from course to course, or one plane from springing to deck"},
          {"skew_bond",
           {"parallel", "helicoidal", "logarithmic"},
           "bed joints of the vaults of a skew bridge: parallel to the supports (false skew); helicoidal: square to "
           "the chord of the faces (English); logarithmic: square to the faces everywhere (French)"},
          {"extent",
           {"whole", "strip"},
           "strip: a strip of the bridge in plane strain between fixed smooth walls, without spandrel walls, internal "
           "walls and parapets"},
          {"stiffness",
           {"moduli", "table"},
           "joint stiffness from E/dc and G/dc, or from the table kn_, ks_ of each component"},
          {"ring_bond",
           {"mortar", "none"},
           "joints between the rings of a vault: as strong as the other joints of the vault, or with friction only"},
          {"fill_bond", {"stack", "running"}, "rigid backfill: joints above joints (stack), or running bond"}};
}

namespace {

Choice material_key(const char* usual, const char* help) {
  return {"material",
          {usual},
          std::string(help) + "; a material that only this case has needs a table [materials.NAME]",
          true};
}

KeyTable span_keys() {
  KeyTable t;
  t.name = "span", t.help = "the vaults from left to right; `repeat = 3` stands for three equal vaults";
  t.least = 1, t.most = most_spans;
  t.choices = {{"shape", vault_shapes(), "shape of the intrados"},
               material_key("vault", "material of the stones of the vault")};
  t.parameters = {
      {"clear_span", 8.0, 0.3, 100.0, "m",
       "clear span between the springings; for a surveyed vault it follows from intrados"},
      {"rise", 0.0, 0.0, 60.0, "m",
       "rise of the crown; 0: 0.5 of the span (semicircular), 0.6 (pointed) or 0.25 (other shapes)"},
      {"ring_thickness", 0.5, 0.03, 5.0, "m", "thickness at the crown, of all rings together"},
      {"springing_thickness", 0.0, 0.0, 5.0, "m",
       "thickness at the springings, of all rings together; 0: as at the crown"},
      {"rings", 1.0, 1.0, 8.0, "-", "number of rings, of equal thickness, joint over joint", true},
      {"headers_every", 0.0, 0.0, 100.0, "-",
       "number of courses from one course of headers (stones through two rings) to the next; 0: no headers", true},
      {"voussoirs", 0.0, 0.0, 400.0, "-", "number of voussoirs of each ring; 0: an even number from voussoir_length",
       true},
      {"springing_left", 0.0, -20.0, 20.0, "m", "height of the left springing above the common springing level"},
      {"springing_right", 0.0, -20.0, 20.0, "m", "height of the right springing above the common springing level"}};
  t.profiles = {{"intrados", "surveyed: points of the intrados from springing to springing; x and z from any origin"},
                {"ring_thicknesses",
                 "thicknesses of every ring, the lowest first; replaces rings, ring_thickness and springing_thickness",
                 "[crown, springing]",
                 false,
                 {"rings", "ring_thickness", "springing_thickness"}}};
  return t;
}

std::vector<Choice> makeup() {
  return {{"makeup",
           {"solid", "leaf", "hollow"},
           "solid: solid courses; leaf: an outer leaf around infill; hollow: an outer leaf around a void"}};
}

KeyTable pier_keys() {
  KeyTable t;
  t.name = "pier", t.help = "the piers from left to right; a single entry applies to all piers";
  t.least = 1, t.most = most_spans;
  t.choices = makeup();
  t.choices.push_back(material_key("masonry", "material of the stones of the pier and its cutwaters"));
  t.choices.push_back({"cutwater", {"none", "triangular", "round"}, "cutwaters on both side faces"});
  t.parameters = {
      {"height", 5.0, 0.1, 100.0, "m", "height from the base to the common springing level"},
      {"thickness", 1.5, 0.1, 20.0, "m", "thickness along the bridge, at the springing"},
      {"batter_x", 0.0, 0.0, 0.3, "-", "slope of the faces along the bridge, widening downwards"},
      {"batter_y", 0.0, 0.0, 0.3, "-", "slope of the side faces"},
      {"width", 0.0, 0.0, 60.0, "m", "width across the bridge, at the springing; 0: as the bridge"},
      {"cutwater_length", 0.0, 0.0, 20.0, "m", "length of the cutwaters beyond the side face; 0: half the thickness"},
      {"cutwater_height", 0.0, 0.0, 100.0, "m", "height of the cutwaters above the base; 0: up to the springing"}};
  return t;
}

KeyTable backing_keys() {
  KeyTable t;
  t.name = "backing", t.help = "a backing whose top is not level; it replaces backing_height";
  t.profiles = {
      {"profile", "top of the backing; x from the left end, square to the supports, z above the lowest springing"}};
  return t;
}

KeyTable internal_keys() {
  KeyTable t;
  t.name = "internal", t.help = "walls along the bridge between the spandrel walls, on the vaults and the backing";
  t.choices = {{"between",
                {"fill", "void"},
                "fill: walls up to the deck with fill between them; void: walls up to slabs with voids below"}};
  t.parameters = {{"walls", 0.0, 0.0, 12.0, "-", "number of walls, equally spaced; 0: none", true},
                  {"thickness", 0.4, 0.1, 5.0, "m", "thickness of each wall"},
                  {"slab_thickness", 0.2, 0.05, 2.0, "m", "void: thickness of the slabs from wall to wall"},
                  {"fill_over_slabs", 0.3, 0.0, 10.0, "m",
                   "void: depth of fill from the slabs to the deck, where the deck is lowest"}};
  return t;
}

KeyTable beam_keys() {
  KeyTable t;
  t.name = "beam",
  t.help =
      "a fixed loading beam on the fill from wall to wall (group `load`), which a stage drives down as in a load test";
  t.parameters = {{"length", 0.0, 0.0, 10.0, "m", "length along the bridge, square to the supports; 0: no beam"},
                  {"height", 0.3, 0.05, 5.0, "m", "height of the beam"},
                  {"span", 1.0, 1.0, double(most_spans), "-",
                   "number of the span below the beam, counted from 1 at the left", true},
                  {"at", 0.25, 0.0, 1.0, "-",
                   "position of the middle of the beam: distance from the left springing over the clear span"}};
  return t;
}

KeyTable abutment_keys(const std::string& side) {
  KeyTable t;
  t.name = "abutment." + side, t.help = "the " + side + " abutment";
  t.choices = makeup();
  t.choices.push_back(
      material_key("masonry", "material of the stones of the abutment, its wing walls and its counterforts"));
  t.parameters = {
      {"length", 4.0, 0.3, 60.0, "m", "length from the end of the bridge to the springing"},
      {"height", 4.0, 0.1, 100.0, "m", "height from the base to the common springing level"},
      {"batter_y", 0.0, 0.0, 0.3, "-", "slope of the side faces"},
      {"width", 0.0, 0.0, 60.0, "m", "width across the bridge, at the springing; 0: as the bridge"},
      {"built_length", 0.0, 0.0, 60.0, "m",
       "leaf: length of the part next to the span; the rest has wing walls with fill between them; 0: the whole "
       "length"},
      {"wing_length", 0.0, 0.0, 60.0, "m", "length of the wing walls beyond the end, along the bridge; 0: none"},
      {"wing_thickness", 0.6, 0.1, 10.0, "m", "thickness of the wing walls across the bridge"},
      {"wing_splay", 0.0, 0.0, 60.0, "deg",
       "angle by which the wing walls turn outwards from the axis of the bridge; 0: parallel to it"},
      {"wing_height", 0.0, 0.0, 100.0, "m", "height of the wing walls above the base; 0: up to the deck at the end"},
      {"counterforts", 0.0, 0.0, 20.0, "-", "number of counterforts (buttresses) against the end face", true},
      {"counterfort_length", 1.0, 0.1, 20.0, "m", "length of the counterforts along the bridge"},
      {"counterfort_thickness", 0.6, 0.1, 10.0, "m", "thickness of the counterforts across the bridge"},
      {"counterfort_height", 0.0, 0.0, 100.0, "m",
       "height of the counterforts above the base; 0: up to the springing"}};
  return t;
}

}  // namespace

std::vector<KeyTable> any_bridge_tables() {
  return {span_keys(),     pier_keys(), abutment_keys("left"), abutment_keys("right"), backing_keys(),
          internal_keys(), beam_keys()};
}

}  // namespace voussoir
