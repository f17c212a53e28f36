// What is let go in the shape of a mode rings at the frequency that the eigenvalue says: the steps of a run against the
// assembled stiffness and mass.
#include "solver/base/error.h"
#include "tools/ladder/decay.h"
#include "tools/ladder/models.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

/// Displaces the free bodies by so much of a mode, whose largest component is then `largest` (m or rad).
void displace(Bench& bench, const Mode& mode, double largest) {
  const Unknowns unknowns = number_unknowns(bench.model);
  const Eigen::VectorXd u = mode.shape * (largest / mode.shape.cwiseAbs().maxCoeff());
  for (std::size_t i = 0; i < bench.model.bodies.size(); ++i) {
    const std::int32_t at = unknowns.of_body[i];
    if (at < 0) continue;
    double* p = &bench.state.pose[pose_width * i];
    for (int c = 0; c < 3; ++c) p[c] = u[at + c], p[4 + c] = 0.5 * u[at + 3 + c];
  }
}

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
  if (!stayed) throw RunError("the column ran away");
  return measure_decay(u, double(every) * dt).frequency;
}

std::vector<Finding> climb(int) {
  const Assembly chain = axial_chain_of(10), column = bending_column_of(10);
  const Mode axial = modes_along(Bench(chain), 2).at(0), bending = modes_of(Bench(column)).at(0);
  const std::string source = "eigenvalue of K and M";
  return {
      near("axial chain of 10 blocks let go", axial.frequency, rings_at(chain, axial), 0.005, "Hz", source),
      near("bending column of 10 blocks let go", bending.frequency, rings_at(column, bending), 0.005, "Hz", source)};
}

}  // namespace

Rung ring_down() {
  return {.name = "ring-down", .help = "frequency of a run against the eigenvalue", .climb = climb};
}

}  // namespace voussoir::ladder
