// A bonded stack rotated as a whole by 90° has no stress, and no damage afterwards.
#include "tools/ladder/models.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

constexpr double rotation_kn = 4e9, size = 1.0;  // Pa/m, m

Assembly bonded_stack() {
  Assembly assembly = generated("column", {{"blocks", 5}, {"kn", rotation_kn}, {"ks", 0.4 * rotation_kn}});
  JointLaw law = dry_law(0.6);
  law.tension = law.cohesion = 1e5;
  set_law(assembly, law);
  return assembly;
}

double largest_stress(const Bench& bench) {
  double worst = 0.0;
  for (std::size_t i = 0; i < bench.model.joints.size(); ++i) {
    const double* w = &bench.stepper.wrenches[wrench_width * i];
    worst = std::max(worst, Vec3(w[0], w[1], w[2]).norm() / bench.model.joints[i].area);
  }
  return worst;
}

std::vector<Finding> turned(bool shortcut) {
  SolverSettings settings = undamped();
  settings.damping.kind = DampingSettings::Kind::maxwell;
  settings.step.intact_shortcut = shortcut;
  Bench bench(bonded_stack(), settings);
  bench.begin();
  const Vec3 centre(3.0, -2.0, 0.5), axis = Vec3(1, 2, -0.5).normalized();
  double stress = 0.0, lost = 0.0;
  for (int degrees = 0; degrees <= 90; ++degrees) {
    const Eigen::Quaterniond q(Eigen::AngleAxisd(radians(degrees), axis));
    for (std::int64_t block = 0; block < std::int64_t(bench.assembly.blocks.size()); ++block)
      bench.turn_about(block, centre, q);
    bench.stepper.patches_only();
    stress = std::max(stress, largest_stress(bench));
  }
  int broken = 0;
  for (std::uint8_t mode : bench.state.joint.mode) broken += (mode & mode_broken) != 0;
  for (double energy : bench.state.joint.energy) lost = std::max(lost, energy);
  const std::string path = shortcut ? ", shortcut" : ", points", source = "no strain";
  return {nothing("largest stress over kn × size" + path, stress / (rotation_kn * size), 1e-9, "-", source),
          nothing("points that broke" + path, broken, 0.0, "-", source),
          nothing("energy lost in a joint" + path, lost, 1e-9, "J", source)};
}

std::vector<Finding> climb_rigid_rotation(int) {
  std::vector<Finding> findings = turned(true);
  for (Finding& finding : turned(false)) findings.push_back(std::move(finding));
  return findings;
}

}  // namespace

Rung rigid_rotation() {
  return {.name = "rigid-rotation",
          .help = "a bonded stack rotated by 90 degrees without load",
          .climb = climb_rigid_rotation};
}

}  // namespace voussoir::ladder
