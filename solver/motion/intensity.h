// Measures of one component of a ground motion, piecewise linear between its samples.
#pragma once
#include <vector>

namespace voussoir {

struct Intensity {
  double pga = 0.0;                                // m/s2, largest acceleration
  double pgv = 0.0;                                // m/s, largest velocity of a ground that starts from rest
  double arias = 0.0;                              // m/s, π/2g ∫ a² dt (Arias 1970)
  double cav = 0.0;                                // m/s, ∫ |a| dt
  double t5 = 0.0, t95 = 0.0;                      // s, times at which the integral of a² reaches 5 % and 95 %
  double significant() const { return t95 - t5; }  // s, D5–95 (Trifunac & Brady 1975)
};
/// The integrals use the trapezoidal rule over the samples, as usual. All measures of a motion of zeros are zero.
Intensity intensity_of(const std::vector<double>& acceleration, double dt);

/// Pseudo-acceleration ω² max |u| (m/s2) of oscillators that are initially at rest, at these periods (s, above zero).
/// It is exact for the piecewise linear motion at the samples and at points between them, at least forty for each
/// period (Nigam & Jennings 1969). One period of free vibration after the end of the motion is included.
std::vector<double> response_spectrum(const std::vector<double>& acceleration, double dt,
                                      const std::vector<double>& periods, double damping = 0.05);

}  // namespace voussoir
