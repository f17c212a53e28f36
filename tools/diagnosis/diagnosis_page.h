// The page of a diagnosis: one HTML file.
#pragma once
#include "tools/diagnosis/diagnosis_report.h"
#include "viz/page/html.h"

namespace voussoir {

/// One self-contained HTML page without scripts and external files. The same input and result give the same text,
/// except for the computing time of runs under a recorded motion.
std::string diagnosis_page(const DiagnosisInput& input, const DiagnosisResult& result,
                           const std::vector<PagePicture>& pictures);

}  // namespace voussoir
