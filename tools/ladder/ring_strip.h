// A strip of a vault with one ring or several, as blocks. Used by the rung `rings` and by tests of limit analysis.
#pragma once
#include "geometry/vault_shape.h"
#include "solver/base/error.h"
#include "solver/run/simulation.h"
#include "tools/ladder/models.h"

namespace voussoir::ladder {

/// A segmental vault between fixed springings. Rings share their radial joints.
struct RingStrip {
  std::vector<double> rings = {0.33};  // m, thickness of each, the lowest first
  double span = 3.0, rise = 0.75;      // m, of the intrados
  int voussoirs = 40;                  // of each ring
  int headers_every = 0;               // number of courses from one header to the next; a header goes through the two
                                       // lowest rings; 0: none
  double friction = 0.6;               // of radial joints and springings
  double ring_friction = 0.5;          // of the joints between rings
  bool lifts = false;                  // joints dilate with the full friction angle
  double density = 2000.0;             // kg/m3
  double width = 1.0;                  // m
  double stiffness = 1e12;             // Pa/m
};

inline Polyhedron strip_prism(Polygon section, double width) {
  for (Vec3& p : section) p.y() = -0.5 * width;
  return make_prism(section, {0.0, width, 0.0});
}

/// The fixed block beyond a springing, under all rings: `ring` from intrados to extrados of the whole vault.
inline void add_springing(Assembly& assembly, const Ring& ring, bool left, double width) {
  const std::size_t end = left ? 0 : ring.intrados.size() - 1;
  const Vec3 in = ring.intrados[end], out = ring.extrados[end];
  const Vec3 radial = (out - in).normalized();
  const Vec3 beyond = 0.3 * (left ? Vec3(-radial.z(), 0.0, radial.x()) : Vec3(radial.z(), 0.0, -radial.x()));
  const Polygon section =
      left ? Polygon{in + beyond, in, out, out + beyond} : Polygon{in, in + beyond, out + beyond, out};
  assembly.groups[left ? "springing left" : "springing right"] = {std::int64_t(assembly.blocks.size())};
  add_block(assembly, strip_prism(section, width), true);
}

inline std::vector<Ring> rings_of(const RingStrip& strip) {
  VaultShape shape;
  shape.shape = "segmental";
  shape.right = Vec3(strip.span, 0.0, 0.0);
  shape.rise = strip.rise;
  shape.crown = shape.springing = strip.rings;
  shape.voussoirs = strip.voussoirs;
  return vault_rings(shape, "ring strip");
}

/// Blocks ring by ring, the springings last. The group "course I" contains block I of the uppermost ring, from the
/// left.
inline Assembly ring_strip(const RingStrip& strip) {
  const std::vector<Ring> rings = rings_of(strip);
  Assembly assembly = stone(strip.density, 1e9, strip.friction);
  const auto section = [](const Ring& ring, std::size_t i) {
    return Polygon{ring.intrados[i], ring.intrados[i + 1], ring.extrados[i + 1], ring.extrados[i]};
  };
  const auto is_header = [&](std::size_t i) {
    return strip.headers_every > 0 && int(i) % strip.headers_every == strip.headers_every / 2;
  };
  std::vector<std::int64_t> block_of_lowest(std::size_t(strip.voussoirs), 0);
  for (std::size_t k = 0; k < rings.size(); ++k) {
    for (std::size_t i = 0; i < std::size_t(strip.voussoirs); ++i) {
      const bool joins = k == 1 && is_header(i);
      if (joins) {
        assembly.blocks[std::size_t(block_of_lowest[i])].cells.push_back(
            strip_prism(section(rings[k], i), strip.width));
      } else {
        if (k == 0) block_of_lowest[i] = std::int64_t(assembly.blocks.size());
        add_block(assembly, strip_prism(section(rings[k], i), strip.width));
      }
      if (k + 1 == rings.size())
        assembly.groups["course " + std::to_string(i)] = {joins ? block_of_lowest[i]
                                                                : std::int64_t(assembly.blocks.size()) - 1};
    }
  }
  for (const bool left : {true, false}) add_springing(assembly, whole_vault(rings), left, strip.width);
  for (Block& block : assembly.blocks)
    if (!block.fixed) block.component = Component::arch;
  assembly = joined(std::move(assembly), strip.stiffness, strip.stiffness, dry_law(strip.friction));
  assembly.laws.push_back(dry_law(strip.ring_friction));
  if (strip.lifts)
    for (JointLaw& law : assembly.laws) law.dilation_angle = law.friction_angle;
  // The normals of joints between rings are radial.
  const double radius = (0.25 * strip.span * strip.span + strip.rise * strip.rise) / (2.0 * strip.rise);
  const Vec3 centre(0.5 * strip.span, 0.0, strip.rise - radius);
  for (Joint& joint : assembly.joints) {
    Vec3 middle = Vec3::Zero();
    for (const Vec3& p : joint.polygon) middle += p / double(joint.polygon.size());
    const Vec3 out = Vec3(middle.x(), 0.0, middle.z()) - centre;
    if (std::abs(joint.normal.dot(out.normalized())) > 0.7) joint.law = 1;
  }
  return assembly;
}

/// A vertical force equal to the weight of the strip, on the extrados in the middle of the uppermost block nearest to
/// the given share of the span.
struct StripLoad {
  std::string group;
  std::int64_t block = 0;
  Vec3 force = Vec3::Zero();  // N
  Vec3 at = Vec3::Zero();     // m
};
inline StripLoad load_on(const Assembly& assembly, const RingStrip& strip, double share = 0.25) {
  const Polygon extrados = rings_of(strip).back().extrados;
  StripLoad load;
  double nearest = 1e300;
  for (std::size_t i = 0; i + 1 < extrados.size(); ++i) {
    const Vec3 middle = 0.5 * (extrados[i] + extrados[i + 1]);
    if (std::abs(middle.x() - share * strip.span) >= nearest) continue;
    nearest = std::abs(middle.x() - share * strip.span);
    load.group = "course " + std::to_string(i), load.at = middle;
  }
  load.block = assembly.groups.at(load.group)[0];
  for (const Block& block : assembly.blocks)
    if (!block.fixed) load.force.z() -= 9.81 * block.mass;
  return load;
}

/// The collapse load by the solver as a multiplier of loads, to a hundredth of the expected value. Throws RunError if
/// it finds none.
inline double collapse_multiplier(const Assembly& assembly, const Loads& loads, double expected, int threads) {
  StageSettings stage;
  stage.kind = StageSettings::Kind::collapse;
  stage.loads = loads;
  stage.collapse.to = 2.0 * expected;
  stage.collapse.tolerance = 0.01 * expected;
  stage.collapse.confirm = 0.0;
  SolverSettings settings;
  settings.step.equilibrium_tolerance = 1e-5;
  settings.stages = {StageSettings{}, stage};
  Simulation run(assembly, settings, threads, {});
  if (run.run() != RunEnd::finished || !run.collapse().found) throw RunError("no collapse load: {}", run.failure());
  return 0.5 * (run.collapse().multiplier + run.collapse().above);
}
inline double collapse_multiplier(const Assembly& assembly, const StripLoad& load, double expected, int threads) {
  Loads loads;
  loads.forces = {{load.group, load.force, load.at}};
  return collapse_multiplier(assembly, loads, expected, threads);
}

}  // namespace voussoir::ladder
