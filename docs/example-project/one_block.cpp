// A block of half a metre on a base: at rest under its weight, then a second of its own time.
#include <cstdio>

#include "geometry/stiffness.h"
#include "solver/run/simulation.h"

using namespace voussoir;

int main() {
  Assembly assembly;
  assembly.materials = {{"stone", 2000.0, 1e9, 0.4e9, 0.0, 0.0, 0.6}};  // kg/m3, Pa, Pa, no bond, friction angle in rad
  assembly.blocks.resize(2);
  assembly.blocks[0].cells = {make_box({-1, -1, -0.5}, {1, 1, 0})};
  assembly.blocks[0].component = Component::base;
  assembly.blocks[0].fixed = true;
  assembly.blocks[1].cells = {make_box({-0.25, -0.25, 0}, {0.25, 0.25, 0.5})};
  finish_blocks(assembly);
  lay_joints(assembly, {}, {.kn = 1e9, .ks = 4e8});  // Pa/m

  StageSettings gravity, free;
  free.kind = StageSettings::Kind::free;
  free.duration = 1.0;  // s
  SolverSettings settings;
  settings.stages = {gravity, free};

  Simulation simulation(assembly, settings, 1, {});
  if (simulation.run() != RunEnd::finished) return 1;
  const auto body = std::size_t(simulation.model().body_of_block[1]);
  const double z = simulation.state().pose[pose_width * body + 2];  // m, since it was put there
  std::printf("After %g s the block has sunk by %.4g m; weight over stiffness is %.4g m.\n", simulation.end_time(), -z,
              2000.0 * 0.5 * 9.81 / 1e9);
}
