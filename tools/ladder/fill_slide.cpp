// A slab of fill on an inclined stone: it stays below the interface's angle of friction, and slides above it.
#include "solver/base/error.h"
#include "tools/ladder/fill_models.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

const double friction = std::tan(radians(35.0));

/// Acceleration down a plane of `degrees`, from the mean velocity of the nodes over 0.4 s; gravity is turned instead
/// of the plane.
double acceleration(double degrees) {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, -1}, {6, 2, 0}, true);
  FillMesh mesh = box_mesh({0.5, 0.5, 0}, {2, 1.5, 0.4}, 3, 2, 1);
  const double angle = radians(degrees);
  // A hundred times as stiff as the fill of bridges, because a soft slab vibrates as it slides.
  const Material stiff = elastic_fill(1500.0, 80e9 / 3.0, 16e9);
  SolverSettings settings = undamped(9.81 * Vec3(std::sin(angle), 0, -std::cos(angle)));
  settings.damping.kind = DampingSettings::Kind::maxwell;  // of its own vibrations, which would ease the friction
  settings.damping.ratio = 0.05, settings.damping.band = {50.0, 1000.0};
  Bench bench(filled(std::move(assembly), std::move(mesh), stiff, 1e9, 0.4e9, dry_law(friction)), settings);
  const FillModel& fill = bench.model.fill;
  // Pressed down by its weight already, so that it does not bounce.
  for (std::size_t i = 0; i < fill.nodes.size(); ++i)
    move_node(bench.state, i, {0, 0, -1500.0 * 0.4 * 9.81 * std::cos(angle) / 1e9});
  bench.begin(1e-5);
  double mass = 0.0;
  const auto momentum = [&] {
    double sum = 0.0;
    for (std::size_t i = 0; i < fill.nodes.size(); ++i) sum += fill.mass[i] * node_motion(bench.state, i).x();
    return sum;
  };
  for (const double m : fill.mass) mass += m;
  if (!bench.run(5000)) throw RunError("the motion of the slab of fill grows without limit");
  const double before = momentum();
  const double time = bench.state.time();
  if (!bench.run(40000)) throw RunError("the motion of the slab of fill grows without limit");
  return (momentum() - before) / mass / (bench.state.time() - time);
}

std::vector<Finding> climb_fill_slide(int) {
  const double angle = radians(40.0);
  const double expected = 9.81 * (std::sin(angle) - friction * std::cos(angle));
  return {near("acceleration on a plane of 40 degrees", expected, acceleration(40.0), 5e-3, "m/s2", "Coulomb"),
          nothing("acceleration on a plane of 30 degrees", acceleration(30.0), 1e-2, "m/s2", "Coulomb: no sliding")};
}

}  // namespace

Rung fill_slide() {
  return {.name = "fill-slide", .help = "a slab of fill on an inclined stone", .climb = climb_fill_slide};
}

}  // namespace voussoir::ladder
