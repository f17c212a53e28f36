// A chain of blocks: axial frequencies of the assembled stiffness and mass, and the speed of a long wave in a run.
#include "solver/base/error.h"
#include "tools/ladder/models.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

/// The base of a chain of 400 moves up by a smooth step of 40 ms, 36 m of wave; speed of the peak between two blocks.
double wave_speed() {
  Bench bench(axial_chain_of(400));
  GroundMotion push;
  push.dt = 1e-4;
  for (int i = 0; i <= 400; ++i) push.acceleration.emplace_back(0, 0, std::sin(2 * pi * i / 400.0));
  bench.begin();
  bench.stepper.motion = &push;
  const std::int64_t low = 100, high = 300;
  double peak[2] = {0, 0}, when[2] = {0, 0};
  const bool stayed = bench.run(std::int64_t(0.19 / bench.stepper.dt), 1, [&](const BodyPass&) {
    for (int i : {0, 1}) {
      const double v = bench.velocity(i == 0 ? low : high).z();
      if (v > peak[i]) peak[i] = v, when[i] = bench.state.time();
    }
  });
  if (!stayed) throw RunError("the motion of the chain grows without limit");
  return double(high - low) * 0.4 / (when[1] - when[0]);
}

/// ω_j = 2 √(k/m) sin((2j − 1) π/(2 (2N + 1))).
std::vector<Finding> climb_axial_chain(int) {
  const Bench bench(axial_chain_of(10));
  std::vector<Mode> modes;
  for (Mode& mode : modes_of(bench, 60))
    if (moves_along(bench, mode, 2)) modes.push_back(std::move(mode));
  if (modes.size() != 10) throw RunError("the chain has {} axial modes, not 10", modes.size());
  const std::string source = "closed form of a discrete chain";
  std::vector<Finding> findings;
  const double expected[3] = {53.190, 158.382, 260.036};
  for (int j = 0; j < 3; ++j)
    findings.push_back(
        near("axial mode " + std::to_string(j + 1), expected[j], modes[std::size_t(j)].frequency, 1e-3, "Hz", source));
  double worst = 0.0;
  for (int j = 0; j < 10; ++j) {
    const double exact = std::sqrt(4e9 / 800.0) / pi * std::sin((2 * j + 1) * pi / 42);
    worst = std::max(worst, std::abs(modes[std::size_t(j)].frequency / exact - 1.0));
  }
  findings.push_back(nothing("largest error of all ten axial modes", worst, 1e-9, "-", source));
  findings.push_back(near("speed of a long wave", 894.43, wave_speed(), 0.01, "m/s", "h sqrt(k/m)"));
  return findings;
}

}  // namespace

Rung axial_chain() {
  return {.name = "axial-chain",
          .help = "axial frequencies and wave speed of a chain of blocks",
          .climb = climb_axial_chain};
}

}  // namespace voussoir::ladder
