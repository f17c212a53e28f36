// One round of a search: every candidate beside what stands already, the best of them fitted.
#pragma once
#include "solver/diagnosis/search_point.h"

namespace voussoir {

/// Screens all candidates that may stand beside those of the hypothesis, fits the most promising ones from usual
/// materials and weighs them. `say` is told what happens.
Round run_round(const DiagnosisProblem& problem, const DiagnosisSettings& settings, const SearchPoint& standing,
                const std::vector<Candidate>& all_candidates, const std::function<void(const std::string&)>& say);

/// By how much the log evidence of a trial, with its candidate's prior, is above that of the fit without it.
double gain_of(const Trial& trial, const Fit& current);
/// The same thing, or one that cannot be beside it: a base on springs is no base that could be driven.
bool excludes(const Candidate& there, const Candidate& c);

}  // namespace voussoir
