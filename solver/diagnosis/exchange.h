// Revision of earlier choices: an early effect may have represented one that a later effect describes better.
#pragma once
#include "solver/diagnosis/search_point.h"

namespace voussoir {

/// Removes effects that a later one has made unnecessary. The first `before` effects were found by other rounds and
/// stay; the next one belongs to the first accepted round.
void drop_superseded(const DiagnosisProblem& problem, const DiagnosisSettings& settings, Fit& current,
                     std::size_t before, std::vector<Round>& rounds,
                     const std::function<void(const std::string&)>& say);
/// An effect that was chosen alone may have represented its neighbour and a later effect. Another trial of its round
/// replaces it if that gives a better fit together with the other effects.
void exchange(DiagnosisProblem& problem, const DiagnosisSettings& settings, SearchPoint& standing, std::size_t before,
              std::vector<Round>& rounds, const std::function<void(const std::string&)>& say);

}  // namespace voussoir
