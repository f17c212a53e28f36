// Principal stresses of the fill.
#pragma once
#include <array>

namespace voussoir {

/// The largest compression of a stress (xx, yy, zz, xy, yz, xz; Pa, tension positive): minus its least principal value;
/// negative if all principal stresses are tensile.
double largest_compression(const std::array<double, 6>& stress);

}  // namespace voussoir
