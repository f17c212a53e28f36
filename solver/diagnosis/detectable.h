// What a measurement could have shown: the least amount of each effect that it would find.
#pragma once
#include "solver/diagnosis/further.h"

namespace voussoir {

/// Of an effect at a place, its first parameter, the others being usual.
struct Detectable {
  std::string name, where, parameter, unit;
  double neutral = 0.0;  // where it changes nothing
  /// Beyond these the effect is found with a probability of 0.9; not finite: not within the bounds of the parameter.
  double below = 0.0, above = 0.0;
};

struct DetectionSettings {
  double margin = 3.0;  // as a further effect must be better than none
  int further = 3;      // sensors that are looked for, and modes
  int threads = 1;
};

/// What these data would show, and what would show more.
struct Detection {
  std::vector<Detectable> least;
  std::vector<Addition> further;  // sensors, then modes; each beside those of its kind before it
};

/// Beside the hypothesis of a fit, of which `origin` is the model at usual materials and `shared` what materials do to
/// it, and under its covariance: from the evidence to first order about models with the effect
/// (docs/theory/diagnosis.md). Effects that change the model, and damping where it was measured.
Detection detection(const DiagnosisProblem& problem, const Fit& fit, const Origin& origin, const Vectors& shared,
                    const std::vector<Candidate>& candidates, const DetectionSettings& settings);

}  // namespace voussoir
