// A step taken apart: what each phase costs, moves and computes, beside what the machine could do at best.
#pragma once
#include <string>
#include <vector>

#include "tools/bench/scenes.h"

namespace voussoir {

/// What one item of a phase reads and writes (bytes) and computes (additions and multiplications; a division or a root
/// counts as one), counted from the layout of the data and from the source.
struct Work {
  double bytes = 0.0, operations = 0.0;
};
/// A joint on the intact path, with so many damping branches.
Work intact_work(int branches);
/// A joint that goes point by point: `points` points, from tables or of a rectangle.
Work points_work(int branches, double points, bool rectangle);
/// A tetrahedron's first round (volumes) and its second (stresses), with `flowed` the share whose plastic memory is
/// read; a node of the fill with so many sums.
Work volume_work(double flowed);
Work stress_work(int branches, double flowed);
Work node_work(double sums);
/// A free body whose wrenches lie in `sums` places.
Work body_work(double sums);

struct Phase {
  std::string name;
  double items = 0.0;    // a step
  double seconds = 0.0;  // a step
  Work work;             // a step; zero where nothing was counted
};

/// The phases of a step, timed tile by tile over `steps` further steps on one thread. What intact and point-wise joints
/// and contacts take is told apart by least squares over the tiles.
std::vector<Phase> step_phases(Running& scene, std::int64_t steps);

/// One contact search over all bodies, one row of the history, one checkpoint: seconds each.
struct SideCosts {
  double search = 0.0, history = 0.0, checkpoint = 0.0;
};
SideCosts side_costs(Running& scene);

/// Memory that model and state hold, bytes.
double bytes_held(const Running& scene);

}  // namespace voussoir
