// Collapse loads of strips of one ring and of two against limit analysis by linear programming. The rung `rings` has
// stiffer joints and the cases that take longer.
#include <gtest/gtest.h>

#include "tools/ladder/ring_strip.h"
#include "tools/limit/limit_analysis.h"
#include "tools/limit/linear_program.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// What the program finds over what the linear program of the same blocks gives.
double share_of_limit(const ladder::RingStrip& strip) {
  const Assembly assembly = ladder::ring_strip(strip);
  const ladder::StripLoad load = ladder::load_on(assembly, strip);
  limit::LimitProblem problem;
  problem.loads = {{load.block, load.force, load.at}};
  const double expected = limit::limit_analysis(assembly, problem).multiplier;
  return ladder::collapse_multiplier(assembly, load, expected, 1) / expected;
}

/// No equilibrium can bear more than the static theorem allows; elastic joints and friction that does not lift bear
/// a little less.
TEST(Rings, BearWhatLimitAnalysisAllows) {
  if (!limit::can_solve_linear_programs()) GTEST_SKIP() << "built without GLPK";
  const double one = share_of_limit({.rings = {0.33}, .voussoirs = 20});
  EXPECT_LT(one, 1.005);
  EXPECT_GT(one, 0.98);
  const double two = share_of_limit({.rings = {0.165, 0.165}, .voussoirs = 10, .stiffness = 1e11});
  EXPECT_LT(two, 1.005);
  EXPECT_GT(two, 0.9);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
