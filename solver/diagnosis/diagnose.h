// Naming what a model lacks (docs/theory/diagnosis.md): fair calibration, screening by signature, full fits, evidence,
// prediction of what was not fitted, effects added one at a time.
#pragma once
#include <optional>

#include "solver/diagnosis/detectable.h"

namespace voussoir {

struct DiagnosisSettings {
  int effects = 3;               // most that are added
  int fits = 12;                 // candidates fitted fully in a round
  int iterations = 8;            // of each fit
  double margin = 3.0;           // an effect must beat "none" by so much in log probability
  double further = 3.5;          // and by so much more where an effect is there: two are rarer than one
  double certain = 12.0;         // a fault of a channel, to be put right before anything else is judged
  double consistent = 0.02;      // probability of a larger misfit, above which a model is consistent
  double credible = 1e-3;        // below which it is not, whatever was added
  bool detectable = true;        // say what least amounts would be found
  int further_measurements = 3;  // and which further sensors or modes would lower them most
  bool predict = true;           // what is added must also predict each mode better from the others
  int threads = 1;
  std::vector<std::string> without;  // names of effects that are not tried
};

/// A candidate that was fitted.
struct Trial {
  Candidate candidate;
  Fit fit;
  double probability = 0.0;  // among this round's trials and none
  double signature = 0.0;    // collinearity with the best one's
  bool tie = false;          // as good as the best one
};

struct Round {
  std::vector<Trial> trials;                                    // best first
  double none = 1.0;                                            // probability that none of them acts
  bool accepted = false;                                        // the first one
  bool superseded = false;                                      // it was, until a later one made it needless
  std::vector<std::pair<std::string, double>> screened;         // candidate and what it could explain, best first
  std::vector<std::pair<std::string, std::string>> not_fitted;  // candidates whose fit failed, and why
};

/// What would tell two candidates apart.
struct Advice {
  std::string against;  // the other candidate
  std::string text;     // "a sensor at (3.2, 0.0, 8.1) m along y: mode 2 differs by 5.1 standard deviations"
};

struct Diagnosis {
  enum class Verdict { consistent, found, unexplained };
  Verdict verdict = Verdict::unexplained;
  Fit plain, calibrated, best;      // the case as it is; with fitted materials; with effects
  std::vector<std::string> alarms;  // materials that pay for something
  std::vector<Round> rounds;
  std::vector<Round> nameless;  // unexplained: factors on parts
  Fit nameless_best;
  std::vector<Advice> advice;
  Detection detection;      // beside what was found
  DiagnosisProblem judged;  // with the errors that it was judged by in the end
  double seconds = 0.0;
};
const char* verdict_name(Diagnosis::Verdict verdict);

/// `say` gets a line at each step. Throws InputError when there is nothing to compare.
Diagnosis diagnose(const DiagnosisProblem& problem, const DiagnosisSettings& settings,
                   const std::function<void(const std::string&)>& say);

/// Which sensor or quantity would tell the best trial of a round from another.
Advice advise(const DiagnosisProblem& problem, const Trial& best, const Trial& other);

}  // namespace voussoir
