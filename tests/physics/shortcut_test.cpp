// A whole wall moves alike with and without the shortcut (single joints: tools/ladder/intact_shortcut.cpp).
#include "solver/step/energy.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace {

/// Maxwell branches are kept in single precision, rounded otherwise on the two paths.
constexpr double agreement = 1e-7;

/// Histories agree until rounding is amplified by sliding joints.
TEST(Shortcut, SameMotionOfAnElasticWall) {
  JointLaw law = weak_bond();
  law.tension = law.cohesion = 1e7;
  Vec3 top[2];
  double damping_loss[2];
  for (bool shortcut : {true, false}) {
    Assembly assembly = generated("wall", {{"length_blocks", 3}, {"courses", 4}});
    set_law(assembly, law);
    SolverSettings settings = undamped({0, 0, -9.81});
    settings.damping.kind = DampingSettings::Kind::maxwell;
    settings.step.intact_shortcut = shortcut;
    Bench bench(std::move(assembly), settings);
    bench.begin();
    GroundMotion motion;
    motion.dt = 0.05;
    motion.acceleration = {{0, 0, 0}, {2, 3, 0}, {-4, 1, 1}, {1, -2, 0}, {0, 0, 0}};
    bench.stepper.motion = &motion;
    ASSERT_TRUE(bench.run(3000));
    top[shortcut] = bench.displacement(bench.assembly.groups.at("top")[0]) - bench.state.base_displacement();
    bench.stepper.patches_only();
    damping_loss[shortcut] = compute_energies(bench.stepper, bench.stepper.body_pass()).joint_damping;
  }
  EXPECT_LT((top[0] - top[1]).norm(), agreement * top[0].norm());
  EXPECT_NEAR(damping_loss[0], damping_loss[1], agreement * damping_loss[0]);
}

}  // namespace
}  // namespace voussoir::test
