// The files of a diagnosis, as `voussoir diagnose` and the Python package write them.
#pragma once
#include <functional>
#include <string>

#include "tools/diagnosis/diagnosis_report.h"

namespace voussoir {

/// To be called before a diagnosis: throws InputError if copies of the records or the assembly of the case would
/// replace other files in the folder. Copies of an earlier diagnosis may be replaced.
void check_diagnosis_folder(const Case& c, const std::string& directory);

/// Writes corrected.toml with copies of the records and the assembly that the case names, diagnosis.json, the shapes
/// for ParaView and, if `page`, diagnosis.html with its pictures. `say` receives a line if no picture can be drawn.
/// Throws RunError if a file cannot be written.
void write_diagnosis(const DiagnosisInput& input, const DiagnosisResult& result, const std::string& directory,
                     bool page, const std::function<void(const std::string&)>& say);

}  // namespace voussoir
