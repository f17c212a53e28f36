// Texts on fragility: names and units of measures, reasons for a missing curve, and remarks.
#pragma once
#include <string>
#include <vector>

#include "tools/fragility/fragility.h"

namespace voussoir {

/// "m/s²"; empty for shares and for measures whose unit is not known.
std::string measure_unit(const std::string& column);
/// "Sa(0.30 s)", "PGA", "spandrel y"; the name of the column for others.
std::string measure_name(const std::string& column);
/// "Sa(0.30 s), m/s²".
std::string measure_label(const std::string& column);
/// "3.21 m/s²".
std::string with_unit(double value, const std::string& column);

/// "spandrel y reaches 0.02 m"; "the bridge collapses".
std::string limit_words(const LimitState& limit);
/// The method of a curve, in a few words.
std::string method_words(const Fragility& f);
/// The method in files: "counts", "cloud", "cloud with collapse".
std::string method_name(const Estimate& e);
/// The reason why an estimate is not known, and its bounds. `column` is the intensity.
std::string unknown_words(const Estimate& e, const std::string& column);
/// Remarks on a curve, one sentence each.
std::vector<std::string> remarks_on(const Fragility& f);
/// "3 failed, 2 not run yet"; empty if no run is left out.
std::string left_out_words(const SelectedRuns& s);

}  // namespace voussoir
