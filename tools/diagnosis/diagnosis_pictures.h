// Pictures of a diagnosis: the sensors on the bridge, where model and measurement disagree, and the measured modes
// before and after.
#pragma once
#include "tools/diagnosis/diagnosis_page.h"
#include "tools/diagnosis/diagnosis_report.h"

namespace voussoir {

/// Where the sensors are, drawn into a file. Throws as render_picture().
PagePicture sensor_picture(const Assembly& assembly, const std::vector<Sensor>& sensors, const std::string& png);

/// Draws them into DIRECTORY/images. A display that does not start is said and leaves what was drawn.
std::vector<PagePicture> draw_diagnosis(const DiagnosisInput& input, const DiagnosisResult& result,
                                        const std::string& directory,
                                        const std::function<void(const std::string&)>& say);

}  // namespace voussoir
