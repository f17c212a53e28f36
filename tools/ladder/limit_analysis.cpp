// Limit analysis by linear programming, the reference of the rung `rings`, against independent values: all four-hinge
// mechanisms of an arch, the least thickness of a semicircle, and a sliding wall.
#include "tools/limit/limit_analysis.h"

#include "tools/ladder/hinge_mechanisms.h"
#include "tools/ladder/ring_strip.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

Assembly rough_arch(double ratio, double embrace, int voussoirs) {
  Assembly assembly = generated(
      "arch",
      {{"mean_radius", 10.0}, {"thickness_ratio", ratio}, {"embrace_angle", embrace}, {"voussoirs", voussoirs}});
  set_law(assembly, dry_law(std::tan(radians(80.0))));
  return assembly;
}

limit::LimitProblem sideways() {
  limit::LimitProblem problem;
  problem.acceleration = Vec3(9.81, 0.0, 0.0);
  return problem;
}

double sideways_multiplier(const Assembly& assembly) {
  return limit::limit_analysis(assembly, sideways()).multiplier;
}

Finding of_mechanisms(const std::string& what, const Assembly& assembly) {
  const ArchLine line = arch_line(assembly, Vec3(9.81, 0.0, 0.0));
  return near(what, four_hinge_multiplier(line.intrados, line.extrados, line.loads), sideways_multiplier(assembly),
              1e-6, "-", "all four-hinge mechanisms, flat-faced voussoirs");
}

/// Thickness divided by mean radius at which a semicircle of the given number of voussoirs just carries its weight.
double least_thickness(int voussoirs) {
  double low = 0.1, high = 0.12;
  while (high - low > 1e-6) {
    const double middle = 0.5 * (low + high);
    (limit::limit_analysis(rough_arch(middle, 180.0, voussoirs), {}).stands ? high : low) = middle;
  }
  return high;
}

/// A force of the arch's weight straight down, by linear program and by all four-hinge mechanisms.
Finding point_load(const std::string& what, const Assembly& assembly, std::int64_t block, const Vec3& at) {
  double weight = 0.0;
  for (const Block& b : assembly.blocks) weight += b.fixed ? 0.0 : 9.81 * b.mass;
  limit::LimitProblem problem;
  problem.loads = {{block, {0.0, 0.0, -weight}, at}};
  ArchLine line = arch_line(assembly, Vec3::Zero());
  line.loads.live[std::size_t(block)] = Vec3(0.0, at.x() * weight, -weight);
  return near(what, four_hinge_multiplier(line.intrados, line.extrados, line.loads),
              limit::limit_analysis(assembly, problem).multiplier, 1e-6, "-",
              "all four-hinge mechanisms, flat-faced voussoirs");
}

/// The wall of the case tilting-wall.
Assembly dry_wall() {
  Assembly assembly = generated(
      "wall",
      {{"length_blocks", 5}, {"courses", 10}, {"block_length", 0.4}, {"block_height", 0.2}, {"thickness", 0.2}});
  set_law(assembly, dry_law(0.6));
  return assembly;
}

std::vector<Finding> climb_limit_analysis(int) {
  std::vector<Finding> findings;
  for (const double ratio : {0.12, 0.15, 0.20, 0.25})
    findings.push_back(of_mechanisms(fmt::format("multiplier of gravity, semicircle, t/R = {:.2f}", ratio),
                                     rough_arch(ratio, 180.0, 27)));
  findings.push_back(of_mechanisms("multiplier of gravity, Oppenheim's arch", rough_arch(0.15, 157.5, 7)));
  findings.push_back(near("least thickness of a semicircle, 200 voussoirs", 0.10746, least_thickness(200), 1e-3, "-",
                          "Milankovitch 1907: 0.1075"));
  const Assembly semicircle = rough_arch(0.15, 180.0, 27);
  findings.push_back(point_load("load over weight, semicircle of the case point-load", semicircle,
                                semicircle.groups.at("voussoir 9")[0], {5.933571, 0.0, 9.590298}));
  const RingStrip strip;
  const Assembly segment = ring_strip(strip);
  const StripLoad load = load_on(segment, strip);
  findings.push_back(point_load("load over weight, segmental ring", segment, load.block, load.at));
  const Assembly column = generated("column", {{"blocks", 4}, {"block_height", 1.0}});
  for (const auto& [friction, expected] : {std::pair(0.75, 0.25), std::pair(0.2, 0.2)}) {
    Assembly stack = column;
    set_law(stack, dry_law(friction));
    findings.push_back(near(fmt::format("multiplier of gravity, four cubes, friction {:.2f}", friction), expected,
                            sideways_multiplier(stack), 1e-6, "-", "statics"));
  }
  findings.push_back(near("slope of a dry wall on a table, associated friction", 0.524, sideways_multiplier(dry_wall()),
                          2e-3, "-", "upper bound of the case tilting-wall"));
  return findings;
}

}  // namespace

Rung limit_analysis() {
  return {.name = "limit-analysis",
          .help = "limit analysis by linear programming: mechanisms, least thickness, friction",
          .climb = climb_limit_analysis};
}

}  // namespace voussoir::ladder
