// The page of a diagnosis: one HTML file to look at, to print and to send on.
#pragma once
#include "tools/diagnosis/diagnosis_report.h"
#include "viz/page/html.h"

namespace voussoir {

/// One self-contained HTML page: no scripts, nothing from elsewhere. The same input and result give the same text: it
/// holds no date and no times of computing.
std::string diagnosis_page(const DiagnosisInput& input, const DiagnosisResult& result,
                           const std::vector<PagePicture>& pictures);

}  // namespace voussoir
