// wall: equal blocks in running bond on one fixed block.
#include "geometry/generate.h"
#include "geometry/masonry.h"
#include "geometry/stiffness.h"

namespace voussoir {

namespace {

Assembly build_wall(const std::vector<Material>& defaults, const GeneratorInput& in) {
  const Vec3 block(in("block_length"), in("thickness"), in("block_height"));
  const double length = in("length_blocks") * block.x(), height = in("courses") * block.z(), half = 0.5 * block.y();
  Layout layout;
  lay_courses(layout, {0.0, -half, 0.0}, {length, half, height}, {Component::wall, 0, 0, block});
  auto& top = layout.groups["top"];
  for (std::size_t i = 0; i < layout.stones.size(); ++i) {
    if (bounding_box(layout.stones[i].cells[0]).high.z() > height - 0.5 * block.z()) top.push_back(std::int64_t(i));
  }
  if (const double beam = in("beam_height"); beam > 0.0) {
    layout.groups["beam"] = {std::int64_t(layout.stones.size())};
    const Vec3 from(0.0, -half, height), to(length, half, height + beam);
    lay_stone(layout, {make_box(from, to)}, {Component::restraint, 0, 0, to - from}, to - from, false);
  }
  layout.groups["base"] = {std::int64_t(layout.stones.size())};
  const Vec3 low(0.0, -half, -block.z()), high(length, half, 0.0);
  lay_stone(layout, {make_box(low, high)}, {Component::base, 0, 0, high - low}, high - low, false);

  Assembly assembly = assemble(std::move(layout), in_order(defaults, in), {}, in.gap_tolerance);
  JointRules rules = uniform_rules(in);
  rules.nominal[Component::wall] = block;
  assign_stiffness(assembly, rules, in);
  return assembly;
}

}  // namespace

Generator wall_generator() {
  Generator generator;
  generator.name = "wall";
  generator.help = "Wall of equal blocks in running bond, half blocks at the ends of odd courses, on one fixed block";
  generator.parameters = {{"length_blocks", 10.0, 1.0, 10000.0, "-", "whole blocks in an even course", true},
                          {"courses", 10.0, 1.0, 10000.0, "-", "number of courses", true},
                          {"block_length", 0.60, 0.001, 20.0, "m", "along the wall (x)"},
                          {"block_height", 0.50, 0.001, 20.0, "m", "course height (z)"},
                          {"thickness", 0.45, 0.001, 20.0, "m", "of the wall (y), one block"},
                          {"beam_height", 0.0, 0.0, 20.0, "m", "of a fixed loading beam over the top course; 0: none"},
                          {"kn", 0.0, 0.0, 1e18, "Pa/m", "normal stiffness of all joints; 0: E/dc"},
                          {"ks", 0.0, 0.0, 1e18, "Pa/m", "shear stiffness of all joints; 0: G/dc"}};
  generator.materials = {{"masonry", 2000.0, 4.0e9, 1.6e9, 0.0, 0.0, radians(30.0)}};
  generator.build = [materials = generator.materials](const GeneratorInput& in) { return build_wall(materials, in); };
  return generator;
}

}  // namespace voussoir
