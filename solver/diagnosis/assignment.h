// One-to-one assignment with the least total cost.
#pragma once
#include <Eigen/Dense>
#include <vector>

namespace voussoir {

/// Returns the column of each row, or −1 for the remaining rows if there are more rows than columns. The method is the
/// Hungarian method with shortest augmenting paths (Jonker and Volgenant 1987), O(rows² columns). Costs are finite.
std::vector<int> least_cost_assignment(const Eigen::MatrixXd& cost);

}  // namespace voussoir
