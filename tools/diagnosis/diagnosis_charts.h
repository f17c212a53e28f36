// Charts of a diagnosis, each an SVG text. Black full circle: measured. Vermilion hollow square: the case as it is.
// Green hollow diamond: the case with fitted materials. Blue full triangle: the corrected case.
#pragma once
#include "tools/diagnosis/diagnosis_report.h"

namespace voussoir {

/// Gaps (root mean square residuals, in standard deviations) of the case as it is, with fitted materials and corrected,
/// for the fitted data and for the data that were not fitted.
struct GapRow {
  std::string data;
  double before = 0.0, materials = 0.0, after = 0.0;
};
std::vector<GapRow> gap_rows(const DiagnosisResult& result);
std::string gap_chart(const std::vector<GapRow>& rows);

std::string periods_chart(const std::vector<ModeComparison>& modes);
/// Residuals of frequencies in standard deviations.
std::string deviations_chart(const std::vector<ModeComparison>& modes);
/// Modal assurance criterion of each measured mode and its computed partner. Empty if no mode has a shape.
std::string assurance_chart(const std::vector<ModeComparison>& modes);
/// Modal assurance criterion of all pairs of a measured mode and a computed mode of the corrected case. Empty if no
/// mode has a shape.
std::string assurance_matrix(const DiagnosisInput& input, const DiagnosisResult& result);
/// Components of a mode shape at the sensors, along each axis in order of their position. Empty if the mode has no
/// shape.
std::string shape_chart(const DiagnosisInput& input, const DiagnosisResult& result, std::size_t mode);
/// Share of each part in the disagreement. Empty if nothing could be located.
std::string where_chart(const Location& before, const Location& after);
std::string probability_chart(const Round& round);
/// Fitted materials in standard deviations of their likely range. Empty if the model has none.
std::string materials_chart(const Diagnosis& diagnosis);

}  // namespace voussoir
