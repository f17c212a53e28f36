// The input of a diagnosis: the case and the measured features.
#pragma once
#include "solver/diagnosis/diagnose.h"
#include "tools/diagnosis/identification.h"

namespace voussoir {

struct DiagnosisRequest {
  Case c;                              // the case, which may have been read for its geometry
  std::string measured, directory;     // folder of the measurements, folder for the results
  double model_error = 0.005;          // relative error of frequencies, in addition to that of the mesh
  double shape_error = 0.005;          // error of shapes as a share of the largest component, in addition to that of
                                       // the mesh
  std::vector<std::string> hold_back;  // names of modes
  DiagnosisSettings settings;
  int most_modes = 10;        // number of modes identified from recordings that are used, the lowest ones
  double run_seconds = 10.0;  // s; part of a recording with ground motion for which the explicit solver is run
  bool quiet = false, page = true;
};

struct DiagnosisInput {
  Case c;
  Measured measured;
  DiagnosisProblem problem;
  DiagnosisProblem runs;             // the same problem on a mesh that is coarse enough for the explicit solver
  std::vector<std::string> without;  // effects that the user excludes
  Identification identification;
};

/// A plan of measurements.
struct MeasurementPlan {
  std::string sensors;  // a file like measured/sensors.csv
  int modes = 6;        // number of modes: the lowest ones that are not local
  double noise = 0.01;  // relative standard deviation of periods; that of shapes is twice as large
};

/// The input as if the plan had been measured on the case itself, without errors but with standard deviations. Throws
/// InputError.
DiagnosisInput planned_input(const DiagnosisRequest& request, const MeasurementPlan& plan);

/// Reads the measurements and estimates the error of the mesh. Throws InputError.
DiagnosisInput diagnosis_input(const DiagnosisRequest& request);

}  // namespace voussoir
