// The elastic stiffness of one joint on polygons of any number of corners and in any motion; square, triangle and
// hexagon are the rung of tools/ladder/joint_stiffness.cpp.
#include "tools/ladder/joint_stiffness.h"

#include "tests/solver/measured.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

TEST(JointStiffness, OfRandomPolygons) {
  std::mt19937 random(4);
  for (int corners = 3; corners <= 9; ++corners) {
    StiffnessErrors worst;
    for (int repeat = 0; repeat < 3; ++repeat) {
      const Polygon polygon = random_polygon(corners, random);
      for (bool shortcut : {true, false}) compare_stiffness(polygon, random, shortcut, worst);
    }
    EXPECT_LT(worst.force, 1e-12) << corners;
    EXPECT_LT(worst.moment, 2e-12) << corners;
    EXPECT_LT(worst.beside, 2e-12) << corners;
    EXPECT_LT(worst.any_force, 1e-7) << corners;
    EXPECT_LT(worst.any_moment, 1e-6) << corners;
    const std::string what =
        "Stiffness of a joint, three irregular polygons of " + std::to_string(corners) + " corners";
    measured(what + ": kn A, ks A", 0.0, worst.force, "relative");
    measured(what + ": kn I, ks J", 0.0, worst.moment, "relative");
  }
}

/// The wrench is the gradient of the stored energy at finite rotations, so that springs neither make nor destroy
/// energy: exactly when kn = ks, else up to (kn − ks) times the third order of turn and displacement, since the mean of
/// the two spins is not quite the spin of the half-way rotation. Turns and moves are below those at which a patch is
/// clipped anew.
void check_gradient(double shear, double tolerance) {
  std::mt19937 random(9);
  for (int repeat = 0; repeat < 10; ++repeat) {
    Assembly assembly = two_prisms(random_polygon(5, random), random_rotation(random), random_vector(1.0, random));
    assembly.joints[0].ks = shear;
    const Vec3 place = polygon_centroid(assembly.joints[0].polygon);
    Bench bench(std::move(assembly));
    const Eigen::Quaterniond common = random_rotation(random);
    bench.turn_about(0, place, common);
    bench.turn_about(1, place,
                     Eigen::Quaterniond(Eigen::AngleAxisd(0.04, random_vector(1.0, random).normalized())) * common);
    const Vec3 move = random_vector(0.02, random);
    for (int c = 0; c < 3; ++c) bench.pose(1)[c] += move[c];
    bench.stepper.patches_only();
    const Vec3 u = bench.displacement(1), centroid = bench.assembly.blocks[1].centroid + u;
    const Eigen::Quaterniond q = bench.rotation(1);
    const auto [force, moment] = bench.wrench_on(1, 0, centroid);
    const auto energy = [&](const Vec3& du, const Vec3& turn) {
      const Vec3 axis = turn.norm() > 0 ? Vec3(turn.normalized()) : Vec3(Vec3::UnitX());
      bench.place(1, u + du, (Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), axis)) * q).normalized());
      return patch_energy(bench.model, bench.state, Branches{}, 0).elastic;
    };
    const double h = 1e-5, arm = (place - bench.assembly.blocks[1].centroid).norm();
    for (int c = 0; c < 3; ++c) {
      const Vec3 e = h * Vec3::Unit(c);
      const double by_move = (energy(e, Vec3::Zero()) - energy(-e, Vec3::Zero())) / (2 * h);
      const double by_turn = (energy(Vec3::Zero(), e) - energy(Vec3::Zero(), -e)) / (2 * h);
      EXPECT_NEAR(force[c], -by_move, 1e-8 * force.norm());
      EXPECT_NEAR(moment[c], -by_turn, tolerance * (moment.norm() + force.norm() * arm));
    }
  }
}

TEST(JointStiffness, WrenchIsTheGradientOfTheEnergy) {
  check_gradient(prisms_kn, 1e-8);
  check_gradient(prisms_ks, 1e-3);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
