// A diagnosis from the request to its result.
#pragma once
#include "tools/diagnosis/diagnosis_report.h"

namespace voussoir {

/// Looks for what the case lacks, fits it on the case's own mesh, and computes the corrected case beside the case as it
/// is. `say` gets a line at each step. Throws InputError when there is nothing to compare. A run under the recorded
/// motion that fails is said and leaves the result without it.
DiagnosisResult diagnose_case(const DiagnosisInput& input, const DiagnosisRequest& request,
                              const std::function<void(const std::string&)>& say);

}  // namespace voussoir
