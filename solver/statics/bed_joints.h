// Resultants of the bed joints of vaults, which give the thrust lines (docs/theory/thrust.md).
#pragma once
#include "geometry/assembly.h"
#include "solver/statics/resultants.h"

namespace voussoir {

/// A bed joint of a ring over its whole width: all patches between two courses of voussoirs, or between the last course
/// and its support. Axes n (unit, from left to right along the ring), d (from intrados to extrados) and g = n × d
/// (along the barrel); positions at equilibrium.
struct BedJoint {
  std::int32_t vault = 0;      // Block::part
  std::int32_t ring = 0;       // from the intrados, 0; headers belong to the lower ring
  std::int32_t number = 0;     // from the left springing, 0
  Vec3 centre = Vec3::Zero();  // m, centroid of the patches
  Vec3 n = Vec3::UnitX(), d = Vec3::UnitZ(), g = -Vec3::UnitY();
  double depth = 0.0, width = 0.0;  // m, along d and g
  double area = 0.0;                // m2
  // Force of the left side on the right side: N, compression positive.
  double normal = 0.0, shear = 0.0, shear_across = 0.0;  // along n, d, g
  // m, from the centre: intersection of the line of the force with the joint, along d and g. Not finite without
  // compression.
  double eccentricity = 0.0, eccentricity_across = 0.0;
  double torsion = 0.0;              // N m, about n through the centre
  double utilisation = 0.0;          // shear over shear capacity; not finite without capacity
  double largest_compression = 0.0;  // Pa

  /// Intersection of the thrust line with the joint, m.
  Vec3 thrust() const { return centre + eccentricity * d + eccentricity_across * g; }
  Vec3 force() const { return normal * n + shear * d + shear_across * g; }
};

/// The bed joints of all rings of vaults (Component::arch), by vault, ring and number. A course consists of the
/// voussoirs of a ring side by side across the barrel. The support of an end course is every block at its outer face
/// except blocks of other vaults. Vaults are assumed to span along x.
std::vector<BedJoint> bed_joints(const Assembly& assembly, const RestForces& rest);

}  // namespace voussoir
