// What every joint patch of an equilibrium carries, as stresses (docs/theory/thrust.md).
#pragma once
#include <vector>

#include "geometry/polyhedron.h"
#include "solver/statics/resultants.h"

namespace voussoir {

/// How a patch stands: it bears nothing (open), all its bond holds (bonded), some is lost (cracked), it had none and
/// sticks (closed), or its shear has come to what it bears (sliding).
enum class JointCondition { open, bonded, cracked, closed, sliding };
/// "open" …
const char* condition_word(JointCondition condition);

/// The resultant of one patch as it stands at rest. Compression is positive; places are those at rest.
struct JointStress {
  std::size_t patch = 0;             // of Snapshot::patches: joints of the assembly first
  Vec3 centre = Vec3::Zero();        // m, centroid
  double normal = 0.0, shear = 0.0;  // N
  double mean_compression = 0.0, mean_shear = 0.0, largest_compression = 0.0;  // Pa
  // Where the force goes through the plane of the joint, from the centroid (m), and as a share of the depth
  // (geometry/kern.h). Not finite without compression.
  Vec3 eccentricity = Vec3::Zero();
  double eccentricity_over_depth = 0.0;
  double utilisation = 0.0;  // shear over the capacity in shear; not finite where there is none
  JointCondition condition = JointCondition::open;
};

/// One of each joint and contact, in the order of the snapshot. Left out are ties, joints that a contact has taken the
/// place of, and contacts of faces near each other that bear nothing.
std::vector<JointStress> joint_stresses(const RestForces& rest, std::size_t joints);

}  // namespace voussoir
