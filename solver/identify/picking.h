// Selects modes from a stabilisation diagram.
#pragma once
#include "solver/identify/subspace.h"

namespace voussoir {

/// One mode at the orders at which it appears.
struct Cluster {
  std::vector<int> members;  // poles, ascending in order, one for each order
  int centre = 0;            // the member nearest to all others
  int hits = 0;              // number of members that are stable relative to the previous order
};

/// Marks a pole as stable if the nearest pole of the previous order differs by no more than the tolerances. Poles are
/// ascending in order.
void mark_stable(std::vector<Pole>& poles, double frequency_tolerance, double damping_tolerance,
                 double shape_tolerance);

/// Clusters of poles within `radius` (distance()) of the pole that has most such neighbours, one for each order, the
/// largest first. Poles below `lowest` (Hz) or with a damping ratio beyond ± `largest_damping` are ignored.
std::vector<Cluster> find_clusters(const std::vector<Pole>& poles, double lowest, double largest_damping, double radius,
                                   int least_members);

}  // namespace voussoir
