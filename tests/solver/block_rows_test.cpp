// Rows of blocks and their products, against the same matrices dense.
#include "solver/linear/block_rows.h"

#include <gtest/gtest.h>

#include "solver/base/subnormals.h"
#include "solver/linear/single_rows.h"
#include "tests/solver/block_numbers.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Site 3 has no pair.
BlockMatrix symmetric_blocks() {
  BlockMatrix k(5, {{1, 0}, {0, 2}, {4, 2}, {1, 4}});
  k.change_each([](std::int32_t row, std::int32_t column, Matrix6& block) {
    block = numbers(row, column);
    if (row == column) block += numbers(row, column).transpose();
  });
  return k;
}

/// Rows with two columns, one and none.
BlockRows prolongation() {
  BlockRows p;
  p.first = {0, 2, 3, 5, 5, 6}, p.column = {0, 1, 0, 0, 1, 1};
  for (std::int32_t at = 0; at < 6; ++at) p.block.push_back(numbers(at, 9));
  return p;
}

Eigen::MatrixXd dense(const BlockRows& m, std::size_t columns) {
  Eigen::MatrixXd all = Eigen::MatrixXd::Zero(Eigen::Index(6 * m.rows()), Eigen::Index(6 * columns));
  for (std::size_t row = 0; row < m.rows(); ++row)
    each_of(m, row, [&](std::size_t at) { all.block<6, 6>(Eigen::Index(6 * row), 6 * m.column[at]) = m.block[at]; });
  return all;
}

void expect_columns_ascend(const BlockRows& m) {
  for (std::size_t row = 0; row < m.rows(); ++row)
    each_of(m, row, [&](std::size_t at) {
      if (at > std::size_t(m.first[row])) {
        EXPECT_LT(m.column[at - 1], m.column[at]) << row;
      }
    });
}

TEST(BlockRows, HaveBothOfEachPair) {
  const BlockMatrix k = symmetric_blocks();
  const BlockRows rows = rows_of(k);
  expect_columns_ascend(rows);
  const Eigen::MatrixXd all = dense(rows, 5);
  EXPECT_EQ((all - all.transpose()).norm(), 0.0);
  k.for_each([&](std::int32_t row, std::int32_t column, const Matrix6& block) {
    EXPECT_EQ((all.block<6, 6>(6 * row, 6 * column)), block) << row << ' ' << column;
  });
  EXPECT_EQ(rows.block.size(), 5u + 2 * 4u);
}

/// Or the ground, which a wide base stands on, would couple all coarse sites along it with each other.
TEST(BlockRows, HaveNothingBesideWhatIsHeld) {
  BlockMatrix k = symmetric_blocks();
  Unknowns unknowns;
  for (std::int32_t site = 0; site < 5; ++site)
    unknowns.of.push_back(site == 2 ? std::array<std::int32_t, 6>{-1, -1, -1, -1, -1, -1}
                                    : std::array<std::int32_t, 6>{0, 1, 2, 3, 4, 5});
  k.hold(unknowns);
  const BlockRows rows = rows_of(k);
  EXPECT_EQ(rows.block.size(), 5u + 2 * 2u);
  EXPECT_EQ(rows.first[3] - rows.first[2], 1);
  EXPECT_EQ(rows.block[std::size_t(rows.first[2])], Matrix6(Matrix6::Identity()));
}

TEST(BlockRows, CoarseOnesAreTheProduct) {
  const BlockRows a = rows_of(symmetric_blocks()), p = prolongation(), coarse = coarse_rows(a, p, 3);
  expect_columns_ascend(coarse);
  const Eigen::MatrixXd wide = dense(p, 3), product = wide.transpose() * dense(a, 5) * wide;
  ASSERT_EQ(coarse.rows(), 3u) << "the last has nothing";
  EXPECT_LT((dense(coarse, 3) - product).norm(), 1e-13 * product.norm());
}

/// A row, and what the same row gives to its columns, in single precision.
TEST(BlockRows, InSingles) {
  const BlockRows p = prolongation();
  const SingleRows singles = in_singles(p);
  const std::size_t n = p.rows();
  Eigen::VectorXf x = Eigen::VectorXf::Zero(2 * site_width), to = Eigen::VectorXf::Zero(2 * site_width),
                  from(Eigen::Index(site_width * n));
  Eigen::VectorXd exact_x(12), exact_from(Eigen::Index(6 * n));
  for (Eigen::Index i = 0; i < 12; ++i) x[8 * (i / 6) + i % 6] = float(exact_x[i] = std::cos(0.1 + double(i)));
  for (Eigen::Index i = 0; i < exact_from.size(); ++i)
    from[8 * (i / 6) + i % 6] = float(exact_from[i] = std::cos(5.1 + double(i)));
  const Eigen::VectorXd exact = dense(p, 2) * exact_x, exact_to = dense(p, 2).transpose() * exact_from;
  for (std::size_t row = 0; row < n; ++row) {
    const Eight forwards = times(singles, row, x.data()), backwards = times_backwards(singles, row, x.data());
    for (int c = 0; c < 6; ++c) {
      EXPECT_NEAR(forwards[c], exact[Eigen::Index(6 * row) + c], 3e-6) << row << ' ' << c;
      EXPECT_NEAR(backwards[c], exact[Eigen::Index(6 * row) + c], 3e-6) << row << ' ' << c;
    }
    EXPECT_EQ(forwards[6], 0.0f);
    EXPECT_EQ(backwards[7], 0.0f);
    add_transposed(singles, row, from.data() + site_width * row, to.data());
  }
  for (Eigen::Index i = 0; i < 12; ++i) EXPECT_NEAR(to[8 * (i / 6) + i % 6], exact_to[i], 3e-6) << i;
}

TEST(NoSubnormals, CountAsZeroWhileItIsThere) {
  volatile float small = 1e-30f, smaller = 1e-10f;
  {
    const NoSubnormals none;
#if defined(__SSE2__)
    EXPECT_EQ(small * smaller, 0.0f);
#endif
  }
  EXPECT_GT(small * smaller, 0.0f);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
