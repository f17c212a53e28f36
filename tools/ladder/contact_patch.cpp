// Uniform pressure through faces that do not match: every patch must carry the same stress.
#include <fmt/format.h>

#include "solver/base/error.h"
#include "tools/ladder/models.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

constexpr double weight = 2000 * 9.81;  // N/m3

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

/// Largest differences, as shares of the stress: at the corners of the patches, of their wrenches, and of the forces
/// in the joints between the parts of a course.
struct Differences {
  double stress = 0.0, wrench = 0.0, beside = 0.0;
  int horizontal = 0;  // patches
};

/// The stress (Pa) is density × g × height above; each point of the patch should carry it.
void compare_patch(Bench& bench, std::size_t i, double stress, Differences& worst) {
  const Joint& joint = bench.assembly.joints[std::size_t(bench.model.joint_of_patch[i])];
  const Patch& patch = bench.model.joints[i];
  const Vec3 place(patch.place[0], patch.place[1], patch.place[2]);
  const Jump<double> jump = patch_jump(patch, bench.pose(joint.a), bench.pose(joint.b));
  const Mat3 axes = Eigen::Quaterniond(patch.e_a[0], patch.e_a[1], patch.e_a[2], patch.e_a[3]).toRotationMatrix();
  for (const Vec3& corner : joint.polygon) {
    const Vec3 local = axes.transpose() * (corner - place);
    const double sigma = patch.kn * point_jump(patch, jump, local.y(), local.z()).x;
    worst.stress = std::max(worst.stress, std::abs(sigma / stress - 1.0));
  }
  const auto [force, moment] = bench.wrench_on(joint.b, i, place);
  const double up = patch.b == bench.body(joint.b) && joint.normal.z() > 0 ? 1.0 : -1.0;
  const double difference = std::abs(force.z() + up * stress * joint.area) + moment.norm();
  worst.wrench = std::max(worst.wrench, difference / std::abs(stress));
  ++worst.horizontal;
}

Differences press(int points_per_side, bool shortcut) {
  SolverSettings settings = undamped({0, 0, -9.81});
  settings.contact.points_per_side = points_per_side;
  settings.step.intact_shortcut = shortcut;
  Bench bench(crossing_courses(), settings);
  if (!bench.balance(1e-12).converged) throw RunError("the courses did not reach equilibrium under their weight");
  bench.stepper.patches_only();
  Differences worst;
  for (std::size_t i = 0; i < bench.model.joints.size(); ++i) {
    const Joint& joint = bench.assembly.joints[std::size_t(bench.model.joint_of_patch[i])];
    const Vec3 place(bench.model.joints[i].place[0], bench.model.joints[i].place[1], bench.model.joints[i].place[2]);
    if (std::abs(joint.normal.z()) < 0.5)  // between the parts of a course: nothing
      worst.beside = std::max(worst.beside, bench.wrench_on(joint.a, i, place).first.norm() / weight);
    else
      compare_patch(bench, i, -weight * (place.z() > 0.25 ? 0.3 : 0.8), worst);
  }
  return worst;
}

std::vector<Finding> climb_contact_patch(int) {
  std::vector<Finding> findings;
  for (bool shortcut : {true, false}) {
    Differences worst;
    for (int per_side : {3, 4, 5}) {
      const Differences found = press(per_side, shortcut);
      // Two on the slab, four where the lines cross.
      if (found.horizontal != 6) throw RunError("{} patches carry the pressure, not 6", found.horizontal);
      worst.stress = std::max(worst.stress, found.stress);
      worst.wrench = std::max(worst.wrench, found.wrench);
      worst.beside = std::max(worst.beside, found.beside);
    }
    const std::string path = shortcut ? "shortcut" : "points";
    findings.push_back(nothing("difference of stress, " + path, worst.stress, 1e-9, "-", "uniform stress"));
    findings.push_back(nothing("difference of wrenches, " + path, worst.wrench, 1e-9, "-", "stress times area"));
    findings.push_back(nothing("stress of upright joints, " + path, worst.beside, 1e-9, "-", "no load across"));
  }
  return findings;
}

}  // namespace

Rung contact_patch() {
  return {.name = "contact-patch",
          .help = "uniform pressure on blocks with faces that do not match",
          .climb = climb_contact_patch};
}

}  // namespace voussoir::ladder
