// Numbers of a diagnosis in words: fitted parameters with their standard deviations, modes, probabilities.
#pragma once
#include "tools/diagnosis/diagnosis_report.h"

namespace voussoir {

/// A fitted parameter in its own unit.
struct FittedValue {
  std::string name, unit;
  double value = 0.0, std = 0.0;
  bool at_bound = false;
  /// "stiffness_share 0.48 ± 0.05", with the unit where there is one.
  std::string text() const;
};
/// Parameters of effect `index` of the hypothesis of the fit, including the fixed gain of a sensor fault.
std::vector<FittedValue> fitted_values(const Fit& fit, std::size_t index);
/// The same as one text, separated by commas. Empty if the effect has no parameters.
std::string fitted_text(const Fit& fit, std::size_t index);

/// "0.48 ± 0.05", "(2.1 ± 0.3) × 10⁸": as many digits as the standard deviation allows.
std::string with_std(double value, double std);
/// Text for a factor or spring without a named cause: "stiffness of pier 1 should be 1.8 ± 0.2 times as large".
std::string nameless_text(const Fit& fit, std::size_t index);
/// "0.97", "below 0.01", "above 0.99".
std::string probability_text(double probability);
/// The candidate in words, such as "abutment restraint at both".
std::string plain_name(const Candidate& candidate);
/// The rounds whose best trial was added, in the order of the effects of the last fit.
std::vector<const Round*> accepted_rounds(const std::vector<Round>& rounds);
/// "0.43", or "none" if it is not finite.
std::string gap_text(double gap);
/// "mode 3", or the name of the mode if it is not a number.
std::string mode_title(const ModeComparison& mode);
/// The measured direction or, if none was given, the motion of the computed partner.
std::string mode_motion(const ModeComparison& mode);

}  // namespace voussoir
