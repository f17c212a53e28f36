// What a diagnosis said against what was hidden.
#pragma once
#include "tools/blind/run_trial.h"

namespace voussoir {

struct Outcome {
  const BlindTrial* trial = nullptr;
  std::size_t number = 0;  // from 1
  std::vector<std::string> effects;
  std::string said;          // verdict and effects, in words; "failed: …"
  double score = 0.0;        // 0 also of a trial that failed
  double probability = 0.0;  // of the first effect
  bool wrong = false, false_alarm = true;
  bool placed = false;               // out of the library: the place is right, whatever it is called
  int values = 0, values_right = 0;  // of the hidden effects that were named
  int faults = 0, faults_right = 0;  // of sensors
  double gap_before = 0.0, gap_after = 0.0, held_back = 1e9;
  double trace = -1.0;  // see TrialRun
  double seconds = 0.0;
};

/// A candidate pays about 5 for being one of 150 places and must win by 2.3 (log probabilities): no evidence can name
/// what leaves less than twice that.
inline constexpr double shows = 15.0;

/// Verdict and effects in words: "found; abutment_restraint at both (1.00)".
std::string said_text(const nlohmann::json& diagnosis);

/// Fills in the outcome's score and the like; `confident`: a probability above this is.
void score(const TrialRun& run, double confident, Outcome& outcome);

/// Tables of a suite in Markdown: scores beside what is aimed at, confusion, and all trials.
std::string scores_table(const std::vector<Outcome>& all, const Suite& suite);
std::string confusion_table(const std::vector<Outcome>& all);
std::string trials_table(const std::vector<Outcome>& all);

}  // namespace voussoir
