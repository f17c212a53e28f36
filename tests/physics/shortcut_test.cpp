// A whole wall moves alike with and without the shortcut (single joints: tools/ladder/intact_shortcut.cpp).
#include "solver/step/energy.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Maxwell branches are kept in single precision, rounded otherwise on the two paths: of the largest displacement, and
/// of what is lost. (The motion dies down to a twentieth, the rounding stays what it is.)
constexpr double agreement = 3e-8, same_loss = 1e-7;

/// Histories agree until rounding is amplified by sliding joints.
TEST(Shortcut, SameMotionOfAnElasticWall) {
  JointLaw law = weak_bond();
  law.tension = law.cohesion = 1e7;
  std::vector<Vec3> top[2];
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
    for (int i = 0; i < 30; ++i) {
      ASSERT_TRUE(bench.run(100));
      top[shortcut].push_back(bench.displacement(bench.assembly.groups.at("top")[0]) - bench.state.base_displacement());
    }
    bench.stepper.patches_only();
    damping_loss[shortcut] = compute_energies(bench.stepper, bench.stepper.body_pass()).joint_damping;
  }
  double largest = 0.0;
  for (const Vec3& u : top[0]) largest = std::max(largest, u.norm());
  for (std::size_t i = 0; i < top[0].size(); ++i) EXPECT_LT((top[0][i] - top[1][i]).norm(), agreement * largest) << i;
  EXPECT_NEAR(damping_loss[0], damping_loss[1], same_loss * damping_loss[0]);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
