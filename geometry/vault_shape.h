// The shapes of vaults: from span and rise, or a surveyed line, to the joints of one ring or of several.
#pragma once
#include <string>
#include <vector>

#include "geometry/ring.h"

namespace voussoir {

/// One vault in the plane x-z.
struct VaultShape {
  std::string shape = "semicircular";  // one of vault_shapes()
  Vec3 left = Vec3::Zero();            // m, springings of the intrados
  Vec3 right = Vec3::Zero();
  double rise = 0.0;              // m, of the crown above the line between the springings
  Polygon surveyed;               // m, of shape "surveyed": from left to right, its ends are the springings
  std::vector<double> crown;      // m, thickness of each ring there, the lowest first
  std::vector<double> springing;  // m, and at the springings; in between as the square of the way
  int voussoirs = 0;              // of each ring
  double span() const { return right.x() - left.x(); }
};

/// "semicircular", "segmental", "elliptical", "three-centred", "pointed", "parabolic", "surveyed".
const std::vector<std::string>& vault_shapes();

/// Length of the intrados, m.
double intrados_length(const VaultShape& vault);

/// The rings, the lowest first. All have the same number of voussoirs, between joints that go through all of them,
/// square to the intrados (at the crown of a pointed vault upright), so that what one ring ends with the next begins
/// with, facet by facet. Throws InputError that names `key` ("bridge.span 2") for a shape that its dimensions do not
/// allow, and for an extrados that is not convex.
std::vector<Ring> vault_rings(const VaultShape& vault, const std::string& key);

/// From the intrados of the lowest ring to the extrados of the highest: what the vault takes up.
Ring whole_vault(const std::vector<Ring>& rings);

}  // namespace voussoir
