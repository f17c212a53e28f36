// What a diagnosis leaves: diagnosis.json, corrected.toml, a page to look at, and words for the terminal.
#pragma once
#include <nlohmann/json.hpp>

#include "solver/diagnosis/locate.h"
#include "tools/diagnosis/diagnosis_runs.h"

namespace voussoir {

/// One measured mode against the model before and after.
struct ModeComparison {
  std::string name, direction;
  bool held_back = false;
  double measured = 0.0, std = 0.0;                        // s
  double before = 0.0, after = 0.0;                        // s; 0: the model has no such mode
  double deviations_before = 0.0, deviations_after = 0.0;  // of the frequency
  double mac_before = 0.0, mac_after = 0.0;                // not finite without a shape
  std::string words_before, words_after;                   // of the computed mode
};

struct DiagnosisResult {
  Diagnosis diagnosis;
  Fit before, after;  // on the case's own mesh: the case as it is; the corrected one
  Fit calibrated;     // of which the corrected one has its materials
  std::vector<ModeComparison> modes;
  Location where, where_after;
  std::optional<RecordedMatch> recorded;  // the explicit solver under the recorded motion of the ground
  Case corrected;                         // the case with what was found
  std::string corrected_text;             // of corrected.toml
};

std::vector<ModeComparison> compare_modes(const DiagnosisProblem& problem, const Fit& before,
                                          const DiagnosisProblem& judged, const Fit& after);
nlohmann::json diagnosis_json(const DiagnosisInput& input, const DiagnosisResult& result);
std::string diagnosis_text(const DiagnosisInput& input, const DiagnosisResult& result);

}  // namespace voussoir
