// What a finished run has left in its folder.
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
  History history;  // empty where there is none

  /// A member of the summary, or an empty object.
  const nlohmann::json& of(const char* key) const;
  const std::vector<StageSettings>& stages() const { return c.settings.stages; }
  /// The last stage ended in an equilibrium: what stands in the last row is at rest.
  bool ends_at_rest() const {
    return !stages().empty() && !stages().back().timed() && !of("collapse").value("found", false);
  }
};

/// What a file holds; empty where there is none.
std::string text_if_any(const std::string& path);

/// Throws InputError when the directory is no run or has not been finished.
RunFiles read_run(const std::string& directory);

}  // namespace voussoir
