// Uniform pressure through faces that do not match: every patch must carry the same stress.
#include "tests/solver/measured.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace {

/// The part of the box 0 … 1 × 0 … 1 × low … high on one side of the plane a x + b y = c.
Polyhedron part_of_box(double low, double high, double a, double b, double c, double sign) {
  const double norm = std::hypot(a, b);
  const Plane plane{sign * Vec3(a, b, 0.0) / norm, sign * c / norm};
  return cut(make_box({0, 0, low}, {1, 1, high}), plane);
}

/// A fixed slab under two courses that are cut along lines which cross: patches are triangles, quadrilaterals,
/// pentagons.
Assembly crossing_courses() {
  Assembly assembly = stone(2000.0);
  add_box(assembly, {0, 0, -0.5}, {1, 1, 0}, true);
  for (double sign : {1.0, -1.0}) add_block(assembly, part_of_box(0.0, 0.5, 1.0, 0.31, 0.57, sign));
  for (double sign : {1.0, -1.0}) add_block(assembly, part_of_box(0.5, 0.8, -0.4, 1.0, 0.37, sign));
  return joined(std::move(assembly), 3e9, 1.2e9, elastic_law());
}

TEST(PatchTest, UniformPressureIsUniformStress) {
  for (int per_side : {3, 4, 5})
    for (bool shortcut : {true, false}) {
      SolverSettings settings = undamped({0, 0, -9.81});
      settings.contact.points_per_side = per_side;
      settings.step.intact_shortcut = shortcut;
      Bench bench(crossing_courses(), settings);
      ASSERT_TRUE(bench.balance(1e-12).converged);
      bench.stepper.patches_only();
      int horizontal = 0;
      double worst = 0.0;
      for (std::size_t i = 0; i < bench.model.joints.size(); ++i) {
        const Joint& joint = bench.assembly.joints[std::size_t(bench.model.joint_of_patch[i])];
        const Patch& patch = bench.model.joints[i];
        const Vec3 place(patch.place[0], patch.place[1], patch.place[2]);
        if (std::abs(joint.normal.z()) < 0.5) {  // between the parts of a course: nothing
          EXPECT_LT(bench.wrench_on(joint.a, i, place).first.norm(), 1e-9 * 2000 * 9.81);
          continue;
        }
        // Stress: density × g × height above; each point of the patch carries it.
        const double stress = -2000 * 9.81 * (place.z() > 0.25 ? 0.3 : 0.8);
        const Jump<double> j = patch_jump(patch, bench.pose(joint.a), bench.pose(joint.b));
        const Mat3 axes = Eigen::Quaterniond(patch.e_a[0], patch.e_a[1], patch.e_a[2], patch.e_a[3]).toRotationMatrix();
        for (const Vec3& corner : joint.polygon) {
          const Vec3 local = axes.transpose() * (corner - place);
          const double sigma = patch.kn * point_jump(patch, j, local.y(), local.z()).x;
          EXPECT_NEAR(sigma, stress, 1e-9 * std::abs(stress));
          worst = std::max(worst, std::abs(sigma / stress - 1.0));
        }
        const auto [force, moment] = bench.wrench_on(joint.b, i, place);
        const double up = patch.b == bench.body(joint.b) && joint.normal.z() > 0 ? 1.0 : -1.0;
        EXPECT_NEAR(force.z(), -up * stress * joint.area, 1e-9 * std::abs(stress));
        EXPECT_LT(moment.norm(), 1e-9 * std::abs(stress));
        ++horizontal;
      }
      EXPECT_EQ(horizontal, 6);  // two on the slab, four where the lines cross
      measured("Uniform pressure, " + std::to_string(per_side) + " points a side, " +
                   (shortcut ? "shortcut" : "point by point") + ": largest difference of stress",
               0.0, worst, "of the stress");
    }
}

}  // namespace
}  // namespace voussoir::test
