// wall: equal blocks in running bond on one fixed block, which may crack in the middle.
#include <cmath>

#include "geometry/generate.h"
#include "geometry/masonry.h"
#include "geometry/stiffness.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

/// The bond of a wall: blocks are two units long, x counts in units from the left end, and odd courses begin with half
/// a block, as they end (or the even ones do, where the length is a whole number and a half).
class Bond {
 public:
  explicit Bond(double blocks) : units_(int(std::lround(2.0 * blocks))) {
    if (std::abs(0.5 * units_ - blocks) > 1e-9)
      throw InputError("[bridge] length_blocks = {:g}. It must be a whole number, or a whole number and a half.",
                       blocks);
  }
  int units() const { return units_; }
  /// Whether there is a head joint between two blocks at the end of a unit; otherwise it is the middle of a block.
  bool is_head(int unit, int course) const {
    return unit == 0 || unit == units_ || (unit + (units_ > 2 ? course : 0)) % 2 == 0;
  }

 private:
  int units_;
};

/// Lays all courses; with `halves` every block is two stones, with the place of a crack between them.
void lay_wall(Layout& layout, const Bond& bond, const Vec3& size, int courses, const Unit& unit, bool halves) {
  check_stones((halves ? 1.0 : 0.5) * bond.units() * courses);
  const double step = size.x() / (0.5 * bond.units()), half = 0.5 * size.y();
  const auto x = [&](int at) { return at == bond.units() ? size.x() : 0.5 * at * step; };
  const std::vector<double> z = split(0.0, size.z(), unit.size.z());
  for (int course = 0; course < courses; ++course)
    for (int from = 0, to = 1; to <= bond.units(); ++to)
      if (halves || bond.is_head(to, course)) {
        const Polygon face = rectangle(x(from), x(to), z[std::size_t(course)], z[std::size_t(course) + 1]);
        lay_across(layout, {face}, {-half, half}, unit, unit.size);
        from = to;
      }
}

/// A crack through a block: elastic until its strength is reached, then softening with its energy, or brittle without.
/// Its cohesion is twice the strength (assumed), so that it opens before it slides.
JointLaw crack_law(const GeneratorInput& in, const Material& masonry) {
  JointLaw law;
  law.tension = in("crack_strength"), law.cohesion = 2.0 * law.tension;
  law.friction_angle = law.residual_friction_angle = masonry.friction_angle;
  if (const double energy = in("crack_energy"); energy > 0.0) {
    law.kind = JointLaw::Kind::composite;
    law.fracture_energy = {energy, 10.0 * energy};
  }
  return law;
}

/// Gives the joints in the middle of blocks the stiffness of half a block on either side and the law of a crack.
void set_cracks(Assembly& assembly, const GeneratorInput& in, const Bond& bond, const Vec3& block) {
  const Material& masonry = assembly.materials[0];
  const std::int32_t law = law_index(assembly.laws, crack_law(in, masonry));
  for (Joint& joint : assembly.joints) {
    if (std::abs(joint.normal.x()) < 0.5) continue;
    const Vec3 at = polygon_centroid(joint.polygon);
    if (bond.is_head(int(std::lround(2.0 * at.x() / block.x())), int(at.z() / block.z()))) continue;
    joint.kn = 2.0 * masonry.youngs_modulus / block.x(), joint.ks = 2.0 * masonry.shear_modulus / block.x();
    joint.law = law;
  }
}

Assembly build_wall(const std::vector<Material>& defaults, const GeneratorInput& in) {
  const Vec3 block(in("block_length"), in("thickness"), in("block_height"));
  const double length = in("length_blocks") * block.x(), height = in("courses") * block.z(), half = 0.5 * block.y();
  const Bond bond(in("length_blocks"));
  const bool cracks = in("crack_strength") > 0.0;
  Layout layout;
  lay_wall(layout, bond, {length, block.y(), height}, int(in("courses")), {Component::wall, 0, 0, block}, cracks);
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
  if (cracks) set_cracks(assembly, in, bond, block);
  return assembly;
}

}  // namespace

Generator wall_generator() {
  Generator generator;
  generator.name = "wall";
  generator.help =
      "Wall of equal blocks in running bond on one fixed block; odd courses have half blocks at their ends";
  generator.parameters = {
      {"length_blocks", 10.0, 1.0, 10000.0, "-", "number of blocks in a course; may end in .5"},
      {"courses", 10.0, 1.0, 10000.0, "-", "number of courses", true},
      {"block_length", 0.60, 0.001, 20.0, "m", "block length along the wall (x)"},
      {"block_height", 0.50, 0.001, 20.0, "m", "course height (z)"},
      {"thickness", 0.45, 0.001, 20.0, "m", "thickness of the wall (y), one block"},
      {"beam_height", 0.0, 0.0, 20.0, "m", "height of a fixed loading beam on the top course; 0: no beam"},
      {"crack_strength", 0.0, 0.0, 1e9, "Pa",
       "tensile strength of the blocks in their middle, where they may crack; 0: no cracks"},
      {"crack_energy", 0.0, 0.0, 1e9, "J/m2",
       "fracture energy of such a crack, which softens exponentially; 0: brittle"},
      {"kn", 0.0, 0.0, 1e18, "Pa/m", "normal stiffness of all joints; 0: E/dc"},
      {"ks", 0.0, 0.0, 1e18, "Pa/m", "shear stiffness of all joints; 0: G/dc"}};
  generator.materials = {{"masonry", 2000.0, 4.0e9, 1.6e9, 0.0, 0.0, radians(30.0)}};
  generator.build = [materials = generator.materials](const GeneratorInput& in) { return build_wall(materials, in); };
  return generator;
}

}  // namespace voussoir
