// Shapes of vaults: computes the joints of one or several rings from span and rise, or from a surveyed line.
#pragma once
#include <string>
#include <vector>

#include "geometry/ring.h"

namespace voussoir {

/// One vault in the plane x-z.
struct VaultShape {
  std::string shape = "semicircular";  // one of vault_shapes()
  Vec3 left = Vec3::Zero();            // m, left springing of the intrados
  Vec3 right = Vec3::Zero();
  double rise = 0.0;          // m, height of the crown above the line between the springings
  Polygon surveyed;           // m, for the shape "surveyed": intrados from left to right; its ends are the springings
  std::vector<double> crown;  // m, thickness of each ring at the crown, the lowest first
  std::vector<double> springing;  // m, the same at the springings; quadratic along the intrados between them
  int voussoirs = 0;              // number of voussoirs of each ring
  double span() const { return right.x() - left.x(); }
};

/// "semicircular", "segmental", "elliptical", "three-centred", "pointed", "parabolic", "surveyed".
const std::vector<std::string>& vault_shapes();

/// Length of the intrados, m.
double intrados_length(const VaultShape& vault);

/// The rings, the lowest first. All have the same number of voussoirs. The joints pass through all rings, square to the
/// intrados (vertical at the crown of a pointed vault), so that the extrados of a ring is the intrados of the next one,
/// facet by facet. Throws InputError with `key` ("bridge.span 2") for dimensions that the shape does not allow, and for
/// an extrados that is not convex.
std::vector<Ring> vault_rings(const VaultShape& vault, const std::string& key);

/// One ring from the intrados of the lowest ring to the extrados of the highest: the space of the whole vault.
Ring whole_vault(const std::vector<Ring>& rings);

}  // namespace voussoir
