#include "solver/linear/loose.h"

#include <Eigen/Dense>

#include "solver/base/disjoint_sets.h"
#include "solver/linear/dense_eigen.h"

namespace voussoir {

namespace {

/// Components that are unknowns of a site.
std::vector<int> ways(const Unknowns& unknowns, std::size_t site) {
  std::vector<int> free;
  for (int c = 0; c < 6; ++c)
    if (unknowns.of[site][c] >= 0) free.push_back(c);
  return free;
}

/// Connected parts by union of the sites that a non-zero block couples; what has a prescribed component is one part
/// with the ground (the last label).
std::vector<std::int32_t> connected_parts(const BlockMatrix& k, const Unknowns& unknowns) {
  DisjointSets sets(k.sites() + 1);
  for (std::size_t site = 0; site < k.sites(); ++site)
    if (ways(unknowns, site).size() < unknowns.ways(site)) sets.join(site, k.sites());
  k.for_each([&](std::int32_t row, std::int32_t column, const Matrix6& block) {
    if (row != column && !block.isZero(0.0)) sets.join(std::size_t(row), std::size_t(column));
  });
  std::vector<std::int32_t> part;
  for (std::size_t i = 0; i <= k.sites(); ++i) part.push_back(std::int32_t(sets.of(i)));
  return part;
}

/// Eigenvalues (rad2/s2) and M-normalised motions of a site while all others stand still.
struct OwnModes {
  std::vector<int> free;
  Eigen::VectorXd values;
  Eigen::MatrixXd motions, mass;
};
OwnModes own_modes(const BlockMatrix& k, const BlockMatrix& m, const Unknowns& unknowns, std::size_t site) {
  OwnModes own;
  own.free = ways(unknowns, site);
  const Eigen::MatrixXd stiffness = k.diagonal(std::int32_t(site))(own.free, own.free);
  own.mass = m.diagonal(std::int32_t(site))(own.free, own.free);
  const EigenSolution<Eigen::MatrixXd> solution = eigen_solution(stiffness, own.mass);
  own.values = solution.values;
  own.motions = solution.vectors;
  return own;
}

constexpr double nothing = 1e-10;  // share of a site's largest own eigenvalue that counts as no stiffness

}  // namespace

Loose find_loose(const BlockMatrix& k, const BlockMatrix& m, const Unknowns& unknowns) {
  const std::vector<std::int32_t> part = connected_parts(k, unknowns);
  const std::int32_t ground = part.back();
  std::vector<double> mass(k.sites() + 1, 0.0);
  bool tied = false;
  for (std::size_t site = 0; site < k.sites(); ++site) {
    if (!unknowns.any(site)) continue;
    tied = tied || part[site] == ground;
    mass[std::size_t(part[site])] += m.diagonal(std::int32_t(site))(0, 0);
  }
  const auto stands = tied ? ground : std::int32_t(std::max_element(mass.begin(), mass.end() - 1) - mass.begin());
  Loose loose;
  loose.adrift.assign(k.sites(), false);
  for (std::size_t site = 0; site < k.sites(); ++site) {
    if (!unknowns.any(site)) continue;
    loose.adrift[site] = part[site] != stands;
    if (loose.adrift[site]) {
      loose.bodies.push_back(std::int32_t(site));
      continue;
    }
    const OwnModes own = own_modes(k, m, unknowns, site);
    const double most = own.values[own.values.size() - 1];
    if (most > 0.0 && own.values[0] < nothing * most) loose.partly.push_back(std::int32_t(site));
  }
  return loose;
}

int hold_free_ways(BlockMatrix& k, const BlockMatrix& m, const Unknowns& unknowns, const Loose& loose) {
  double firm = 0.0;
  for (std::size_t site = 0; site < k.sites(); ++site)
    for (int c : ways(unknowns, site))
      firm = std::max(firm, k.diagonal(std::int32_t(site))(c, c) / m.diagonal(std::int32_t(site))(c, c));
  firm *= 12.0;  // above every eigenvalue: none is more than twice the largest of a site's own, six times a diagonal's
  int held = 0;
  for (std::int32_t site : loose.partly) {
    const OwnModes own = own_modes(k, m, unknowns, std::size_t(site));
    for (Eigen::Index i = 0; i < own.values.size(); ++i) {
      if (own.values[i] >= nothing * own.values[own.values.size() - 1]) break;
      ++held;
      const Eigen::VectorXd mv = own.mass * own.motions.col(i);
      for (std::size_t r = 0; r < own.free.size(); ++r)
        for (std::size_t c = 0; c < own.free.size(); ++c)
          k.diagonal(site)(own.free[r], own.free[c]) += firm * mv[Eigen::Index(r)] * mv[Eigen::Index(c)];
    }
  }
  return held;
}

}  // namespace voussoir
