// Rotation about the intermediate axis with a small disturbance: the block flips repeatedly (Euler 1765) and conserves
// energy and momentum.
#include "solver/base/error.h"
#include "tools/ladder/models.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

double spin_energy(Bench& bench) {
  const Body& body = bench.model.bodies[0];
  const Vec3 local = bench.rotation(0).conjugate() * bench.momentum(0);
  return 0.5 * local.dot(body.inverse_inertia * local);
}

std::vector<Finding> climb_free_spin(int) {
  Bench bench(asymmetric_block());
  bench.begin(2 * pi / 4000);  // spin 1 rad/s: 4000 steps a turn
  bench.stepper.search_distance = 1e300;
  bench.push(0, Vec3::Zero(), Vec3(1e-3, 1.0, 2e-3));
  const double energy = spin_energy(bench);
  const Vec3 momentum = bench.momentum(0);
  double worst = 0.0, least = 1.0;
  for (int i = 0; i < 100 * 400; ++i) {
    if (!bench.run(10)) throw RunError("the motion of the block grows without limit");
    worst = std::max(worst, std::abs(spin_energy(bench) / energy - 1.0));
    const Vec3 local = bench.rotation(0).conjugate() * bench.momentum(0);
    least = std::min(least, local.y() / momentum.norm());
  }
  const double change = (bench.momentum(0) - momentum).norm() / momentum.norm();
  return {nothing("largest change of energy in 100 turns", worst, 1e-6, "-", "free body"),
          nothing("change of momentum in 100 turns", change, 1e-6, "-", "free body"),
          within("flips: cosine of spin and axis at the far end", -1.0, least, 0.1, "-", "Euler 1765")};
}

}  // namespace

Rung free_spin() {
  return {.name = "free-spin",
          .help = "an unsymmetric block spins 100 turns about its middle axis",
          .climb = climb_free_spin};
}

}  // namespace voussoir::ladder
