// One round of a search: screens every candidate in addition to the present hypothesis and fits the best ones.
#pragma once
#include "solver/diagnosis/search_point.h"

namespace voussoir {

/// Screens all candidates that can be combined with the present hypothesis, fits the best ones from usual materials and
/// computes their probabilities. Reports its progress with `say`.
Round run_round(const DiagnosisProblem& problem, const DiagnosisSettings& settings, const SearchPoint& standing,
                const std::vector<Candidate>& all_candidates, const std::function<void(const std::string&)>& say);

/// Log evidence of a trial, including the prior of its candidate, minus that of the fit without it.
double gain_of(const Trial& trial, const Fit& current);
/// Whether the two are equal or cannot be combined: a base on springs cannot be driven.
bool excludes(const Candidate& there, const Candidate& c);

}  // namespace voussoir
