// Second thoughts: an early choice may have stood in for what a later one says better.
#pragma once
#include "solver/diagnosis/search_point.h"

namespace voussoir {

/// Takes out effects that a later one has made needless.
void drop_superseded(const DiagnosisProblem& problem, const DiagnosisSettings& settings, Fit& current,
                     std::vector<Round>& rounds, const std::function<void(const std::string&)>& say);
/// Alone, an effect may have stood in for its neighbour and a later one: what its round has fitted besides takes its
/// place if that is better beside the others.
void exchange(DiagnosisProblem& problem, const DiagnosisSettings& settings, SearchPoint& standing,
              std::vector<Round>& rounds, const std::function<void(const std::string&)>& say);

}  // namespace voussoir
