// Modes from a stabilisation diagram.
#pragma once
#include "solver/identify/subspace.h"

namespace voussoir {

/// One mode at the orders it appears at.
struct Cluster {
  std::vector<int> members;  // poles, ascending in order, one an order
  int centre = 0;            // the member nearest to all others
  int hits = 0;              // members that are stable against the order before
};

/// Marks each pole stable where the nearest one of the order before differs by no more than the tolerances. Poles are
/// ascending in order.
void mark_stable(std::vector<Pole>& poles, double frequency_tolerance, double damping_tolerance,
                 double shape_tolerance);

/// Clusters of poles within `radius` (distance()) of one that has most such neighbours, one an order, the fullest
/// first; poles below `lowest` (Hz) or with a damping beyond ± `largest_damping` are not looked at.
std::vector<Cluster> find_clusters(const std::vector<Pole>& poles, double lowest, double largest_damping, double radius,
                                   int least_members);

}  // namespace voussoir
