#include "tools/run/run_files.h"

#include <filesystem>

#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "solver/base/json_file.h"

namespace voussoir {

namespace fs = std::filesystem;

RunFiles read_run(const std::string& directory) {
  std::error_code ignored;
  if (!fs::exists(directory + "/case.toml", ignored))
    throw InputError("{} is not a run directory: it has no case.toml. Give the folder that voussoir run wrote",
                     directory);
  if (!fs::exists(directory + "/summary.json", ignored))
    throw InputError("{} has no summary.json, because the run has not ended. Continue it with 'voussoir resume {}'.",
                     directory, directory);
  RunFiles files;
  files.directory = directory;
  files.name = fs::weakly_canonical(directory).filename().string();
  files.c = read_case(directory + "/case.toml");
  files.summary = json_if_any(directory + "/summary.json");
  if (!files.summary.is_object()) throw InputError("{}/summary.json is damaged. Run the case again", directory);
  if (fs::exists(directory + "/history.h5", ignored)) files.history = History::load(directory + "/history.h5");
  return files;
}

std::string text_if_any(const std::string& path) {
  std::error_code ignored;
  return fs::exists(path, ignored) ? read_text(path) : std::string();
}

const nlohmann::json& RunFiles::of(const char* key) const {
  static const nlohmann::json nothing = nlohmann::json::object();
  const auto found = summary.find(key);
  return found != summary.end() && found->is_object() ? *found : nothing;
}

}  // namespace voussoir
