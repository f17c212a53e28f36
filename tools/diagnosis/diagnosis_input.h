// What a diagnosis starts from: the case, on a mesh that is quick to solve, and the measured features.
#pragma once
#include "solver/diagnosis/diagnose.h"
#include "tools/diagnosis/identification.h"

namespace voussoir {

struct DiagnosisRequest {
  std::string case_file, measured, directory;
  int unknowns = 12000;                // of the mesh that effects are looked for on, at most
  double model_error = 0.01;           // of frequencies, beside what the mesh does
  double shape_error = 0.01;           // of shapes, share of the largest component, beside what the mesh does
  std::vector<std::string> hold_back;  // names of modes
  DiagnosisSettings settings;
  int most_modes = 10;        // of those that are identified from recordings: the lowest
  double run_seconds = 10.0;  // of a recording with the ground's motion that the explicit solver is run for
  bool quiet = false, page = true;
};

struct DiagnosisInput {
  Case c;
  Measured measured;
  DiagnosisProblem full, coarse;  // the case's own mesh; the one that is searched on
  bool coarsened = false;
  double block_scale = 0.0;          // of the coarse mesh; 0: it has none
  std::vector<std::string> without;  // effects that are not tried
  Identification identification;
};

/// Reads both and measures what the mesh does. Throws InputError.
DiagnosisInput diagnosis_input(const DiagnosisRequest& request);

}  // namespace voussoir
