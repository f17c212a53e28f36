// The elastic stiffness of one joint on any convex polygon: A kn, A ks, kn I about both axes, ks J (elementary beam
// theory), by the intact path and point by point.
#include "tools/ladder/joint_stiffness.h"

#include "solver/base/error.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

constexpr double stiffness_kn = prisms_kn, stiffness_ks = prisms_ks;

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

struct Response {
  Vec3 force, moment;  // on the second block, about the joint's centroid
};

/// What the joint does to the second block when the blocks are moved apart by δ and turned apart by an angle about an
/// axis through the joint's centroid, half each, so that the joint itself stays where it is.
Response respond(Bench& bench, const Vec3& centroid, const Vec3& delta, const Vec3& axis, double angle) {
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
  return -s.area * (stiffness_kn * n * n.transpose() + stiffness_ks * (Mat3::Identity() - n * n.transpose())) * delta;
}

/// Moment −∫ r × K (θ × r) dA for a small turn θ: bending kn [n]ₓ S [n]ₓᵀ θ, torsion ks tr(S) n nᵀ θ.
Vec3 expected_moment(const Section& s, const Vec3& n, const Vec3& turn) {
  Mat3 cross;
  cross << 0, -n.z(), n.y(), n.z(), 0, -n.x(), -n.y(), n.x(), 0;
  return -stiffness_kn * cross * s.second * cross.transpose() * turn -
         stiffness_ks * s.second.trace() * n * n.dot(turn);
}

void raise(double& worst, double found) {
  worst = std::max(worst, found);
}

/// Axial, shear, bending about both principal axes, torsion. The stored energy of a turn φ is ½ k I (2 sin(φ/2))², so
/// that the moment is k I sin φ at any angle: a finite angle keeps rounding out of the comparison.
void compare_single_motions(Bench& bench, const Section& s, const Mat3& axes, double shift, StiffnessErrors& worst) {
  const double size = std::sqrt(s.area);
  for (int c = 0; c < 3; ++c) {
    const Vec3 delta = 1e-3 * axes.col(c), turn = std::sin(1e-3) * axes.col(c);
    const Response moved = respond(bench, s.centroid, delta, axes.col(c), 0.0);
    const Response turned = respond(bench, s.centroid, Vec3::Zero(), axes.col(c), 1e-3);
    const Vec3 force = expected_force(s, axes.col(0), delta), moment = expected_moment(s, axes.col(0), turn);
    raise(worst.force, (moved.force - force).norm() / force.norm());
    raise(worst.moment, (turned.moment - moment).norm() / moment.norm());
    raise(worst.beside, moved.moment.norm() / (force.norm() * (size + shift)));
    raise(worst.beside, turned.force.norm() / (moment.norm() / size));
  }
}

/// Any motion: to first order, superposed.
void compare_any_motion(Bench& bench, const Section& s, const Vec3& normal, std::mt19937& random,
                        StiffnessErrors& worst) {
  const double size = std::sqrt(s.area);
  for (int i = 0; i < 10; ++i) {
    const Vec3 delta = random_vector(1e-7 * size, random), axis = random_vector(1.0, random).normalized();
    const Response got = respond(bench, s.centroid, delta, axis, 1e-7);
    const Vec3 force = expected_force(s, normal, delta), moment = expected_moment(s, normal, 1e-7 * axis);
    raise(worst.any_force, (got.force - force).norm() / force.norm());
    raise(worst.any_moment, (got.moment - moment).norm() / (moment.norm() + size * force.norm()));
  }
}

Finding of_area(const std::string& shape, const StiffnessErrors& errors) {
  return nothing("error of kn A and ks A, " + shape, errors.force, 1e-12, "-", "beam theory");
}

/// The turn of 1e-3 moves the corners on the short side of the triangle by 2e-4 m. This is a difference of places of
/// about 2 m, each rounded to 4e-16 m, so that every corner is off by some 2e-12 of its way.
Finding of_inertia(const std::string& shape, const StiffnessErrors& errors) {
  return nothing("error of kn I and ks J, " + shape, errors.moment, 1e-11, "-", "beam theory");
}

std::vector<Finding> climb_joint_stiffness(int) {
  std::mt19937 random(3);
  StiffnessErrors square, triangle, hexagon;
  for (bool shortcut : {true, false}) {
    compare_stiffness({{0, 0, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}}, random, shortcut, square);
    compare_stiffness({{0, 0, 0}, {2, 0.1, 0}, {0.3, 0.7, 0}}, random, shortcut, triangle);
  }
  const Polygon irregular = random_polygon(6, random);
  for (bool shortcut : {true, false}) compare_stiffness(irregular, random, shortcut, hexagon);
  return {of_area("square", square),    of_area("triangle", triangle),    of_area("irregular hexagon", hexagon),
          of_inertia("square", square), of_inertia("triangle", triangle), of_inertia("irregular hexagon", hexagon)};
}

}  // namespace

Assembly two_prisms(const Polygon& polygon, const Eigen::Quaterniond& rotation, const Vec3& shift) {
  Polygon placed, reversed;
  for (const Vec3& p : polygon) placed.push_back(rotation * p + shift);
  reversed.assign(placed.rbegin(), placed.rend());
  const Vec3 normal = rotation * Vec3::UnitZ();
  Assembly assembly = stone();
  add_block(assembly, make_prism(reversed, -0.7 * normal));
  add_block(assembly, make_prism(placed, 0.6 * normal));
  if (mass_properties(assembly.blocks[0].cells[0]).volume < 0.0)
    assembly.blocks[0].cells = {make_prism(placed, -0.7 * normal)};
  if (mass_properties(assembly.blocks[1].cells[0]).volume < 0.0)
    assembly.blocks[1].cells = {make_prism(reversed, 0.6 * normal)};
  return joined(std::move(assembly), stiffness_kn, stiffness_ks, elastic_law());
}

void compare_stiffness(const Polygon& polygon, std::mt19937& random, bool shortcut, StiffnessErrors& worst) {
  SolverSettings settings = undamped();
  settings.step.intact_shortcut = shortcut;
  const Eigen::Quaterniond rotation = random_rotation(random);
  const Vec3 shift = random_vector(2.0, random);
  Bench bench(two_prisms(polygon, rotation, shift), settings);
  if (bench.model.joints.size() != 1) throw RunError("two prisms have {} joints, not 1", bench.model.joints.size());
  Polygon placed;
  for (const Vec3& p : polygon) placed.push_back(rotation * p + shift);
  const Section s = section(placed);
  const double* e = bench.model.joints[0].e_a;
  const Mat3 axes = Eigen::Quaterniond(e[0], e[1], e[2], e[3]).toRotationMatrix();
  const double aligned = std::abs(axes.col(0).dot(rotation * Vec3::UnitZ()));
  if (std::abs(aligned - 1.0) > 1e-14) throw RunError("the joint's normal is off the polygon's by {}", 1.0 - aligned);
  compare_single_motions(bench, s, axes, shift.norm(), worst);
  compare_any_motion(bench, s, axes.col(0), random, worst);
}

Rung joint_stiffness() {
  return {.name = "joint-stiffness",
          .help = "elastic stiffness of a square, triangular, hexagonal joint",
          .climb = climb_joint_stiffness};
}

}  // namespace voussoir::ladder
