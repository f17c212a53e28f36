#include "geometry/masonry_build.h"

#include "geometry/fill_gmsh.h"
#include "geometry/fill_joints.h"
#include "geometry/fill_mesh.h"
#include "geometry/road.h"
#include "solver/base/constants.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

/// Battered supports must not grow into one another.
void check_feet(const Bridge& bridge) {
  for (std::size_t i = 0; i + 1 < bridge.supports.size(); ++i) {
    const Support &left = bridge.supports[i], &right = bridge.supports[i + 1];
    const double grown = left.slope_x * left.height + right.slope_x * right.height, space = right.x0 - left.x1;
    if (grown > space)
      throw InputError(
          "[bridge] the feet of {} and {} overlap by {:g} m: batter_x x height of both together must be at most the "
          "clear span, {:g} m, but is {:g} m",
          support_name(bridge, i), support_name(bridge, i + 1), grown - space, space, grown);
  }
}

/// Adds a mesh that touches none of the others.
void append(FillMesh& all, const FillMesh& more) {
  const auto first = std::int32_t(all.nodes.size());
  all.nodes.insert(all.nodes.end(), more.nodes.begin(), more.nodes.end());
  for (auto tet : more.tets) {
    for (std::int32_t& node : tet) node += first;
    all.tets.push_back(tet);
  }
  all.material.insert(all.material.end(), more.material.begin(), more.material.end());
  find_surface(all);
}

/// The deformable fill and its patches. Their rules are those of rigid blocks of the unscaled size: tetrahedra do not
/// follow the blocks.
void add_fill(Assembly& assembly, const Bridge& bridge, JointRules rules, const GeneratorInput& in) {
  const std::vector<FillRegion> regions = fill_regions(bridge);
  int last = 0;
  for (const FillRegion& region : regions) last = std::max(last, region.lane);
  for (int lane = 0; lane <= last; ++lane) {
    FillSpace space;
    for (const FillRegion& region : regions)
      if (region.lane == lane) {
        space.boxes.push_back({region.low, region.high});
        space.materials.push_back(region.surfacing ? bridge.surfacing : bridge.backfill);
      }
    space.rings = bridge.limits().rings;
    space.beside = beside_fill(bridge);
    FillMeshing meshing;
    meshing.edge = bridge.fill_edge / longest_stretch(bridge);
    append(assembly.fill, mesh_fill(space, meshing));
  }
  for (Vec3& node : assembly.fill.nodes) node.y() *= bridge.spread_at(node.z());
  if (bridge.skew != 0.0)
    for (Vec3& node : assembly.fill.nodes) node = at_skew(node, bridge.skew);
  check_fill(assembly.fill, "the mesh of the fill");
  check_volume(assembly.fill, fill_space(bridge));
  JointSearch search;
  search.gap = in.gap_tolerance;
  find_fill_joints(assembly, search);
  rules.nominal.at(Component::backfill) /= in("block_scale");
  assign_fill_stiffness(assembly, rules, in);
}

/// The blocks that bear the road, group "deck".
void name_deck(Assembly& assembly) {
  const Road road(assembly);
  for (const RoadShare::OfBlock& share : road.under(road.extent()).blocks)
    assembly.groups["deck"].push_back(share.block);
}

}  // namespace

void read_fill_and_blocks(Bridge& bridge, const GeneratorInput& in) {
  bridge.fill_bonded = in.choices.at("fill_bond") == "running";
  bridge.rigid_backfill = in.choices.at("backfill") == "rigid";
  bridge.deformable_backfill = in.choices.at("backfill") == "deformable";
  bridge.fill_edge = in("fill_edge");
  bridge.restrained = in.choices.at("abutments") == "restrained";
  const auto size = [&](const char* length, const char* width, const char* height) {
    return Vec3(in("block_scale") * Vec3(in(length), in(width), in(height)));
  };
  bridge.block = size("block_length", "block_width", "block_height");
  bridge.fill = size("fill_length", "fill_width", "fill_height");
  bridge.leaf_piece = size("leaf_length", "leaf_length", "leaf_course_height");
  bridge.infill = size("infill_length", "infill_width", "leaf_course_height");
  bridge.infill.z() *= 0.5;
}

void find_materials(Bridge& bridge, const std::vector<Material>& materials) {
  const auto index = [&](const char* name) {
    for (std::size_t i = 0; i < materials.size(); ++i)
      if (materials[i].name == name) return std::int32_t(i);
    return std::int32_t(0);
  };
  bridge.vault = index("vault"), bridge.infill_material = index("infill"), bridge.backfill = index("backfill");
  bridge.surfacing = index("surfacing");
  for (Vault& vault : bridge.vaults) vault.material = bridge.vault;
  for (Support& support : bridge.supports) support.material = bridge.masonry;
}

JointRules joint_rules(const Bridge& bridge, const GeneratorInput& in) {
  JointRules rules;
  rules.kind = JointRules::Kind::moduli;
  const Vec3 wing(bridge.block.x(), bridge.wing_wall_thickness, bridge.block.z());
  rules.nominal = {{Component::arch, bridge.vaults.front().voussoir},
                   {Component::backing, bridge.block},
                   {Component::spandrel, bridge.block},
                   {Component::parapet, bridge.block},
                   {Component::pier, bridge.block},
                   {Component::abutment, bridge.supports.front().makeup == Makeup::leaf ? wing : bridge.block},
                   {Component::infill, bridge.infill},
                   {Component::backfill, bridge.fill}};
  // There is one layer of interface however large the blocks, so its stiffness does not follow their size.
  rules.interface_share = in("interface_share") * in("block_scale");
  rules.interface_friction = radians(in("interface_friction"));
  rules.restraint_share = in("restraint_share");
  rules.smallest_half_length = 0.25 * in("sliver_thickness") * in("block_scale");
  return rules;
}

Assembly lay_bridge(const Bridge& bridge, const std::vector<Material>& materials, const JointRules& rules,
                    const GeneratorInput& in) {
  check_feet(bridge);
  Layout layout;
  lay_piers(layout, bridge);
  lay_abutments(layout, bridge);
  lay_vaults(layout, bridge);
  lay_skewbacks(layout, bridge);
  const std::size_t above = layout.stones.size();
  lay_backing(layout, bridge);
  if (!bridge.strip) lay_spandrels(layout, bridge);
  lay_transverse_walls(layout, bridge);
  lay_internal_walls(layout, bridge);
  lay_backfill(layout, bridge);
  taper(layout, bridge, above);
  if (!bridge.strip) lay_parapets(layout, bridge);
  lay_bases(layout, bridge);
  lay_restraints(layout, bridge);
  lay_load_beam(layout, bridge);
  lay_strip_walls(layout, bridge);
  turn_to_skew(layout, bridge.skew);
  const SliverRule slivers = {in("sliver_thickness") * in("block_scale"), in("sliver_share")};
  Assembly assembly = assemble(std::move(layout), materials, slivers, in.gap_tolerance);
  assign_stiffness(assembly, rules, in);
  if (bridge.deformable_backfill) add_fill(assembly, bridge, rules, in);
  smooth_strip_walls(assembly);
  if (bridge.rigid_backfill) name_deck(assembly);
  return assembly;
}

}  // namespace voussoir
