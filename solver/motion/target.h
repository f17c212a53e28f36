// Elastic response spectra of design codes.
#pragma once
#include <string>
#include <vector>

namespace voussoir {

enum class TargetCode { ntc2018, en1998_type_1, en1998_type_2 };

struct TargetSpectrum {
  TargetCode code = TargetCode::ntc2018;
  double ag = 0.0;     // g, on rock
  double f0 = 2.5;     // largest amplification on rock; NTC only, EN 1998-1 uses 2.5
  double tc = 0.0;     // s, Tc* on rock; NTC only
  char soil = 'A';     // to E
  int topography = 1;  // T1 to T4 (NTC); EN 1998-5, annex A, has the same factors
  double damping = 0.05;
  bool operator==(const TargetSpectrum&) const = default;
};

/// Throws InputError for an unknown soil class or topographic class, and for values outside their ranges.
void check_target(const TargetSpectrum& target);
/// Acceleration (g) at a period (s). NTC 2018, 3.2.3.2.1, tables 3.2.IV and 3.2.V; EN 1998-1:2004, 3.2.2.2, equations
/// 3.2 to 3.6 and tables 3.2 and 3.3.
double spectral_acceleration(const TargetSpectrum& target, double period);
/// The same for vertical motion. NTC 2018, 3.2.3.2.2, table 3.2.VI; EN 1998-1:2004, 3.2.2.3, equations 3.8 to 3.11 and
/// table 3.4.
double vertical_spectral_acceleration(const TargetSpectrum& target, double period);

/// "ntc2018", "en1998-1", "en1998-2", in the order of TargetCode.
const std::vector<std::string>& target_codes();

}  // namespace voussoir
