#include "solver/statics/joint_stresses.h"

#include <cmath>
#include <limits>

#include "geometry/kern.h"

namespace voussoir {

namespace {

JointCondition condition_of(const JointStress& stress, const PatchSnapshot& patch) {
  constexpr double all = 1.0 - 1e-9;     // of the area or the capacity, up to rounding
  constexpr double slides = 1.0 - 1e-3;  // an iteration ends this near the capacity
  if (stress.normal == 0.0 && stress.shear == 0.0) return JointCondition::open;
  if (stress.utilisation >= slides) return JointCondition::sliding;
  if (!patch.had_bond) return JointCondition::closed;
  return patch.bonded >= all ? JointCondition::bonded : JointCondition::cracked;
}

/// The patch puts `force` on its block a, which compression presses against the normal that points from a to b.
JointStress stress_of(std::size_t i, const PatchSnapshot& patch, const PatchForce& of) {
  constexpr double none = std::numeric_limits<double>::quiet_NaN();
  JointStress s;
  s.patch = i;
  s.centre = polygon_centroid(patch.polygon);
  s.normal = -of.force.dot(patch.normal);
  const Vec3 shear = of.force + s.normal * patch.normal;
  s.shear = shear.norm();
  s.mean_compression = s.normal / patch.area, s.mean_shear = s.shear / patch.area;
  s.largest_compression = of.largest_compression;
  s.eccentricity = Vec3::Constant(none), s.eccentricity_over_depth = none;
  if (s.normal > 0.0) {  // n × (r × (−N n)) = −N r of r in the plane
    const Vec3 moment = of.moment - s.centre.cross(of.force);
    s.eccentricity = -patch.normal.cross(moment) / s.normal;
    s.eccentricity_over_depth = eccentricity_over_depth(patch.polygon, patch.normal, s.eccentricity);
  }
  s.utilisation = of.shear_capacity > 0.0 ? s.shear / of.shear_capacity : none;
  s.condition = condition_of(s, patch);
  return s;
}

}  // namespace

const char* condition_word(JointCondition condition) {
  constexpr const char* words[] = {"open", "bonded", "cracked", "closed", "sliding"};
  return words[std::size_t(condition)];
}

std::vector<JointStress> joint_stresses(const RestForces& rest, std::size_t joints) {
  std::vector<JointStress> all;
  for (std::size_t i = 0; i < rest.snapshot.patches.size(); ++i) {
    const PatchSnapshot& patch = rest.snapshot.patches[i];
    const bool idle = i >= joints && rest.forces[i].force.isZero(0.0);
    if (!patch.tie && !patch.replaced && !idle) all.push_back(stress_of(i, patch, rest.forces[i]));
  }
  return all;
}

}  // namespace voussoir
