// Selection of ground motions: known answers, bounds, limits.
#include "solver/motion/select.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/base/error.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

/// Records whose spectra over the target are these rows' columns.
SelectionProblem problem(const Eigen::MatrixXd& ratios, std::size_t count) {
  SelectionProblem p;
  p.ratios = ratios;
  for (Eigen::Index i = 0; i < ratios.cols(); ++i) p.events.push_back(int(i));
  p.count = count;
  return p;
}

TEST(Select, FactorsOfARecordAreItsMirror) {
  // One record of constant ratio 0.5: score (0.5 f − 1)² + w (f − 1)², least at f = (0.5 + w)/(0.25 + w).
  SelectionProblem p = problem(Eigen::MatrixXd::Constant(5, 1, 0.5), 1);
  const Selection s = select_records(p);
  ASSERT_TRUE(s.found);
  EXPECT_NEAR(s.factors[0], 0.51 / 0.26, 1e-4);
  p.low = 0.995;  // now the bound presses: 0.5 f = 0.995
  EXPECT_NEAR(select_records(p).factors[0], 1.99, 1e-4);
}

TEST(Select, TwoThatFillEachOthersGaps) {
  // Columns 1 and 3 add up to the target; each alone, and every other pair, cannot.
  Eigen::MatrixXd ratios(4, 5);
  ratios << 1.0, 2.0, 1.5, 0.0, 0.2,  //
      1.0, 2.0, 0.5, 0.0, 3.0,        //
      0.2, 0.0, 1.5, 2.0, 0.1,        //
      1.0, 0.0, 0.2, 2.0, 0.1;
  const Selection s = select_records(problem(ratios, 2));
  ASSERT_TRUE(s.found);
  EXPECT_EQ(s.records, (std::vector<std::size_t>{1, 3}));
  EXPECT_TRUE(s.all_tried);
  EXPECT_EQ(s.tried, 10.0);
  for (const double m : s.mean) EXPECT_NEAR(m, 1.0, 1e-3);
}

/// Many rough spectra.
Eigen::MatrixXd rough(int records, double size) {
  Eigen::MatrixXd ratios(40, records);
  for (int r = 0; r < records; ++r)
    for (int k = 0; k < 40; ++k)
      ratios(k, r) = size * std::exp(0.7 * std::sin(0.37 * r * r + 0.05 * k * (1 + r % 7)) + 0.3 * std::cos(k * r));
  return ratios;
}

TEST(Select, BoundsAndLimitsHold) {
  SelectionProblem p = problem(rough(14, 0.5), 5);
  for (std::size_t i = 0; i < p.events.size(); ++i) p.events[i] = int(i / 5);
  p.per_event = 2, p.low = 0.7, p.high = 1.6, p.least = 0.5, p.most = 2.5;
  const Selection s = select_records(p);
  ASSERT_TRUE(s.found);
  EXPECT_EQ(s.records.size(), 5u);
  int taken[3] = {};
  for (const std::size_t r : s.records) EXPECT_LE(++taken[p.events[r]], 2);
  for (const double m : s.mean) EXPECT_TRUE(m >= 0.7 && m <= 1.6) << m;
  for (const double f : s.factors) EXPECT_TRUE(f >= 0.5 - 1e-6 && f <= 2.5 + 1e-6) << f;
  // 5 of 5 + 5 + 4 with at most two each: 2 + 2 + 1 three ways round.
  EXPECT_EQ(s.tried, 10.0 * 10.0 * 4.0 + 10.0 * 6.0 * 5.0 + 10.0 * 6.0 * 5.0);
}

TEST(Select, ExchangesFindWhatTryingAllFinds) {
  SelectionProblem p = problem(rough(16, 0.8), 4);
  p.low = 0.6, p.high = 1.8;
  const Selection all = select_records(p);
  p.tries = 1500;  // of 1820
  const Selection some = select_records(p);
  EXPECT_TRUE(all.all_tried);
  EXPECT_FALSE(some.all_tried);
  EXPECT_EQ(all.records, some.records);
}

TEST(Select, WithoutASolutionTheClosestIsShown) {
  Eigen::MatrixXd ratios = Eigen::MatrixXd::Constant(4, 3, 1.0);
  ratios.row(2).setConstant(0.1);  // a hole that no factor fills
  const Selection s = select_records(problem(ratios, 2));
  EXPECT_FALSE(s.found);
  EXPECT_EQ(s.records.size(), 2u);
  EXPECT_EQ(s.mean.size(), 4u);
}

TEST(Select, ContradictionsAreRefused) {
  SelectionProblem p = problem(Eigen::MatrixXd::Ones(3, 3), 2);
  p.events = {0, 0, 0}, p.per_event = 1;
  EXPECT_THROW(select_records(p), InputError);
  p.per_event = 2, p.low = 1.2;
  EXPECT_THROW(select_records(p), InputError);
  p.low = 0.9, p.least = 2.0, p.most = 1.0;
  EXPECT_THROW(select_records(p), InputError);
  p.least = 0.5, p.count = 4;
  EXPECT_THROW(select_records(p), InputError);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
