// The phases of a time step: the time that each takes, and the work that it does.
#pragma once
#include <string>
#include <vector>

#include "tools/bench/scenes.h"

namespace voussoir {

/// The work of one item of a phase: bytes read and written, and operations (additions and multiplications; a division
/// or a root counts as one). The numbers were counted in the layout of the data and in the source.
struct Work {
  double bytes = 0.0, operations = 0.0;
};
/// A joint on the intact path with `branches` damping branches.
Work intact_work(int branches);
/// A joint that is computed at `points` points, either of a rectangle or from tables.
Work points_work(int branches, double points, bool rectangle);
/// The first pass over a tetrahedron (volumes) and the second (stresses). `flowed` is the share of the tetrahedra whose
/// plastic strain is read. A node of the fill has `sums` contributions.
Work volume_work(double flowed);
Work stress_work(int branches, double flowed);
Work node_work(double sums);
/// A free body whose forces and moments are the sum of `sums` entries.
Work body_work(double sums);

struct Phase {
  std::string name;
  double items = 0.0;    // per time step
  double seconds = 0.0;  // per time step
  Work work;             // per time step; zero if it was not counted
};

/// The phases of a time step, timed tile by tile over `steps` further time steps on one thread. The times of intact
/// joints, joints computed point by point and contacts are separated by least squares over the tiles.
std::vector<Phase> step_phases(Running& scene, std::int64_t steps);

/// Time of one contact search over all bodies, of one row of the history and of one checkpoint, s.
struct SideCosts {
  double search = 0.0, history = 0.0, checkpoint = 0.0;
};
SideCosts side_costs(Running& scene);

/// Memory of model and state, bytes.
double bytes_held(const Running& scene);

}  // namespace voussoir
