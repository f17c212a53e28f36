// Measures of one component of a ground motion, piecewise linear between its samples.
#pragma once
#include <vector>

namespace voussoir {

struct Intensity {
  double pga = 0.0;                                // m/s2, largest acceleration
  double pgv = 0.0;                                // m/s, largest velocity of a ground that starts from rest
  double arias = 0.0;                              // m/s, π/2g ∫ a² dt (Arias 1970)
  double cav = 0.0;                                // m/s, ∫ |a| dt
  double t5 = 0.0, t95 = 0.0;                      // s, when 5 % and 95 % of that integral of a² are there
  double significant() const { return t95 - t5; }  // s, D5–95 (Trifunac & Brady 1975)
};
/// The integrals by the trapezoidal rule over the samples, as is the custom. Nothing but zeros: all zero.
Intensity intensity_of(const std::vector<double>& acceleration, double dt);

/// Pseudo-acceleration ω² max |u| (m/s2) of oscillators at rest at first, at these periods (s, above zero). Exact for
/// the piecewise linear motion at the samples and at points between them, at least forty a period (Nigam & Jennings
/// 1969); the oscillation after its end counts for one period.
std::vector<double> response_spectrum(const std::vector<double>& acceleration, double dt,
                                      const std::vector<double>& periods, double damping = 0.05);

}  // namespace voussoir
