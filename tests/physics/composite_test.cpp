// Joints of the composite law: on the intact path and point by point, in the ledger, in Newton's method, and crushed at
// the edge of an eccentrically loaded block.
#include "solver/contact/patch_energy.h"
#include "solver/linear/stiffness.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

constexpr double kn = 1e10, ks = 4e9, fc = 3e6;  // Pa/m, Pa/m, Pa

JointLaw composite_law() {
  JointLaw law;
  law.kind = JointLaw::Kind::composite;
  law.tension = 1e5, law.cohesion = 2e5;
  law.friction_angle = std::atan(0.75), law.residual_friction_angle = std::atan(0.6);
  law.dilation_angle = std::atan(0.2), law.dilation_length = 1e-3, law.dilation_pressure = 2e6;
  law.fracture_energy = {20.0, 80.0};
  law.compressive_strength = fc, law.compressive_energy = 4e3;
  return law;
}

/// A block of 0.8 x 0.5 m on a fixed one.
Assembly two_blocks(const JointLaw& law) {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, -1}, {0.8, 0.5, 0}, true);
  add_box(assembly, {0, 0, 0}, {0.8, 0.5, 1});
  return joined(std::move(assembly), kn, ks, law);
}

/// Pressed, tilted about both axes, twisted and dragged: a cycle in which the joint crushes, slides and opens.
void move_block(Bench& bench, double t) {
  const Vec3 move = {3e-4 * std::sin(1.3 * t), 2e-4 * std::sin(0.7 * t), -1.2e-4 + 1.6e-4 * std::sin(1.1 * t + 0.4)};
  const Vec3 half = 2e-4 * Vec3(std::sin(0.9 * t), std::sin(1.7 * t), std::sin(0.5 * t));
  const Vec3 low(0.4, 0.25, 0.0), centre(0.4, 0.25, 0.5);
  const Eigen::Quaterniond turn(std::sqrt(1 - half.squaredNorm()), half.x(), half.y(), half.z());
  const Vec3 arm = centre - low;
  bench.place(1, move + turn * arm - arm, turn);
}

/// Work of the joint's forces by the mean of those at both ends, against what it stores and has lost.
TEST(Composite, TheLedgerOfACycleCloses) {
  SolverSettings settings = undamped();
  settings.step.intact_shortcut = false;
  Bench bench(two_blocks(composite_law()), settings);
  bench.begin(1e-3);
  const Vec3 low(0.4, 0.25, 0.0);
  double work = 0.0, largest = 0.0;
  Vec3 place = Vec3::Zero(), turned = Vec3::Zero(), force = Vec3::Zero(), moment = Vec3::Zero();
  constexpr int steps = 200000;
  for (int i = 1; i <= steps; ++i) {
    move_block(bench, 12.0 * i / steps);
    bench.stepper.patches_only();
    const Eigen::Quaterniond q = bench.rotation(1);
    const Vec3 centre = bench.displacement(1) + q * Vec3(0, 0, -0.5) - Vec3(0, 0, -0.5), turn = 2.0 * q.vec();
    const auto [f, m] = bench.wrench_on(1, 0, low + centre);
    work -= 0.5 * ((f + force).dot(centre - place) + (m + moment).dot(turn - turned));
    place = centre, turned = turn, force = f, moment = m;
    largest = std::max(largest, std::abs(work));
  }
  const double stored = patch_energy(bench.model, bench.state, Branches{}, 0).elastic;
  const double friction = bench.state.joint.energy[energy_index({0, 0}, 0)],
               fracture = bench.state.joint.energy[energy_index({0, 0}, 1)];
  EXPECT_GT(friction, 0.05 * largest);
  EXPECT_GT(fracture, 0.05 * largest);
  EXPECT_NEAR(work, stored + friction + fracture, 1e-4 * largest);
  const Array<double>& crush = bench.state.joint.point_crush;
  EXPECT_GT(*std::max_element(crush.begin(), crush.end()), 1e-5) << "nothing was crushed";
}

/// The same path on the intact path for as long as it lasts: it ends where a corner reaches the cap.
TEST(Composite, LeavesTheIntactPathAtTheCap) {
  for (const Polygon& polygon : {Polygon{{0, 0, 0}, {0.8, 0, 0}, {0.8, 0.5, 0}, {0, 0.5, 0}},
                                 Polygon{{0, 0, 0}, {0.8, 0, 0}, {0.9, 0.4, 0}, {0.4, 0.7, 0}, {-0.1, 0.4, 0}}}) {
    Assembly assembly = stone();
    add_block(assembly, make_prism(polygon, {0, 0, -0.7}));
    add_block(assembly, make_prism(Polygon(polygon.rbegin(), polygon.rend()), {0, 0, 0.6}));
    Bench bench(joined(std::move(assembly), kn, ks, composite_law()));
    bench.begin(1e-3);
    const Patch& patch = bench.model.joints[0];
    bool left = false;
    for (int i = 1; i <= 4000 && !left; ++i) {
      const double way = 5e-8 * i;
      const Vec3 half = 0.1 * way * Vec3(0.7, 0.4, 0.2);
      bench.place(1, Vec3(0.3 * way, 0.2 * way, -way),
                  Eigen::Quaterniond(std::sqrt(1 - half.squaredNorm()), half.x(), half.y(), half.z()));
      bench.stepper.patches_only();
      const double* pose = bench.state.pose.data();
      const Jump<double> jump = patch_jump(patch, pose + pose_width * patch.a, pose + pose_width * patch.b);
      double most = 0.0;
      for (int c = 0; c < patch.corner_count; ++c) {
        const PatchPoint corner = patch_corner(patch, bench.model.corners, c);
        const Triple<double> u = point_jump(patch, jump, corner.s, corner.t);
        most = std::max(most, std::sqrt(std::pow(kn * u.x, 2) + 9.0 * ks * ks * (u.y * u.y + u.z * u.z)));
      }
      left = bench.state.joint.mode[0] & mode_points;
      ASSERT_EQ(left, most > fc / 3) << polygon.size() << " corners, step " << i << ", " << most;
    }
    EXPECT_TRUE(left);
  }
}

/// Without bond, dilation and much pressure a composite joint goes eight side by side with brittle ones, with their
/// forces and losses; pressed harder it crushes, and is computed by its own law from then on.
TEST(Composite, GoesWithBrittleJointsUntilItCrushes) {
  JointLaw composite = composite_law(), brittle = dry_law(0.6);
  composite.tension = composite.cohesion = composite.dilation_angle = 0.0;
  composite.friction_angle = composite.residual_friction_angle;
  for (const bool rectangle : {true, false}) {
    const auto blocks = [&](const JointLaw& law) {
      const Polygon pentagon = {{0, 0, 0}, {0.8, 0, 0}, {0.9, 0.4, 0}, {0.4, 0.7, 0}, {-0.1, 0.4, 0}};
      if (rectangle) return two_blocks(law);
      Assembly assembly = stone();
      add_block(assembly, make_prism(pentagon, {0, 0, -0.7}), true);
      add_block(assembly, make_prism(Polygon(pentagon.rbegin(), pentagon.rend()), {0, 0, 0.6}));
      return joined(std::move(assembly), kn, ks, law);
    };
    SolverSettings settings = undamped();
    settings.damping.kind = DampingSettings::Kind::maxwell;
    Bench one(blocks(composite), settings), other(blocks(brittle), settings);
    for (Bench* bench : {&one, &other}) bench->begin(1e-3);
    double worst = 0.0, largest = 0.0;
    int in_lanes = 0, open = 0;
    for (int i = 0; i < 3000; ++i) {
      const double t = 0.02 * i;
      const Vec3 half = 2e-5 * Vec3(std::sin(0.9 * t), std::sin(1.7 * t), std::sin(0.5 * t));
      for (Bench* bench : {&one, &other}) {
        bench->place(1, {2e-5 * std::sin(1.3 * t), 2e-5 * std::sin(0.7 * t), 4e-5 * std::sin(1.1 * t) + 1e-5},
                     Eigen::Quaterniond(std::sqrt(1 - half.squaredNorm()), half.x(), half.y(), half.z()));
        bench->stepper.patches_only();
      }
      const std::uint8_t mode = one.state.joint.mode[0];
      in_lanes += (mode & mode_points) && (mode & mode_lanes), open += !(mode & mode_points) && (mode & mode_open);
      for (std::size_t c = 0; c < 6; ++c) {
        worst = std::max(worst, std::abs(one.stepper.wrenches[c] - other.stepper.wrenches[c]));
        largest = std::max(largest, std::abs(other.stepper.wrenches[c]));
      }
    }
    EXPECT_GT(in_lanes, 500) << rectangle;
    EXPECT_GT(open, 100) << rectangle << ": came back to the intact path";
    EXPECT_LT(worst, 1e-6 * largest) << rectangle << ": branches are kept in single precision";
    const auto friction = [](const Bench& bench) { return bench.state.joint.energy[energy_index({0, 0}, 0)]; };
    EXPECT_GT(friction(other), 0.0);
    EXPECT_NEAR(friction(one), friction(other), 1e-5 * friction(other));
    for (int i = 1; i <= 100; ++i) {
      one.place(1, {1e-4, 0, -3e-6 * i}, Eigen::Quaterniond(1, 1e-5, 0, 0).normalized());
      one.stepper.patches_only();
    }
    EXPECT_EQ(one.state.joint.mode[0] & (mode_plain | mode_lanes), 0);
    EXPECT_GT(one.state.joint.point_crush[point_index(one.model.joints[0], 0, 3, 0)], 1e-5);
  }
}

/// A block on strips of base, so that points lie close: tilted further and further under a constant load it ends on the
/// rectangular block of stress, whose lever about the middle is t/2 − N/(2 fc w) (w the width, t the depth).
TEST(Composite, AHingeCrushesToTheRectangularBlockOfStress) {
  constexpr int strips = 40;
  constexpr double depth = 0.4, width = 0.5, load = 0.25 * fc * depth * width;
  JointLaw law = composite_law();
  law.tension = law.cohesion = 0.0;
  law.compressive_energy = 1e9, law.compressive_peak = 1e-5;  // as good as perfectly plastic
  Assembly assembly = stone();
  for (int i = 0; i < strips; ++i)
    add_box(assembly, {depth * i / strips, 0, -0.1}, {depth * (i + 1) / strips, width, 0}, true);
  add_box(assembly, {0, 0, 0}, {depth, width, 0.4});
  Bench bench(joined(std::move(assembly), kn, ks, law));
  bench.begin(1e-3);
  const auto wrench = [&](double turn, double down) {  // at a turn about y through the middle of the joint
    const Vec3 centre(depth / 2, width / 2, 0.2), arm(0, 0, 0.2);
    const Eigen::Quaterniond q(Eigen::AngleAxisd(turn, Vec3::UnitY()));
    bench.place(strips, Vec3(0, 0, -down) + q * arm - arm, q);
    bench.stepper.patches_only();
    Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
    for (std::size_t i = 0; i < bench.model.joints.size(); ++i) {
      const Patch& patch = bench.model.joints[i];
      if (patch.a != bench.body(strips) && patch.b != bench.body(strips)) continue;
      const auto [f, m] = bench.wrench_on(strips, i, centre - Vec3(0, 0, 0.2));
      force += f, moment += m;
    }
    return std::pair{force.z(), moment.y()};
  };
  double down = 0.0, lever = 0.0;
  for (int i = 1; i <= 2000; ++i) {
    const double turn = 2e-6 * i;
    // Sinks until it bears the load; what has been crushed stays, so that it goes down in small steps.
    for (int k = 0; k < 400; ++k) {
      const auto [force, moment] = wrench(turn, down);
      lever = std::abs(moment) / load;
      if (std::abs(force - load) < 1e-6 * load) break;
      down += 0.5 * (load - force) / (kn * depth * width);
    }
  }
  const double expected = depth / 2 - load / (2 * fc * width);
  EXPECT_NEAR(lever, expected, 0.02 * depth);
  EXPECT_LT(lever, depth / 2 - 0.8 * load / (2 * fc * width)) << "clearly within the edge";
}

/// Under a load beyond a third of its strength Newton's method finds equilibrium on the hardening branch.
TEST(Composite, ComesToRestWhereTheCapHardens) {
  JointLaw law = composite_law();
  law.compressive_peak = 3e-4;
  Assembly assembly = stone(2e5);  // 0.2 MN/m3: 2 MPa at the foot of a metre
  add_box(assembly, {0, 0, -1}, {0.8, 0.5, 0}, true);
  add_box(assembly, {0, 0, 0}, {0.8, 0.5, 1});
  SolverSettings settings = undamped({0, 0, -9.81});
  Bench bench(joined(std::move(assembly), kn, ks, law), settings);
  bench.begin();
  EXPECT_TRUE(bench.balance(1e-8).converged);
  const double pressure = 2e5 * 9.81, x = 1.0 - std::sqrt(1.0 - (pressure / fc - 1.0 / 3.0) * 1.5);
  EXPECT_NEAR(-bench.displacement(1).z(), pressure / kn + 3e-4 * x, 1e-6 * 3e-4);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
