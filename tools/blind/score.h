// Compares a diagnosis with the hidden effects.
#pragma once
#include "tools/blind/run_trial.h"

namespace voussoir {

struct Outcome {
  const BlindTrial* trial = nullptr;
  std::size_t number = 0;            // from 1
  std::vector<std::string> effects;  // the hidden effects, see TrialRun
  std::string said;                  // verdict and effects, in words; "failed: …"
  double score = 0.0;                // also 0 for a failed trial
  double probability = 0.0;          // probability of the first effect
  bool wrong = false, false_alarm = true;
  bool placed = false;               // for an effect outside the library: the place is right, whatever the name
  int values = 0, values_right = 0;  // values of hidden effects that were named
  int faults = 0, faults_right = 0;  // faults of sensors
  // Root mean square residuals, standard deviations: of the fitted data before and after the diagnosis, and of the data
  // that were not fitted.
  double gap_before = 0.0, gap_after = 0.0, held_back = 1e9;
  double trace = -1.0;   // see TrialRun
  double seconds = 0.0;  // s, wall-clock time of the trial
};

/// Smallest trace (see TrialRun) for which the evidence can be sufficient to name an effect. In log probabilities, the
/// evidence must exceed about 5 (the effect is at one of 150 places) plus a margin, and it is at most half of the
/// trace. This limit was set for a margin of 2.3; see DiagnosisSettings::margin for the present one.
inline constexpr double shows = 15.0;

/// Verdict and effects in words: "found; abutment_restraint at both (1.00)".
std::string said_text(const nlohmann::json& diagnosis);

/// Fills in the scores of the outcome. A probability above `confident` counts as confident.
void score(const TrialRun& run, double confident, Outcome& outcome);

/// Markdown tables of a suite: scores with the aims, confusion, and all trials.
std::string scores_table(const std::vector<Outcome>& all, const Suite& suite);
std::string confusion_table(const std::vector<Outcome>& all);
std::string trials_table(const std::vector<Outcome>& all);

}  // namespace voussoir
