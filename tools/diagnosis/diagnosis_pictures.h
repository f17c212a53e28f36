// Pictures of a diagnosis: the sensors on the bridge, where model and measurement disagree, and the measured modes
// before and after.
#pragma once
#include "tools/diagnosis/diagnosis_page.h"
#include "tools/diagnosis/diagnosis_report.h"

namespace voussoir {

/// Draws the positions of the sensors into a file. Throws like render_picture().
PagePicture sensor_picture(const Assembly& assembly, const std::vector<Sensor>& sensors, const std::string& png);

/// Draws the pictures into DIRECTORY/images. If the display does not start, `say` gets the reason and the function
/// returns the pictures drawn so far.
std::vector<PagePicture> draw_diagnosis(const DiagnosisInput& input, const DiagnosisResult& result,
                                        const std::string& directory,
                                        const std::function<void(const std::string&)>& say);

}  // namespace voussoir
