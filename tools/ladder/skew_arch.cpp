// The thinnest skew barrel that bears its weight, for three ways to lay its beds. Forgács, Sarhosis & Bagi (2017) found
// by the distinct element method that the least thickness of semicircular barrels rises with the angle when the beds
// run along the barrel (false skew) and falls with it for helicoidal and logarithmic beds. At 0° all three are one
// arch, whose least thickness is 0.1075 of the mean radius (Milankovitch 1907). With beds along the barrel the thrust
// goes square to them, and its two ends lie u tan α apart along the barrel: friction has to carry tan α of it, so that
// the least thickness stays that of the square barrel until the skew comes near the angle of friction.
#include <fmt/format.h>

#include "geometry/masonry_parts.h"
#include "solver/base/error.h"
#include "tools/ladder/models.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

constexpr double barrel_radius = 5.0, barrel_width = 5.0;  // m: of the ring's middle; from face to face
constexpr int barrel_wedges = 20;                          // of the semicircle
constexpr double stiff_joint = 1e11;                       // Pa/m: near rigid
constexpr double joint_friction = 30.0;                    // degrees

/// A barrel on two fixed blocks, in dry joints.
Assembly barrel(double skew, SkewBond bond, double ratio) {
  const double inner = barrel_radius * (1.0 - 0.5 * ratio), outer = barrel_radius * (1.0 + 0.5 * ratio);
  Bridge bridge;
  bridge.skew = radians(skew), bridge.skew_bond = bond, bridge.width = barrel_width;
  bridge.vaults = {{{make_semicircle({outer, 0.0, 0.0}, inner, outer, barrel_wedges)},
                    {pi * inner / barrel_wedges, barrel_width / 6.0, outer - inner}}};
  Layout layout;
  lay_vaults(layout, bridge);
  const double inside = outer - inner;
  for (const double x : {0.0, 2.0 * outer - inside}) {
    const Vec3 low(x, -0.5 * barrel_width, -0.5), high(x + inside, 0.5 * barrel_width, 0.0);
    lay_stone(layout, {make_box(low, high)}, {Component::base, 0, 0, high - low}, high - low, false);
  }
  turn_to_skew(layout, bridge.skew);
  const std::vector<Material> material = {{"stone", 2000.0, 1e10, 4e9, 0.0, 0.0, radians(joint_friction)}};
  Assembly assembly = assemble(std::move(layout), material, {}, 1e-4);
  std::erase_if(assembly.joints, [&](const Joint& j) {
    return assembly.blocks[std::size_t(j.a)].fixed && assembly.blocks[std::size_t(j.b)].fixed;
  });
  assembly.laws = {dry_law(std::tan(radians(joint_friction)))};
  for (Joint& joint : assembly.joints) joint.kn = joint.ks = stiff_joint, joint.law = 0;
  return assembly;
}

/// Whether the barrel comes to rest under its weight. A displacement of a twentieth of its thickness counts as
/// collapse.
bool stands(double skew, SkewBond bond, double ratio) {
  Bench bench(barrel(skew, bond, ratio), undamped({0.0, 0.0, -9.81}));
  RelaxationLimits limits;
  limits.displacement = 0.05 * ratio * barrel_radius;
  return relax(bench.stepper, 1e-5, limits, nullptr, nullptr).converged;
}

/// Over the mean radius, to half a per cent of it.
double least_thickness(double skew, SkewBond bond) {
  double low = 0.05, high = 0.25;
  if (!stands(skew, bond, high)) throw RunError("a skew barrel of thickness {:g} R does not stand", high);
  while (high > 1.005 * low) {
    const double middle = 0.5 * (low + high);
    (stands(skew, bond, middle) ? high : low) = middle;
  }
  return 0.5 * (low + high);
}

std::vector<Finding> climb_skew_arch(int) {
  const double square = least_thickness(0.0, SkewBond::parallel);
  std::vector<Finding> findings = {near("least thickness of the square barrel over its mean radius", 0.1075, square,
                                        0.01, "-", "Milankovitch 1907")};
  const auto sign = [&](const std::string& bond, double skew, SkewBond beds, double expected) {
    const double thickness = least_thickness(skew, beds), change = thickness / square - 1.0;
    const double got = std::abs(change) < 0.01 ? 0.0 : std::copysign(1.0, change);
    findings.push_back(within(fmt::format("{}, {:g} deg: sign of its change", bond, skew), expected, got, 0.0, "-",
                              fmt::format("Forgács, Sarhosis & Bagi 2017; here {:.4f}", thickness)));
  };
  sign("false skew", 40.0, SkewBond::parallel, 1.0);
  sign("helicoidal", 15.0, SkewBond::helicoidal, -1.0);
  sign("helicoidal", 40.0, SkewBond::helicoidal, -1.0);
  sign("logarithmic", 15.0, SkewBond::logarithmic, -1.0);
  sign("logarithmic", 40.0, SkewBond::logarithmic, -1.0);
  return findings;
}

}  // namespace

Rung skew_arch() {
  return {"skew-arch", "the least thickness of skew barrels: false skew, helicoidal and logarithmic beds",
          climb_skew_arch, true};
}

}  // namespace voussoir::ladder
