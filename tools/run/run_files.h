// The files of a finished run.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

#include "io/case/case.h"
#include "io/hdf5/history_file.h"

namespace voussoir {

struct RunFiles {
  std::string directory, name;  // name: the folder's own
  Case c;
  nlohmann::json summary;
  History history;  // empty if there is no history.h5

  /// A member of the summary, or an empty object.
  const nlohmann::json& of(const char* key) const;
  const std::vector<StageSettings>& stages() const { return c.settings.stages; }
  /// Whether the last stage ended in an equilibrium, so that the last row of the history is at rest.
  bool ends_at_rest() const {
    return !stages().empty() && !stages().back().timed() && !of("collapse").value("found", false);
  }
};

/// The text of a file; empty if there is no such file.
std::string text_if_any(const std::string& path);

/// Reads the files of a run. Throws InputError if the directory is not a run directory or the run has not ended.
RunFiles read_run(const std::string& directory);

}  // namespace voussoir
