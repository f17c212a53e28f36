// The page of a run: one self-contained HTML file.
#pragma once
#include <string>

namespace voussoir {

/// Writes DIRECTORY/report.html from the files of the run (case.toml, summary.json, history.h5, images): results in
/// words, damage, demands, histories, energies, response spectra, pictures. It computes nothing again, so runs of
/// earlier versions can have a page. Throws InputError if the directory is not a run directory or the run has not
/// ended. A section whose files are missing is left out.
void write_run_page(const std::string& directory);

}  // namespace voussoir
