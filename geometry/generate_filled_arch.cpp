// filled-arch: a strip of a segmental arch bridge under a deformable fill, between smooth walls in plane strain, with a
// loading beam on the fill.
#include <fmt/format.h>

#include <algorithm>
#include <cmath>

#include "geometry/fill_gmsh.h"
#include "geometry/fill_joints.h"
#include "geometry/fill_mesh.h"
#include "geometry/generate.h"
#include "geometry/masonry.h"
#include "geometry/stiffness.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

enum Matter : std::int32_t { masonry, backfill, wall };  // in the order of the generator's materials

/// Lengths in m; x = 0 at the left end of the fill, z = 0 at the feet of the intrados, y = 0 in the middle of the
/// strip.
struct Strip {
  Ring ring;
  double length = 0.0, half = 0.0;  // of the fill, along x; half the width of the strip
  double floor = 0.0, deck = 0.0;   // z, of the fill's lowest and highest face
  double approach = 0.0;            // of the fill beyond a foot of the intrados
  double load_x = 0.0;              // middle of the beam
  double load_length = 0.0;         // of the beam along x
  double edge = 0.0, depth = 0.0;   // of the tetrahedra; of fill that the interface is as stiff as
  double interface_friction = 0.0;  // rad
};

/// Equal wedges between radial joints, from left to right; both halves mirror one another.
Ring make_segment(double middle, double span, double rise, double thickness, int wedges) {
  const double radius = (0.25 * span * span + rise * rise) / (2.0 * rise), half_angle = std::asin(0.5 * span / radius);
  Ring ring;
  const auto point = [&](double r, double angle, bool left) {
    return Vec3(middle + (left ? -1.0 : 1.0) * r * std::sin(angle), 0.0, rise - radius + r * std::cos(angle));
  };
  for (int i = 0; i <= wedges; ++i) {
    const int j = std::min(i, wedges - i);
    const double angle = half_angle * double(wedges - 2 * j) / wedges;
    ring.intrados.push_back(point(radius, angle, i == j));
    ring.extrados.push_back(point(radius + thickness, angle, i == j));
  }
  // The floor of the fill is level with the feet of the extrados; the ring cuts the fill above it.
  return ring;
}

Strip read_strip(const GeneratorInput& in) {
  const double span = in("clear_span"), rise = in("rise"), t = in("ring_thickness");
  if (rise > 0.45 * span)
    throw InputError(
        "[bridge] rise = {:g} m is too large for clear_span = {:g} m. It must be at most {:g} m for a segment.", rise,
        span, 0.45 * span);
  Strip s;
  s.approach = in("approach");
  s.length = span + 2.0 * s.approach;
  s.half = 0.5 * in("width");
  s.ring = make_segment(0.5 * s.length, span, rise, t, int(in("voussoirs")));
  s.floor = s.ring.extrados.front().z();
  s.deck = rise + t + in("fill_over_crown");
  s.load_x = s.approach + in("load_at") * span;
  s.load_length = in("load_length");
  s.edge = in("fill_edge");
  s.depth = in("interface_depth");
  s.interface_friction = radians(in("interface_friction"));
  const double foot = s.ring.extrados.front().x();
  if (foot < 0.1 * s.approach)
    throw InputError(
        "[bridge] approach = {:g} m is too small for the fill beyond the ring. It must be at least {:.2g} m.",
        s.approach, (s.approach - foot) / 0.9);
  return s;
}

std::int64_t lay_fixed(Layout& layout, Polyhedron shape, Component component, Matter material) {
  const auto number = std::int64_t(layout.stones.size());
  lay_stone(layout, {std::move(shape)}, {component, 0, material, Vec3::Ones()}, Vec3::Ones(), false);
  return number;
}

/// The fixed block below one springing joint and the fill beyond it. It is convex, because the joint rises outwards.
void lay_springing(Layout& layout, const Strip& s, bool left) {
  constexpr double depth = 0.5;
  const Vec3 in = s.ring.intrados.front(), out = s.ring.extrados.front();
  Polygon outline = {{0.0, 0.0, -depth}, {in.x(), 0.0, -depth}, in, out, {0.0, 0.0, s.floor}};
  for (Vec3& p : outline) {
    if (!left) p.x() = s.length - p.x();
    p.y() = -s.half;
  }
  if (!left) std::reverse(outline.begin(), outline.end());
  layout.groups[left ? "springing left" : "springing right"] = {
      lay_fixed(layout, make_prism(outline, {0.0, 2.0 * s.half, 0.0}), Component::base, masonry)};
}

/// Lays fixed smooth walls at both faces and both ends, from the floor of the fill to the deck. They have a separate
/// component, so that pictures can leave them out.
void lay_walls(Layout& layout, const Strip& s) {
  constexpr double thickness = 0.3;
  const double y = s.half;
  auto& walls = layout.groups["walls"];
  const auto lay = [&](const Vec3& low, const Vec3& high) {
    walls.push_back(lay_fixed(layout, make_box(low, high), Component::restraint, wall));
  };
  lay({0.0, -y - thickness, s.floor}, {s.length, -y, s.deck});
  lay({0.0, y, s.floor}, {s.length, y + thickness, s.deck});
  lay({-thickness, -y, s.floor}, {0.0, y, s.deck});
  lay({s.length, -y, s.floor}, {s.length + thickness, y, s.deck});
}

void lay_load(Layout& layout, const Strip& s) {
  constexpr double height = 0.3;
  const double a = 0.5 * s.load_length;
  layout.groups["load"] = {lay_fixed(layout,
                                     make_box({s.load_x - a, -s.half, s.deck}, {s.load_x + a, s.half, s.deck + height}),
                                     Component::base, masonry)};
}

/// Area of the section of the fill, m2: the whole area without that between the extrados and the floor.
double section_area(const Strip& s) {
  return s.length * (s.deck - s.floor) - polygon_area(s.ring.extrados);
}

void add_fill(Assembly& assembly, const Strip& s, const Material& soil, const GeneratorInput& in) {
  FillSpace space;
  space.boxes = {{{0.0, -s.half, s.floor}, {s.length, s.half, s.deck}}};
  space.rings = {s.ring};
  FillMeshing meshing;
  meshing.edge = s.edge;
  assembly.fill = mesh_fill(space, meshing);
  assembly.fill.material.assign(assembly.fill.tets.size(), backfill);
  check_fill(assembly.fill, "the mesh of the fill");
  check_volume(assembly.fill, 2.0 * s.half * section_area(s));
  JointSearch search;
  search.gap = in.gap_tolerance;
  find_fill_joints(assembly, search);
  JointRules rules;
  rules.kind = JointRules::Kind::given;
  rules.uniform = {soil.youngs_modulus / s.depth, soil.shear_modulus / s.depth};
  rules.interface_friction = s.interface_friction;
  assign_fill_stiffness(assembly, rules, in);
}

/// Neither friction nor bond on the walls, of the fill as of the ring: plane strain.
void smooth_walls(Assembly& assembly, const Strip& s, const Material& soil) {
  const std::int32_t law = law_index(assembly.laws, {});
  const auto smooth = [&](auto& joint) {
    joint.kn = soil.youngs_modulus / s.depth;
    joint.ks = soil.shear_modulus / s.depth;
    joint.law = law;
  };
  const auto is_wall = [&](std::int64_t i) { return assembly.blocks[std::size_t(i)].material == wall; };
  for (Joint& joint : assembly.joints)
    if (is_wall(joint.a) || is_wall(joint.b)) smooth(joint);
  for (FillJoint& joint : assembly.fill_joints)
    if (is_wall(joint.block)) smooth(joint);
}

Assembly build_filled_arch(const std::vector<Material>& defaults, const GeneratorInput& in) {
  const Strip s = read_strip(in);
  Layout layout;
  const Unit unit = {Component::arch, 0, masonry, {1.0, 2.0 * s.half, 1.0}};
  const auto first = lay_ring(layout, s.ring, -s.half, s.half, unit);
  const std::size_t n = first.size() - 1;
  for (std::size_t i = 0; i < n; ++i) {
    layout.groups[fmt::format("voussoir {}", i)] = {first[i]};
    if (i >= (n - 1) / 2 && i <= n / 2) layout.groups["keystone 0"].push_back(first[i]);
    if (const int quarter = quarter_of(s.ring.intrados, int(i)); quarter >= 0)
      layout.groups[quarter == 0 ? "quarter 0 left" : "quarter 0 right"].push_back(first[i]);
  }
  for (const bool left : {true, false}) lay_springing(layout, s, left);
  lay_walls(layout, s);
  lay_load(layout, s);

  const std::vector<Material> materials = in_order(defaults, in);
  Assembly assembly = assemble(std::move(layout), materials, {}, in.gap_tolerance);
  assign_stiffness(assembly, uniform_rules(in), in);
  add_fill(assembly, s, materials[backfill], in);
  smooth_walls(assembly, s, materials[backfill]);
  return assembly;
}

}  // namespace

Generator filled_arch_generator() {
  Generator generator;
  generator.name = "filled-arch";
  generator.help =
      "Strip of a segmental arch bridge with a deformable fill, in plane strain: fixed springings and floor, smooth "
      "walls at both faces and ends, and a fixed loading beam on the fill (group load)";
  // Defaults: Prestwood bridge, as a segment (Page 1987, TRRL Research Report 110).
  generator.parameters = {
      {"clear_span", 6.55, 0.1, 100.0, "m", "clear span between the feet of the intrados"},
      {"rise", 1.428, 0.02, 45.0, "m", "rise of the intrados; at most 0.45 x clear_span"},
      {"ring_thickness", 0.22, 0.01, 5.0, "m", "thickness of the ring"},
      {"voussoirs", 30.0, 2.0, 400.0, "-", "number of voussoirs between the springings, of equal angle", true},
      {"fill_over_crown", 0.165, 0.02, 20.0, "m", "depth of fill from the crown of the extrados to the deck"},
      {"approach", 3.5, 0.1, 100.0, "m", "length of the fill at either end, beyond the foot of the intrados"},
      {"width", 0.2, 0.01, 100.0, "m", "width of the strip (y)"},
      {"load_at", 0.25, 0.0, 1.0, "-",
       "position of the middle of the beam: distance from the left springing over the clear span"},
      {"load_length", 0.3, 0.01, 20.0, "m", "length of the beam along the bridge"},
      {"fill_edge", 0.2, 0.02, 5.0, "m", "longest edge of the tetrahedra of the fill"},
      {"interface_depth", 0.1, 0.001, 10.0, "m",
       "depth d of fill that has the stiffness of an interface: kn = E / d, ks = G / d"},
      {"interface_friction", 37.0, 0.0, 80.0, "deg",
       "ring to fill: friction angle; no cohesion and no tensile strength"},
      {"kn", 0.0, 0.0, 1e18, "Pa/m", "normal stiffness of the ring's joints; 0: E/dc"},
      {"ks", 0.0, 0.0, 1e18, "Pa/m", "shear stiffness of the ring's joints; 0: G/dc"}};
  const double friction = radians(37.0);
  generator.materials = {{"masonry", 2039.0, 4.5e9, 1.8e9, 0.0, 0.0, radians(31.0)},
                         {"backfill", 2039.0, 50e6, 19.2e6, 0.0, 7e3, friction},
                         {"wall", 2000.0, 50e6, 19.2e6, 0.0, 0.0, 0.0}};
  generator.build = [materials = generator.materials](const GeneratorInput& in) {
    return build_filled_arch(materials, in);
  };
  return generator;
}

}  // namespace voussoir
