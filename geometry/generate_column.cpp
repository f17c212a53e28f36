// column: a stack of equal blocks on a fixed one, for the verification of axial and bending waves.
#include "geometry/generate.h"
#include "geometry/masonry.h"
#include "geometry/stiffness.h"

namespace voussoir {

namespace {

Assembly build_column(const std::vector<Material>& defaults, const GeneratorInput& in) {
  const int n = int(in("blocks"));
  const Vec3 half(0.5 * in("width"), 0.5 * in("depth"), 0.0);
  const double height = in("block_height");
  Layout layout;
  for (int i = 0; i < n; ++i) {
    const Vec3 low(-half.x(), -half.y(), i * height), high(half.x(), half.y(), (i + 1) * height);
    lay_stone(layout, {make_box(low, high)}, {Component::block, 0, 0, high - low}, high - low, false);
  }
  const auto or_as_wide = [](double wanted, double own) { return 0.5 * (wanted > 0.0 ? wanted : 2.0 * own); };
  const Vec3 plinth(or_as_wide(in("base_width"), half.x()), or_as_wide(in("base_depth"), half.y()), 0.0);
  const Vec3 low(-plinth.x(), -plinth.y(), -height), high(plinth.x(), plinth.y(), 0.0);
  lay_stone(layout, {make_box(low, high)}, {Component::base, 0, 0, high - low}, high - low, false);
  layout.groups["all"] = {};
  for (int i = 0; i < n; ++i) layout.groups["all"].push_back(i);
  layout.groups["top"] = {n - 1};
  layout.groups["base"] = {n};

  Assembly assembly = assemble(std::move(layout), in_order(defaults, in), {}, in.gap_tolerance);
  assign_stiffness(assembly, uniform_rules(in), in);
  return assembly;
}

}  // namespace

Generator column_generator() {
  Generator generator;
  generator.name = "column";
  generator.help = "Stack of equal blocks on a fixed block; all joints are equal, also the one on the base";
  generator.parameters = {{"blocks", 10.0, 1.0, 100000.0, "-", "number of moving blocks", true},
                          {"width", 1.0, 0.001, 100.0, "m", "width along x, symmetric about x = 0"},
                          {"depth", 1.0, 0.001, 100.0, "m", "depth along y, symmetric about y = 0"},
                          {"block_height", 0.4, 0.001, 100.0, "m", "height of each block"},
                          {"base_width", 0.0, 0.0, 1000.0, "m", "width of the fixed block; 0: as the other blocks"},
                          {"base_depth", 0.0, 0.0, 1000.0, "m", "depth of the fixed block; 0: as the other blocks"},
                          {"kn", 0.0, 0.0, 1e18, "Pa/m", "normal stiffness of all joints; 0: E/dc"},
                          {"ks", 0.0, 0.0, 1e18, "Pa/m", "shear stiffness of all joints; 0: G/dc"}};
  generator.materials = {{"masonry", 2000.0, 4.0e9, 1.6e9, 0.0, 0.0, radians(30.0)}};
  generator.build = [materials = generator.materials](const GeneratorInput& in) { return build_column(materials, in); };
  return generator;
}

}  // namespace voussoir
