// The symmetric matrix of blocks, against the same one dense.
#include "solver/linear/block_matrix.h"

#include <gtest/gtest.h>

#include "tests/solver/block_numbers.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

constexpr std::int32_t sites = 5;

/// Pairs in either order; site 3 has none.
BlockMatrix some_blocks() {
  const std::vector<std::pair<std::int32_t, std::int32_t>> pairs = {{1, 0}, {0, 2}, {4, 2}, {1, 4}, {0, 1}};
  BlockMatrix k(sites, pairs);
  for (std::int32_t site = 0; site < sites; ++site) {
    const Matrix6 m = numbers(site, site);
    k.add(site, site, m + m.transpose());
  }
  for (const auto& [row, column] : pairs) k.add(row, column, numbers(row, column));
  return k;
}

Eigen::MatrixXd dense(const BlockMatrix& k) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(6 * sites, 6 * sites);
  k.for_each([&](std::int32_t row, std::int32_t column, const Matrix6& block) {
    all.block<6, 6>(6 * row, 6 * column) = block;
    all.block<6, 6>(6 * column, 6 * row) = block.transpose();
  });
  return all;
}

void expect_times(const BlockMatrix& k, const Eigen::MatrixXd& all) {
  Eigen::VectorXd x(6 * sites), y = Eigen::VectorXd::Constant(6 * sites, 9.0);
  for (Eigen::Index i = 0; i < x.size(); ++i) x[i] = std::cos(double(i * i));
  const double product = k.times(x, y);
  EXPECT_LT((y - all * x).norm(), 1e-14 * all.norm() * x.norm());
  EXPECT_NEAR(product, x.dot(all * x), 1e-14 * all.norm() * x.squaredNorm());
}

TEST(BlockMatrix, TimesAVector) {
  const BlockMatrix k = some_blocks();
  const Eigen::MatrixXd all = dense(k);
  EXPECT_EQ((all.block<6, 6>(6, 0)), (numbers(1, 0) + numbers(0, 1).transpose()));
  expect_times(k, all);
}

TEST(BlockMatrix, HoldsWhatIsNoUnknown) {
  BlockMatrix k = some_blocks();
  Eigen::MatrixXd all = dense(k);
  Unknowns unknowns;
  for (std::int32_t site = 0; site < sites; ++site) {
    auto& of = unknowns.of.emplace_back();
    for (std::size_t c = 0; c < 6; ++c) {
      const bool held = site == 2 || (site == 1 && c % 2 == 0);
      of[c] = held ? -1 : unknowns.count++;
      const Eigen::Index at = 6 * site + Eigen::Index(c);
      if (!held) continue;
      all.row(at).setZero(), all.col(at).setZero();
      all(at, at) = 1.0;
    }
  }
  const Eigen::MatrixXd over = k.over(unknowns);
  k.hold(unknowns);
  EXPECT_EQ(dense(k), all);
  expect_times(k, all);
  EXPECT_EQ(Eigen::MatrixXd(k.over(unknowns)), over);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
