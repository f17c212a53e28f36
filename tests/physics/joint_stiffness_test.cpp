// The elastic stiffness of one joint on any convex polygon: A kn, A ks, kn I about both axes, ks J (elementary beam
// theory), by the intact path and point by point.
#include "tests/solver/measured.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace {

constexpr double kn = 3e9, ks = 1.1e9;

/// Two prisms on the two sides of a polygon, turned and shifted anyhow.
Assembly two_prisms(const Polygon& polygon, const Eigen::Quaterniond& rotation, const Vec3& shift) {
  Polygon placed, reversed;
  for (const Vec3& p : polygon) placed.push_back(rotation * p + shift);
  reversed.assign(placed.rbegin(), placed.rend());
  const Vec3 normal = rotation * Vec3::UnitZ();
  Assembly assembly = stone();
  add_block(assembly, make_prism(reversed, -0.7 * normal));
  add_block(assembly, make_prism(placed, 0.6 * normal));
  if (mass_properties(assembly.blocks[0].cells[0]).volume < 0.0) {
    assembly.blocks[0].cells = {make_prism(placed, -0.7 * normal)};
  }
  if (mass_properties(assembly.blocks[1].cells[0]).volume < 0.0)
    assembly.blocks[1].cells = {make_prism(reversed, 0.6 * normal)};
  return joined(std::move(assembly), kn, ks, elastic_law());
}

/// ∫ dA, and ∫ r rᵀ dA about the centroid, by fans of triangles about corner 0 (mid-edge rule, exact for quadratics).
struct Section {
  double area = 0.0;
  Vec3 centroid = Vec3::Zero();
  Mat3 second = Mat3::Zero();
};
Section section(const Polygon& p) {
  Section s;
  for (int pass = 0; pass < 2; ++pass)
    for (std::size_t i = 1; i + 1 < p.size(); ++i) {
      const double area = 0.5 * (p[i] - p[0]).cross(p[i + 1] - p[0]).norm();
      for (const Vec3& x : {Vec3(0.5 * (p[0] + p[i])), Vec3(0.5 * (p[i] + p[i + 1])), Vec3(0.5 * (p[i + 1] + p[0]))}) {
        if (pass == 0) s.area += area / 3, s.centroid += area / 3 * x;
        if (pass == 1) s.second += area / 3 * (x - s.centroid) * (x - s.centroid).transpose();
      }
      if (pass == 0 && i + 2 == p.size()) s.centroid /= s.area;
    }
  return s;
}

struct Loads {
  Vec3 force, moment;  // on the second block, about the joint's centroid
};

/// What the joint does to the second block when the blocks are moved apart by δ and turned apart by an angle about an
/// axis through the joint's centroid, half each, so that the joint itself stays where it is.
Loads respond(Bench& bench, const Vec3& centroid, const Vec3& delta, const Vec3& axis, double angle) {
  for (std::int64_t block : {0, 1}) {
    const double half = block == 0 ? -0.5 : 0.5;
    const Vec3 v = std::sin(0.5 * half * angle) * axis,
               arm = centroid - bench.assembly.blocks[std::size_t(block)].centroid;
    const double w = std::cos(0.5 * half * angle);
    // (R − 1) arm = 2 w v × arm + 2 v × (v × arm), without cancellation.
    const Vec3 moved = 2 * w * v.cross(arm) + 2 * v.cross(v.cross(arm));
    bench.place(block, half * delta - moved, {w, v.x(), v.y(), v.z()});
  }
  bench.stepper.patches_only();
  const auto [force, moment] = bench.wrench_on(1, 0, centroid);
  return {force, moment};
}

/// Force −(kn n nᵀ + ks (1 − n nᵀ)) A δ.
Vec3 expected_force(const Section& s, const Vec3& n, const Vec3& delta) {
  return -s.area * (kn * n * n.transpose() + ks * (Mat3::Identity() - n * n.transpose())) * delta;
}

/// Moment −∫ r × K (θ × r) dA for a small turn θ: bending kn [n]ₓ S [n]ₓᵀ θ, torsion ks tr(S) n nᵀ θ.
Vec3 expected_moment(const Section& s, const Vec3& n, const Vec3& turn) {
  Mat3 cross;
  cross << 0, -n.z(), n.y(), n.z(), 0, -n.x(), -n.y(), n.x(), 0;
  return -kn * cross * s.second * cross.transpose() * turn - ks * s.second.trace() * n * n.dot(turn);
}

/// Largest relative errors of forces (kn A, ks A) and of moments (kn I, ks J).
struct Errors {
  double force = 0.0, moment = 0.0;
  void take(double of_force, double of_moment) {
    force = std::max(force, of_force);
    moment = std::max(moment, of_moment);
  }
  void say(const std::string& joint) const {
    measured("Stiffness of a joint, " + joint + ": kn A, ks A", 0.0, force, "relative");
    measured("Stiffness of a joint, " + joint + ": kn I, ks J", 0.0, moment, "relative");
  }
};

/// Axial, shear, bending about both principal axes, torsion. The stored energy of a turn φ is ½ k I (2 sin(φ/2))², so
/// that the moment is k I sin φ at any angle: a finite angle keeps rounding out of the comparison.
void check_stiffness(const Polygon& polygon, std::mt19937& random, bool shortcut, Errors& errors) {
  SolverSettings settings = undamped();
  settings.step.intact_shortcut = shortcut;
  const Eigen::Quaterniond rotation = random_rotation(random);
  const Vec3 shift = random_vector(2.0, random);
  Bench bench(two_prisms(polygon, rotation, shift), settings);
  ASSERT_EQ(bench.model.joints.size(), 1u);
  Polygon placed;
  for (const Vec3& p : polygon) placed.push_back(rotation * p + shift);
  const Section s = section(placed);
  const double* e = bench.model.joints[0].e_a;
  const Mat3 axes = Eigen::Quaterniond(e[0], e[1], e[2], e[3]).toRotationMatrix();
  EXPECT_NEAR(std::abs(axes.col(0).dot(rotation * Vec3::UnitZ())), 1.0, 1e-14);
  const double size = std::sqrt(s.area);
  for (int c = 0; c < 3; ++c) {
    const Vec3 delta = 1e-3 * axes.col(c), turn = std::sin(1e-3) * axes.col(c);
    const Loads moved = respond(bench, s.centroid, delta, axes.col(c), 0.0);
    const Vec3 force = expected_force(s, axes.col(0), delta);
    EXPECT_LT((moved.force - force).norm(), 1e-12 * force.norm());
    EXPECT_LT(moved.moment.norm(), 1e-12 * force.norm() * (size + shift.norm()));
    const Loads turned = respond(bench, s.centroid, Vec3::Zero(), axes.col(c), 1e-3);
    const Vec3 moment = expected_moment(s, axes.col(0), turn);
    EXPECT_LT((turned.moment - moment).norm(), 2e-12 * moment.norm()) << (c == 0 ? "torsion" : "bending");
    EXPECT_LT(turned.force.norm(), 2e-12 * moment.norm() / size);
    errors.take((moved.force - force).norm() / force.norm(), (turned.moment - moment).norm() / moment.norm());
  }
  // Any motion: to first order, superposed.
  for (int i = 0; i < 10; ++i) {
    const Vec3 delta = random_vector(1e-7 * size, random), axis = random_vector(1.0, random).normalized();
    const Loads got = respond(bench, s.centroid, delta, axis, 1e-7);
    const Vec3 force = expected_force(s, axes.col(0), delta), moment = expected_moment(s, axes.col(0), 1e-7 * axis);
    EXPECT_LT((got.force - force).norm(), 1e-7 * force.norm());
    EXPECT_LT((got.moment - moment).norm(), 1e-6 * (moment.norm() + size * force.norm()));
  }
}

TEST(JointStiffness, OfSquareAndTriangle) {
  std::mt19937 random(3);
  Errors square, triangle;
  for (bool shortcut : {true, false}) {
    check_stiffness({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, random, shortcut, square);
    check_stiffness({{0, 0, 0}, {2, 0.1, 0}, {0.3, 0.7, 0}}, random, shortcut, triangle);
  }
  square.say("square");
  triangle.say("triangle");
}

TEST(JointStiffness, OfRandomPolygons) {
  std::mt19937 random(4);
  for (int corners = 3; corners <= 9; ++corners) {
    Errors errors;
    for (int repeat = 0; repeat < 3; ++repeat) {
      const Polygon polygon = random_polygon(corners, random);
      for (bool shortcut : {true, false}) check_stiffness(polygon, random, shortcut, errors);
    }
    errors.say("three irregular polygons of " + std::to_string(corners) + " corners");
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
  check_gradient(kn, 1e-8);
  check_gradient(ks, 1e-3);
}

}  // namespace
}  // namespace voussoir::test
