// Detection limits: the least amount of each effect that a measurement would show.
#pragma once
#include "solver/diagnosis/further.h"

namespace voussoir {

/// Detection limits for the first parameter of an effect at a place. The other parameters have their usual values.
struct Detectable {
  std::string name, where, parameter, unit;
  double neutral = 0.0;  // value without effect
  /// Beyond these values the effect is found with a probability of 0.9. Not finite: it cannot be found within the
  /// bounds of the parameter.
  double below = 0.0, above = 0.0;
};

struct DetectionSettings {
  double margin = 3.0;  // log probability by which a further effect must exceed "none"
  int further = 3;      // number of further sensors to find, and of further modes
  int threads = 1;
};

/// Detection limits of the data, and measurements that would lower them.
struct Detection {
  std::vector<Detectable> least;
  std::vector<Addition> further;  // sensors, then modes; each in addition to the earlier ones of its kind
};

/// Computes the detection limits in addition to the hypothesis of a fit and under its covariance, from the evidence to
/// first order about models with the effect (docs/theory/diagnosis.md). `origin` is the model of the hypothesis at
/// usual materials, and `shared` are its derivatives with respect to the materials. Covers effects that change the
/// model, and damping if it was measured.
Detection detection(const DiagnosisProblem& problem, const Fit& fit, const Origin& origin, const Vectors& shared,
                    const std::vector<Candidate>& candidates, const DetectionSettings& settings);

}  // namespace voussoir
