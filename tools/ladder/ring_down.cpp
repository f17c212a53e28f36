// A structure released in the shape of a mode oscillates at the frequency of the eigenvalue: the time steps of a run
// against the assembled stiffness and mass.
#include "solver/base/error.h"
#include "tools/ladder/decay.h"
#include "tools/ladder/models.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

/// Frequency (Hz) at which the topmost block swings over twelve cycles, without damping, at the step of a run.
double rings_at(const Assembly& assembly, const Mode& mode) {
  Bench bench(assembly);
  bench.begin();
  bench.stepper.search_distance = 1e300;
  displace(bench, mode, 1e-6);
  const std::int64_t top = bench.assembly.groups.at("top")[0];
  const Vec3 way = bench.displacement(top).normalized();
  const double dt = bench.stepper.dt;
  const auto every = std::max(std::int64_t(1), std::int64_t(0.01 / (mode.frequency * dt)));  // a hundredth of a cycle
  std::vector<double> u;
  const bool stayed = bench.run(std::int64_t(12.5 / (mode.frequency * dt)), every,
                                [&](const BodyPass&) { u.push_back(bench.displacement(top).dot(way)); });
  if (!stayed) throw RunError("the motion of the column grows without limit");
  return measure_decay(u, double(every) * dt).frequency;
}

std::vector<Finding> climb_ring_down(int) {
  const Assembly chain = axial_chain_of(10), column = bending_column_of(10);
  const Bench bench(chain);
  Mode axial;
  for (const Mode& mode : modes_of(bench, 60))
    if (axial.frequency == 0.0 && moves_along(bench, mode, 2)) axial = mode;
  const Mode bending = modes_of(Bench(column), 1)[0];
  const std::string source = "eigenvalue of K and M";
  return {
      near("axial chain of 10 blocks released", axial.frequency, rings_at(chain, axial), 0.005, "Hz", source),
      near("bending column of 10 blocks released", bending.frequency, rings_at(column, bending), 0.005, "Hz", source)};
}

}  // namespace

Rung ring_down() {
  return {
      .name = "ring-down", .help = "frequency of a time-stepping run against the eigenvalue", .climb = climb_ring_down};
}

}  // namespace voussoir::ladder
