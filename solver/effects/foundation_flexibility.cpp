// Soil under a support: springs between its base, which is set free, and the ground. Static stiffness of a rigid
// rectangular footing of half-sides B <= L on a half-space (Pais & Kausel 1988, tables 1 and 2):
//   vertical    G B/(1 − ν) [3.1 (L/B)^0.75 + 1.6]
//   along L     G B/(2 − ν) [6.8 (L/B)^0.65 + 2.4],  along B: that + G B/(2 − ν) 0.8 (L/B − 1)
//   about L     G B³/(1 − ν) [3.2 L/B + 0.8],        about B: G B³/(1 − ν) [3.73 (L/B)^2.4 + 0.27]
// One elastic patch carries them all: its area and moments of area are chosen so that kn A, kn I and ks A are these
// (ks A: the mean of both directions).
#include <cmath>

#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

constexpr double poisson = 0.3;

struct Springs {
  double vertical = 0.0, sliding = 0.0;        // N/m
  double about_long = 0.0, about_short = 0.0;  // N m: about the axis along L, along B
};

Springs on_half_space(double g, double b, double l) {
  const double r = l / b;
  Springs s;
  s.vertical = g * b / (1.0 - poisson) * (3.1 * std::pow(r, 0.75) + 1.6);
  const double along = g * b / (2.0 - poisson) * (6.8 * std::pow(r, 0.65) + 2.4);
  s.sliding = along + 0.5 * g * b / (2.0 - poisson) * 0.8 * (r - 1.0);
  s.about_long = g * b * b * b / (1.0 - poisson) * (3.2 * r + 0.8);
  s.about_short = g * b * b * b / (1.0 - poisson) * (3.73 * std::pow(r, 2.4) + 0.27);
  return s;
}

void put_on_soil(Assembly& assembly, std::int64_t base, double g) {
  const Box box = block_box(assembly.blocks[std::size_t(base)]);
  const Vec3 size = box.high - box.low, centre = 0.5 * (box.low + box.high);
  const bool long_in_x = size.x() > size.y();
  const Springs s = on_half_space(g, 0.5 * std::min(size.x(), size.y()), 0.5 * std::max(size.x(), size.y()));
  // Sides of the patch: kn w³ l/12 = stiffness about the axis along l, kn w l = vertical.
  const double l = std::sqrt(12.0 * s.about_short / s.vertical), w = std::sqrt(12.0 * s.about_long / s.vertical);
  const double half_x = 0.5 * (long_in_x ? l : w), half_y = 0.5 * (long_in_x ? w : l);
  const double z = box.low.z();
  const Polygon patch = {{centre.x() - half_x, centre.y() - half_y, z},
                         {centre.x() - half_x, centre.y() + half_y, z},
                         {centre.x() + half_x, centre.y() + half_y, z},
                         {centre.x() + half_x, centre.y() - half_y, z}};  // counter-clockwise about −z
  assembly.blocks[std::size_t(base)].fixed = false;
  const std::int64_t ground = add_box_block(assembly, {box.low.x(), box.low.y(), z - 1.0},
                                            {box.high.x(), box.high.y(), z}, Component::base, 0, true);
  assembly.blocks[std::size_t(ground)].part = assembly.blocks[std::size_t(base)].part;
  add_joint(assembly, base, ground, patch, -Vec3::UnitZ(), s.vertical / (w * l), s.sliding / (w * l),
            elastic_law_index(assembly));
}

void apply_foundation_flexibility(Assembly& assembly, const std::string& where, const std::vector<double>& values) {
  for (const std::string& support : supports(assembly))
    if (where == "all" || where == support) {
      const std::int64_t base = base_of(assembly, support);
      if (assembly.blocks[std::size_t(base)].fixed) put_on_soil(assembly, base, values[0]);
    }
}

std::vector<std::string> places_of_foundation_flexibility(const Assembly& assembly) {
  std::vector<std::string> names = supports(assembly);
  if (names.size() > 1) names.push_back("all");
  return names;
}

}  // namespace

Effect foundation_flexibility() {
  return {
      "foundation_flexibility",
      "the soil under a support is flexible: the support moves vertically, slides and rocks on springs",
      "Look for settlement and tilt of the support, and probe the ground next to its foundation (penetration tests, a "
      "core through the base).",
      {{"soil_shear_modulus", "Pa", "shear modulus of the half-space under the base", 1e6, 1e12, 1e12, 1e8, 1.5, true}},
      places_of_foundation_flexibility,
      apply_foundation_flexibility,
      nullptr};
}

}  // namespace voussoir
