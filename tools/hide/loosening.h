// Changes of the hidden bridge that no effect of the library makes: joints, or the weight, of what lies in a box.
#pragma once
#include <string>

#include "geometry/assembly.h"

namespace voussoir {

/// "x=12..14 z=9.. part=arch 1 factor=0.05".
struct Loosening {
  std::string text;                                                 // as it was given
  Vec3 low = Vec3::Constant(-1e300), high = Vec3::Constant(1e300);  // m
  std::string part;      // of masonry_parts(): only joints inside it, only its blocks; empty: all
  double factor = 1.0;   // on kn and ks of joints, and of the fill's patches, whose centroids lie in the box
  double density = 1.0;  // on the mass of blocks whose centroids do
};

/// Words are KEY=VALUE: x, y, z (m, FROM..TO; either may be missing), part (a name of two words too), factor (0.0001 to
/// 1000), density (0.1 to 10). Throws InputError that names the word.
Loosening parse_loosening(const std::string& text);

/// Throws InputError for a part the assembly does not have, and where the box holds nothing that it would change.
void loosen(Assembly& assembly, const Loosening& loosening);

}  // namespace voussoir
