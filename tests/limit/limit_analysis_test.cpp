// Limit analysis by linear programming: closed forms, what it refuses, and its linear programs.
#include "tools/limit/limit_analysis.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <limits>

#include "solver/base/error.h"
#include "tools/ladder/hinge_mechanisms.h"
#include "tools/ladder/ring_strip.h"
#include "tools/limit/linear_program.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

using namespace ladder;
using namespace limit;

constexpr double infinite = std::numeric_limits<double>::infinity();

#define NEEDS_SOLVER() \
  if (!can_solve_linear_programs()) GTEST_SKIP() << "built without GLPK"

LimitProblem sideways() {
  LimitProblem problem;
  problem.acceleration = Vec3(9.81, 0.0, 0.0);
  return problem;
}

/// A cube of 1 m on a fixed slab, friction as given.
Assembly cube(double friction) {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, 0}, {1, 1, 1});
  add_box(assembly, {-2, 0, -1}, {3, 1, 0}, true);
  return joined(std::move(assembly), 1e9, 1e9, dry_law(friction));
}

TEST(LinearPrograms, HaveAVertexWithItsDuals) {
  NEEDS_SOLVER();
  LinearProgram lp;  // most 3 x + 2 y, x + y ≤ 4, x ≤ 3, x, y ≥ 0: (3, 1), 11; the first row is worth 2
  const int row = lp.add_row(-infinite, 4.0);
  const int x = lp.add_column(0.0, 3.0, 3.0), y = lp.add_column(0.0, infinite, 2.0);
  lp.add(row, x, 1.0), lp.add(row, y, 1.0);
  const LinearOptimum optimum = solve(lp);
  ASSERT_EQ(optimum.kind, LinearOptimum::Kind::found);
  EXPECT_NEAR(optimum.value, 11.0, 1e-12);
  EXPECT_NEAR(optimum.x[0], 3.0, 1e-12);
  EXPECT_NEAR(optimum.dual[0], 2.0, 1e-12);
}

TEST(LinearPrograms, SayWhatHasNoOptimum) {
  NEEDS_SOLVER();
  LinearProgram lp;
  const int row = lp.add_row(1.0, infinite);
  const int x = lp.add_column(0.0, infinite, 1.0);
  lp.add(row, x, 1.0);
  EXPECT_EQ(solve(lp).kind, LinearOptimum::Kind::unbounded);
  lp.columns[0][1] = 0.5;
  EXPECT_EQ(solve(lp).kind, LinearOptimum::Kind::infeasible);
}

TEST(LimitAnalysis, OfACubeThatSlidesOrTips) {
  NEEDS_SOLVER();
  const LimitAnalysis slides = limit_analysis(cube(0.4), sideways());
  EXPECT_NEAR(slides.multiplier, 0.4, 1e-9);
  ASSERT_EQ(slides.mechanism.size(), 1u);
  EXPECT_TRUE(slides.mechanism[0].slides());
  EXPECT_NEAR(slides.mechanism[0].opening[0], 0.4 * std::abs(slides.mechanism[0].slip),
              1e-12);                                           // associated flow lifts
  EXPECT_NEAR(slides.rates[0].x() * 9.81 * 2000.0, 1.0, 1e-9);  // the pattern's power
  const LimitAnalysis tips = limit_analysis(cube(2.0), sideways());
  EXPECT_NEAR(tips.multiplier, 1.0, 1e-9);
  ASSERT_EQ(tips.mechanism.size(), 1u);
  EXPECT_FALSE(tips.mechanism[0].slides());
  EXPECT_NEAR(std::abs(tips.forces[0].lever), 0.5, 1e-9);  // on its edge
  EXPECT_NEAR(tips.forces[0].normal, 9.81 * 2000.0, 1e-6);
}

/// A force on the top that pulls at an angle: statics gives μ (W − F sin a) = F cos a.
TEST(LimitAnalysis, OfACubeUnderAForce) {
  NEEDS_SOLVER();
  const Assembly assembly = cube(0.3);
  LimitProblem problem;
  problem.loads = {{0, {3000.0, 0.0, 1000.0}, {0.5, 0.5, 0.2}}};
  EXPECT_NEAR(limit_analysis(assembly, problem).multiplier, 0.3 * 9.81 * 2000.0 / (3000.0 + 0.3 * 1000.0), 1e-9);
  Assembly glued = assembly;
  glued.laws[0].residual_cohesion = 1000.0;
  EXPECT_NEAR(limit_analysis(glued, problem).multiplier, (0.3 * 9.81 * 2000.0 + 1000.0) / (3000.0 + 0.3 * 1000.0),
              1e-9);
}

TEST(LimitAnalysis, OfArchesIsThatOfTheirFourHingeMechanisms) {
  NEEDS_SOLVER();
  for (const double ratio : {0.12, 0.2})
    for (const double embrace : {120.0, 180.0}) {
      Assembly assembly = generated(
          "arch", {{"mean_radius", 5.0}, {"thickness_ratio", ratio}, {"embrace_angle", embrace}, {"voussoirs", 15}});
      set_law(assembly, dry_law(6.0));
      const ArchLine line = arch_line(assembly, Vec3(9.81, 0.0, 0.0));
      const double expected = four_hinge_multiplier(line.intrados, line.extrados, line.loads);
      const LimitAnalysis a = limit_analysis(assembly, sideways());
      EXPECT_NEAR(a.multiplier, expected, 1e-7 * expected);
      EXPECT_EQ(a.mechanism.size(), 4u) << mechanism_text(a);
    }
}

TEST(LimitAnalysis, TellsWhatDoesNotStandAndWhatNothingLimits) {
  NEEDS_SOLVER();
  Assembly thin = generated("arch", {{"mean_radius", 5.0}, {"thickness_ratio", 0.1}, {"embrace_angle", 180.0}});
  set_law(thin, dry_law(6.0));
  EXPECT_FALSE(limit_analysis(thin, {}).stands);
  LimitProblem down;
  down.acceleration = Vec3(0.0, 0.0, -9.81);
  const LimitAnalysis a = limit_analysis(cube(0.4), down);
  EXPECT_TRUE(a.stands);
  EXPECT_FALSE(a.limited);
}

/// Prints the table of docs/theory/limit-analysis.md.
TEST(LimitAnalysis, OfRingsDependsOnWhatJoinsThem) {
  NEEDS_SOLVER();
  const auto multiplier = [](const char* what, const RingStrip& strip) {
    const Assembly assembly = ring_strip(strip);
    const StripLoad load = load_on(assembly, strip);
    LimitProblem problem;
    problem.loads = {{load.block, load.force, load.at}};
    const LimitAnalysis lifts = limit_analysis(assembly, problem);
    const LimitAnalysis plain = limit_analysis_without_lift(assembly, problem);
    EXPECT_LT(lifts.excess, 1e-7);
    EXPECT_LT(plain.excess, 0.05);
    EXPECT_LT(plain.multiplier, 1.002 * lifts.multiplier);
    fmt::print("{} courses, {}: {:.4f} ({}); without lift {:.4f} ({}), {} programs, excess {:.1e}\n", strip.voussoirs,
               what, lifts.multiplier, mechanism_text(lifts), plain.multiplier, mechanism_text(plain), plain.iterations,
               plain.excess);
    return lifts.multiplier;
  };
  for (const int courses : {20, 40}) {
    RingStrip strip = {.rings = {0.33}, .voussoirs = courses};
    const double one = multiplier("one ring", strip);
    strip.rings = {0.11, 0.11, 0.11};
    const double three = multiplier("three rings", strip);
    strip.rings = {0.165, 0.165};
    const double two = multiplier("two rings", strip);
    strip.headers_every = 10;
    const double tied = multiplier("two rings, headers every 10 courses", strip);
    strip.headers_every = 0, strip.ring_friction = 0.02;
    const double slippery = multiplier("two rings, friction 0.02 between", strip);
    EXPECT_LT(three, 0.8 * two);
    EXPECT_LT(slippery, two);
    EXPECT_LT(two, 0.8 * tied);
    EXPECT_LT(tied, one);
  }
}

TEST(LimitAnalysis, WithoutLiftBearsAtMostWhatFlowThatLiftsDoes) {
  NEEDS_SOLVER();
  const RingStrip strip = {.rings = {0.165, 0.165}, .voussoirs = 20};
  const Assembly assembly = ring_strip(strip);
  const StripLoad load = load_on(assembly, strip);
  LimitProblem problem;
  problem.loads = {{load.block, load.force, load.at}};
  const LimitAnalysis lifts = limit_analysis(assembly, problem), plain = limit_analysis_without_lift(assembly, problem);
  EXPECT_LE(plain.multiplier, lifts.multiplier * (1.0 + 1e-3));
  EXPECT_GT(plain.multiplier, 0.8 * lifts.multiplier);
  EXPECT_GT(plain.iterations, 1);
  EXPECT_LT(plain.excess, 0.05);
  // What only slides, slides at its friction under either flow.
  EXPECT_NEAR(limit_analysis_without_lift(cube(0.4), sideways()).multiplier, 0.4, 1e-3 * 0.4);
}

TEST(LimitAnalysis, RefusesWhatIsNotPlaneOrNotOfBlocks) {
  Assembly elastic = cube(0.4);
  elastic.laws[0] = elastic_law();
  EXPECT_THROW(limit_analysis(elastic, {}), InputError);
  Assembly across = stone();
  add_box(across, {0, 0, 0}, {1, 1, 1}), add_box(across, {0, 1, 0}, {1, 2, 1}, true);
  across = joined(std::move(across), 1e9, 1e9, dry_law(0.4));
  EXPECT_THROW(limit_analysis(across, {}), InputError);
  LimitProblem stray;
  stray.loads = {{7, {1.0, 0.0, 0.0}, {0.0, 0.0, 0.0}}};
  EXPECT_THROW(limit_analysis(cube(0.4), stray), InputError);
  Assembly loose = stone();
  add_box(loose, {0, 0, 0}, {1, 1, 1});
  finish_blocks(loose);
  EXPECT_THROW(limit_analysis(loose, {}), InputError);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
