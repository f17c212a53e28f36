// Stresses of every joint patch in an equilibrium (docs/theory/thrust.md).
#pragma once
#include <vector>

#include "geometry/polyhedron.h"
#include "solver/statics/resultants.h"

namespace voussoir {

/// Condition of a patch: open (no force), bonded (whole bond), cracked (part or all of its first bond is lost), closed
/// (never had a bond, no sliding), or sliding (shear at its capacity).
enum class JointCondition { open, bonded, cracked, closed, sliding };
/// The name: "open" …
const char* condition_word(JointCondition condition);

/// The resultant of one patch at equilibrium. Compression is positive; positions are those at equilibrium.
struct JointStress {
  std::size_t patch = 0;             // of Snapshot::patches: joints of the assembly first
  Vec3 centre = Vec3::Zero();        // m, centroid
  double normal = 0.0, shear = 0.0;  // N
  double mean_compression = 0.0, mean_shear = 0.0, largest_compression = 0.0;  // Pa
  // Intersection of the force with the plane of the joint, from the centroid (m), and as a share of the depth
  // (geometry/kern.h). Not finite without compression.
  Vec3 eccentricity = Vec3::Zero();
  double eccentricity_over_depth = 0.0;
  double utilisation = 0.0;  // shear over shear capacity; not finite without capacity
  JointCondition condition = JointCondition::open;
};

/// One entry for each joint and contact, in the order of the snapshot. Ties, joints that were replaced by a contact,
/// and contacts without force are left out.
std::vector<JointStress> joint_stresses(const RestForces& rest, std::size_t joints);

}  // namespace voussoir
