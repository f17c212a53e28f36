// Runs a diagnosis from the request to its result.
#pragma once
#include "tools/diagnosis/diagnosis_report.h"

namespace voussoir {

/// Finds the effects that the case lacks, fits them on the mesh of the case, and computes the case as it is and the
/// corrected case. `say` gets a progress line at each stage. If a run under the recorded motion fails, `say` gets its
/// reason and the result does not contain it. Throws InputError if there is nothing to compare.
DiagnosisResult diagnose_case(const DiagnosisInput& input, const DiagnosisRequest& request,
                              const std::function<void(const std::string&)>& say);

}  // namespace voussoir
