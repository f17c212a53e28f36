// Charts of a diagnosis, each an SVG text. Measured is a black full circle, the case as it was a vermilion hollow
// square, with fitted materials alone a green hollow diamond, as corrected a blue full triangle.
#pragma once
#include "tools/diagnosis/diagnosis_report.h"

namespace voussoir {

/// Gaps of the case, with fitted materials and as corrected, of the data that were fitted and of those that were not.
struct GapRow {
  std::string data;
  double before = 0.0, materials = 0.0, after = 0.0;
};
std::vector<GapRow> gap_rows(const DiagnosisResult& result);
std::string gap_chart(const std::vector<GapRow>& rows);

std::string periods_chart(const std::vector<ModeComparison>& modes);
/// Of frequencies, in standard deviations.
std::string deviations_chart(const std::vector<ModeComparison>& modes);
/// Modal assurance of each measured mode and its partner; empty where none has a shape.
std::string assurance_chart(const std::vector<ModeComparison>& modes);
/// Measured by computed, of the corrected case; empty where none has a shape.
std::string assurance_matrix(const DiagnosisInput& input, const DiagnosisResult& result);
/// Readings of the sensors in a mode, along each axis from one end to the other; empty where it has no shape.
std::string shape_chart(const DiagnosisInput& input, const DiagnosisResult& result, std::size_t mode);
/// Empty where nothing could be located.
std::string where_chart(const Location& before, const Location& after);
std::string probability_chart(const Round& round);
/// Fitted materials in standard deviations of what is likely; empty where the model has none.
std::string materials_chart(const Diagnosis& diagnosis);

}  // namespace voussoir
