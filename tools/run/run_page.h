// The page of a run: one HTML file to look at, to print and to send on.
#pragma once
#include <string>

namespace voussoir {

/// DIRECTORY/report.html from the run's own files (case.toml, summary.json, history.h5, images): what happened in
/// words, damage, demands, histories, energies, response spectra, pictures. Nothing is computed anew, so old runs can
/// have one. Throws InputError when the directory is no run or has not been finished; what else is missing is left out.
void write_run_page(const std::string& directory);

}  // namespace voussoir
