// One-to-one assignment of least total cost.
#pragma once
#include <Eigen/Dense>
#include <vector>

namespace voussoir {

/// For each row its column, −1 for rows left over where there are more rows than columns. The Hungarian method by
/// shortest augmenting paths (Jonker and Volgenant 1987), O(rows² columns). Costs are finite.
std::vector<int> least_cost_assignment(const Eigen::MatrixXd& cost);

}  // namespace voussoir
