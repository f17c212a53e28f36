// Finds the effects that a model lacks (docs/theory/diagnosis.md): calibration of materials, screening by signatures,
// full fits, evidence, prediction of data that were not fitted, and effects added one at a time.
#pragma once
#include <optional>

#include "solver/diagnosis/detectable.h"

namespace voussoir {

struct DiagnosisSettings {
  int effects = 3;               // largest number of added effects
  int fits = 12;                 // candidates with a full fit in a round
  int iterations = 8;            // of each fit
  double margin = 3.0;           // log probability by which an effect must exceed "none"
  double further = 3.5;          // additional margin if an effect is already present: two are rarer than one
  double certain = 12.0;         // margin for a channel fault that is corrected before the search for effects
  double consistent = 0.02;      // a model is consistent if the probability of a larger misfit is above this
  double credible = 1e-3;        // a model with added effects is accepted down to this probability
  bool detectable = true;        // compute the least detectable amounts
  int further_measurements = 3;  // number of further sensors or modes that lower them most
  bool predict = true;           // an added effect must also improve the prediction of each mode from the others
  int threads = 1;
  std::vector<std::string> without;  // names of excluded effects
};

/// A candidate with its fit.
struct Trial {
  Candidate candidate;
  Fit fit;
  double probability = 0.0;  // among the trials of this round and "none"
  double signature = 0.0;    // collinearity with the signature of the best trial
  bool tie = false;          // cannot be distinguished from the best trial
};

struct Round {
  std::vector<Trial> trials;                                    // best first
  double none = 1.0;                                            // probability of "none"
  bool accepted = false;                                        // the first trial was accepted
  bool superseded = false;                                      // it was accepted, but a later effect made it
                                                                // unnecessary
  std::vector<std::pair<std::string, double>> screened;         // candidate and share of the misfit that it explains,
                                                                // best first
  std::vector<std::pair<std::string, std::string>> not_fitted;  // candidates whose fit failed, and the reason
};

/// A measurement that would distinguish two candidates.
struct Advice {
  std::string against;  // the other candidate
  std::string text;     // the measurement and the expected difference
};

struct Diagnosis {
  enum class Verdict { consistent, found, unexplained };
  Verdict verdict = Verdict::unexplained;
  Fit plain, calibrated, best;      // the unchanged case; with fitted materials; with effects
  std::vector<std::string> alarms;  // materials that compensate for a missing effect
  std::vector<Round> rounds;
  std::vector<Round> nameless;  // unexplained: factors on parts
  Fit nameless_best;
  std::vector<Advice> advice;
  Detection detection;      // in addition to the found effects
  DiagnosisProblem judged;  // with the errors of the final verdict
  double seconds = 0.0;
};
const char* verdict_name(Diagnosis::Verdict verdict);

/// Calls `say` with one line for each step of the search. Throws InputError if there are no measured modes.
Diagnosis diagnose(const DiagnosisProblem& problem, const DiagnosisSettings& settings,
                   const std::function<void(const std::string&)>& say);

/// Finds a sensor or quantity that distinguishes the best trial of a round from another trial.
Advice advise(const DiagnosisProblem& problem, const Trial& best, const Trial& other);

}  // namespace voussoir
