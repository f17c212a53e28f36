// What is said about fragility: names and units of measures, why a curve is not known, what to mind.
#pragma once
#include <string>
#include <vector>

#include "tools/fragility/fragility.h"

namespace voussoir {

/// "m/s²"; empty for shares and for measures whose unit is not known.
std::string measure_unit(const std::string& column);
/// "Sa(0.30 s)", "PGA", "spandrel y"; other columns by their own name.
std::string measure_name(const std::string& column);
/// "Sa(0.30 s), m/s²".
std::string measure_label(const std::string& column);
/// "3.21 m/s²".
std::string with_unit(double value, const std::string& column);

/// "spandrel y reaches 0.02 m"; "the bridge falls".
std::string limit_words(const LimitState& limit);
/// How a curve came about, in a few words.
std::string method_words(const Fragility& f);
/// The same for scripts: "counts", "cloud", "cloud with collapse".
std::string method_name(const Estimate& e);
/// Why an estimate is not known, and what is; `column` is the intensity.
std::string unknown_words(const Estimate& e, const std::string& column);
/// What to mind with a curve, a sentence each.
std::vector<std::string> remarks_on(const Fragility& f);
/// "3 failed, 2 not run"; empty when none was left out.
std::string left_out_words(const SelectedRuns& s);

}  // namespace voussoir
