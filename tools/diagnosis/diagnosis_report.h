// The outputs of a diagnosis: diagnosis.json, corrected.toml, a page, and text for the terminal.
#pragma once
#include <nlohmann/json.hpp>

#include "solver/diagnosis/locate.h"
#include "tools/diagnosis/diagnosis_runs.h"

namespace voussoir {

/// Comparison of one measured mode with the model before and after the diagnosis.
struct ModeComparison {
  std::string name, direction;
  bool held_back = false;
  double measured = 0.0, std = 0.0;  // s
  double before = 0.0, after = 0.0;  // s; 0: the model has no such mode
  // Measured minus computed frequency, divided by the standard deviation of measurement and model together.
  double deviations_before = 0.0, deviations_after = 0.0;
  double mac_before = 0.0, mac_after = 0.0;  // not finite without a shape
  std::string words_before, words_after;     // of the computed mode
};

struct DiagnosisResult {
  Diagnosis diagnosis;
  Fit before, after;  // on the mesh of the case: the case as it is; the corrected case
  Fit calibrated;     // the fit that gives the materials of the corrected case
  std::vector<ModeComparison> modes;
  Location where, where_after;
  std::optional<RecordedMatch> recorded;  // response to the recorded ground motion by the explicit solver
  Case corrected;                         // the case with the effects found
  std::string corrected_text;             // text of corrected.toml
};

/// One entry for each measured mode, in order of frequency. `problem` has the standard deviations of `before`, and
/// `judged` those of `after`.
std::vector<ModeComparison> compare_modes(const DiagnosisProblem& problem, const Fit& before,
                                          const DiagnosisProblem& judged, const Fit& after);
/// Layout: docs/formats.md.
nlohmann::json diagnosis_json(const DiagnosisInput& input, const DiagnosisResult& result);
std::string diagnosis_text(const DiagnosisInput& input, const DiagnosisResult& result);

}  // namespace voussoir
