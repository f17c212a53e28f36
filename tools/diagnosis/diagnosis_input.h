// What a diagnosis starts from: the case and the measured features.
#pragma once
#include "solver/diagnosis/diagnose.h"
#include "tools/diagnosis/identification.h"

namespace voussoir {

struct DiagnosisRequest {
  Case c;                              // read for its geometry
  std::string measured, directory;     // where the measurements are, and where to
  double model_error = 0.005;          // of frequencies, beside what the mesh does
  double shape_error = 0.005;          // of shapes, share of the largest component, beside what the mesh does
  std::vector<std::string> hold_back;  // names of modes
  DiagnosisSettings settings;
  int most_modes = 10;        // of those that are identified from recordings: the lowest
  double run_seconds = 10.0;  // of a recording with the ground's motion that the explicit solver is run for
  bool quiet = false, page = true;
};

struct DiagnosisInput {
  Case c;
  Measured measured;
  DiagnosisProblem problem;
  DiagnosisProblem runs;             // the same on a mesh that the explicit solver is quick on
  std::vector<std::string> without;  // effects that are not tried
  Identification identification;
};

/// Measurements that are to be made.
struct MeasurementPlan {
  std::string sensors;  // a file like measured/sensors.csv
  int modes = 6;        // the lowest that are not local
  double noise = 0.01;  // standard deviation of periods, share; of shapes twice that
};

/// As if the plan had been measured on the case itself, without errors but with their deviations. Throws InputError.
DiagnosisInput planned_input(const DiagnosisRequest& request, const MeasurementPlan& plan);

/// Reads the measurements and finds what the mesh does. Throws InputError.
DiagnosisInput diagnosis_input(const DiagnosisRequest& request);

}  // namespace voussoir
