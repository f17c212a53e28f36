// What a diagnosis starts from: the case, on a mesh that is quick to solve, and the measured features.
#pragma once
#include "io/case/case.h"
#include "io/measured/measured.h"
#include "solver/diagnosis/diagnose.h"
#include "solver/identify/fdd.h"
#include "solver/identify/ssi.h"

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
  // How modes were identified from recordings of ambient vibration; empty: they were not.
  std::shared_ptr<const SsiResult> ambient;
  std::shared_ptr<const Fdd> spectra;
};

/// Reads both and measures what the mesh does. Throws InputError.
DiagnosisInput diagnosis_input(const DiagnosisRequest& request);

/// "20 sensors", or "3 of 20 sensors" when the shapes of all modes know no others.
std::string sensors_used(const Features& features);

/// With usual standard deviations where none are given.
MeasuredFeature feature_of(const MeasuredMode& mode, std::size_t sensors);
/// Given modes, else those identified from the recordings. Sensors are on their blocks.
Features features_of(const Measured& measured, const Assembly& assembly);

}  // namespace voussoir
