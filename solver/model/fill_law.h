// Constants of one fill material for the elements.
#pragma once
#include "geometry/assembly.h"

namespace voussoir {

/// Constants of one fill material; SI.
struct FillLaw {
  double density = 0.0;                       // kg/m3
  double bulk = 0.0, shear = 0.0;             // κ, μ, Pa
  double tension = 0.0;                       // ft, Pa
  double major = 1.0, minor = 1.0;            // 1 + sin φ, 1 − sin φ
  double flow_major = 1.0, flow_minor = 1.0;  // the same of ψ
  double strength = 0.0;                      // 2 c cos φ, Pa
  double cone = 1.0;  // 1 + sin² φ / 3: constant of the circular cone inside the hexagonal one
  double stiff() const { return bulk + 4.0 / 3.0 * shear; }  // λ + 2 μ
  double lame() const { return bulk - 2.0 / 3.0 * shear; }   // λ
};
/// Throws InputError for moduli that are not positive or give a Poisson's ratio below 0, and for a dilation angle above
/// the friction angle.
FillLaw fill_law(const Material& material);

}  // namespace voussoir
