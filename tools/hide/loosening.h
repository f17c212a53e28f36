// Changes of the true bridge that no effect of the library describes: the stiffness of joints, or the density, inside
// a box.
#pragma once
#include <string>

#include "geometry/assembly.h"

namespace voussoir {

/// "x=12..14 z=9.. part=arch 1 factor=0.05".
struct Loosening {
  std::string text;                                                 // as the user gave it
  Vec3 low = Vec3::Constant(-1e300), high = Vec3::Constant(1e300);  // m
  std::string part;      // one of masonry_parts(): only joints inside it and only its blocks; empty: all
  double factor = 1.0;   // on kn and ks of joints, and of the patches of the fill, with centroids in the box
  double density = 1.0;  // on the mass of blocks with centroids in the box
};

/// Reads words KEY=VALUE: x, y, z (m, FROM..TO; either may be missing), part (a name of one or two words), factor
/// (0.0001 to 1000), density (0.1 to 10). Throws InputError that names the word.
Loosening parse_loosening(const std::string& text);

/// Throws InputError if the assembly does not have the part, or if the box contains nothing to change.
void loosen(Assembly& assembly, const Loosening& loosening);

}  // namespace voussoir
