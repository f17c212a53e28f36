// What docs/convergence.md claims of points, joint stiffness, time step and load rate, from the same computations.
#include <gtest/gtest.h>

#include <cmath>

#include "tests/solver/measured.h"
#include "tools/convergence/report.h"
#include "tools/convergence/specimens.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Whatever the rule, an elastic face is exact as long as it is wholly closed.
TEST(Convergence, BedIsExactWithinTheKernel) {
  for (int points : {3, 4, 5})
    for (double e : {0.05, 0.1, 0.16}) {
      const Bed exact = exact_bed(e), bed = computed_bed(e, points);
      EXPECT_NEAR(bed.turn, exact.turn, 1e-5 * exact.turn) << points << " points, e/b = " << e;
      EXPECT_NEAR(bed.sinking, exact.sinking, 1e-5 * exact.sinking) << points << " points, e/b = " << e;
    }
}

double largest_turn_error(int points, double until) {
  double largest = 0.0;
  for (double e = 0.17; e < until + 1e-9; e += 0.005)
    largest = std::max(largest, std::abs(computed_bed(e, points).turn / exact_bed(e).turn - 1.0));
  return largest;
}

/// While at least 0.6 of the face is closed. With less, no rule of five points or fewer is near the elastic face.
TEST(Convergence, PartlyOpenBedNeedsPoints) {
  const double three = largest_turn_error(3, 0.3), four = largest_turn_error(4, 0.3), five = largest_turn_error(5, 0.3);
  measured("partly open bed, e/b up to 0.3: largest error of the rotation, 3 points", 0.0, three, "-");
  measured("the same, 5 points", 0.0, five, "-");
  EXPECT_LT(three, 0.29);
  EXPECT_LT(four, 0.8 * three);
  EXPECT_LT(five, 0.7 * four);
}

/// μ p Σ w r over the nine points: four corners at √½ a with 1/36 each, four middles at ½ a with 4/36.
TEST(Convergence, TorsionSlidesAtTheSumOverThePoints) {
  const double exact = (std::sqrt(2.0) + std::asinh(1.0)) / 6.0, nine = (std::sqrt(0.5) + 2.0) / 9.0;
  const double three = torsion_capacity(3), five = torsion_capacity(5);
  measured("torsion of a square joint over the exact one, 3 points", nine / exact, three, "-");
  EXPECT_NEAR(three, nine / exact, 5e-4);
  EXPECT_NEAR(five, 1.0, 0.03);
}

/// The point joint's own closed form, first order in 1/kn; a face that were elastic everywhere would lose far more.
TEST(Convergence, SlabLosesWhatThePointsSay) {
  for (int points : {3, 4, 5}) {
    const double loss = slab_width / slab_height - slab_multiplier(1e10, points);
    measured("tipping slab, kn = 1e10: loss of the multiplier", slab_loss(1e10, points), loss, "-");
    EXPECT_NEAR(loss, slab_loss(1e10, points), 0.01 * slab_loss(1e10, points)) << points;
    EXPECT_LT(loss, slab_loss_of_an_elastic_face(1e10));
  }
}

TEST(Convergence, LeapfrogHasTheFrequencyItMustHave) {
  for (double share : {0.8, 0.2}) {
    const LetGo one = let_go(share);
    EXPECT_NEAR(one.frequency * one.dt, 2.0 * std::asin(0.5 * one.exact * one.dt), 1e-6);
  }
}

/// A stage that begins out of balance begins from rest: no half step lost or won.
TEST(Convergence, ABlockLetGoIsOfSecondOrder) {
  const LetGo coarse = let_go(0.2), fine = let_go(0.1);
  const double order =
      measured_order(coarse.displacement - coarse.expected, fine.displacement - fine.expected, coarse.dt, fine.dt);
  measured("block let go: order of the time step", 2.0, order, "-");
  EXPECT_GT(order, 1.9);
  EXPECT_LT(order, 2.1);
}

TEST(Convergence, TimeStepIsOfSecondOrder) {
  const PulseResponse reference = column_response(0.0125);
  double before = difference(column_response(0.4), reference);
  for (double share : {0.2, 0.1}) {
    const double error = difference(column_response(share), reference);
    const double order = measured_order(before, error, 2.0 * share, share);
    measured("bonded column: order of the time step", 2.0, order, "-");
    EXPECT_GT(order, 1.8);
    EXPECT_LT(order, 2.2);
    before = error;
  }
}

/// The clock of the study must not start at a sample before the block is raised.
TEST(Convergence, ABlockRocksInTheTimeOfARigidOne) {
  const double exact = exact_rocking_quarter(), quarter = rocking_quarter(1e10, true);
  measured("rocking block: quarter of a cycle", exact, quarter, "s");
  EXPECT_NEAR(quarter, exact, 1e-4 * exact);
}

/// A block that uplifts and lands: the balance still falls with the square, the motion at the coarse steps too.
TEST(Convergence, EnergyBalanceFallsWithTheStep) {
  const PulseResponse coarse = rocking_response(0.8), fine = rocking_response(0.2);
  EXPECT_LT(coarse.worst_balance, 0.01);
  EXPECT_LT(fine.worst_balance, coarse.worst_balance / 10.0);
}

TEST(Convergence, HalfASecondIsSlowEnoughForTheWall) {
  const double fast = push_wall(0.5, 0.7).peak, slow = push_wall(2.0, 0.7).peak;
  measured("dry wall pushed within 0.5 s against 2 s: largest reaction", slow, fast, "N");
  EXPECT_NEAR(fast, slow, 0.01 * slow);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
