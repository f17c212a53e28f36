// Tie rods across the bridge, from spandrel to spandrel above a support: an axial spring between the two walls.
#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

/// Supports with a wall stone on both sides: the groups "spandrel y- SUPPORT" and "spandrel y+ SUPPORT".
std::vector<std::string> tied(const Assembly& assembly) {
  std::vector<std::string> names;
  for (const auto& [name, blocks] : assembly.groups)
    if (name.starts_with("spandrel y- ") && assembly.groups.contains("spandrel y+ " + name.substr(12)))
      names.push_back(name.substr(12));
  return names;
}

std::vector<std::string> places_of_tie_rods(const Assembly& assembly) {
  std::vector<std::string> names = tied(assembly);
  if (names.size() > 1) names.push_back("all");
  return names;
}

/// A patch of 0.1 m by 0.1 m midway between the two stones. It resists almost only their separation along y.
void tie(Assembly& assembly, std::int64_t one, std::int64_t other, double axial) {
  const Vec3 a = assembly.blocks[std::size_t(one)].centroid, b = assembly.blocks[std::size_t(other)].centroid;
  const Vec3 middle = 0.5 * (a + b);
  constexpr double half = 0.05;
  const double length = std::abs(b.y() - a.y()), kn = axial / length / (4.0 * half * half);
  const Polygon patch = {middle + Vec3(-half, 0, -half), middle + Vec3(-half, 0, half), middle + Vec3(half, 0, half),
                         middle + Vec3(half, 0, -half)};  // counter-clockwise about +y
  add_joint(assembly, one, other, patch, Vec3::UnitY() * (b.y() > a.y() ? 1.0 : -1.0), kn, 1e-3 * kn,
            elastic_law_index(assembly));
}

void apply_tie_rods(Assembly& assembly, const std::string& where, const std::vector<double>& values) {
  if (values[0] == 0.0) return;
  for (const std::string& support : tied(assembly))
    if (where == "all" || where == support)
      tie(assembly, assembly.groups.at("spandrel y- " + support)[0], assembly.groups.at("spandrel y+ " + support)[0],
          values[0]);
}

}  // namespace

Effect tie_rods() {
  return {
      "tie_rods",
      "tie rods hold the spandrel walls together above a support",
      "Look for the anchor plates of tie rods on both faces of the walls, and for rods that the drawings do not show.",
      {{"axial_stiffness", "N", "axial stiffness E A of the rods at one place", 0.0, 1e10, 0.0, 2e8, 2e8}},
      places_of_tie_rods,
      apply_tie_rods,
      nullptr};
}

}  // namespace voussoir
