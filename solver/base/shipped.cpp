#include "solver/base/shipped.h"

#include <fmt/ranges.h>

#include <filesystem>
#include <vector>

#include "built_with.h"  // made by CMakeLists.txt
#include "solver/base/error.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

/// The program's folder and those above it, `count` in all, and a folder beside the program's; none where the system
/// does not say which program runs.
std::vector<std::string> folders_of_program(int count, const char* installed) {
  std::error_code error;
  fs::path folder = fs::read_symlink("/proc/self/exe", error).parent_path();
  if (error) return {};
  std::vector<std::string> folders;
  folders.push_back((folder.parent_path() / installed).string());
  for (int up = 0; up < count; ++up, folder = folder.parent_path()) folders.push_back(folder.string());
  return folders;
}

std::string found_in(const std::vector<std::string>& folders, const std::string& path) {
  std::error_code ignored;
  for (const std::string& folder : folders)
    if (std::string there = folder + "/" + path; fs::exists(there, ignored)) return there;
  throw RunError(
      "'{}', which comes with the program, is in none of these folders: {}; run the program where it was built or "
      "installed, or copy the file beside it",
      path, fmt::join(folders, ", "));
}

}  // namespace

std::string shipped(const std::string& path) {
  std::error_code ignored;
  if (fs::exists(path, ignored)) return path;
  return found_in(folders_of_program(4, "share/voussoir"), path);
}

std::string shipped_library(const std::string& name) {
  return found_in(folders_of_program(2, VOUSSOIR_LIBRARY_FOLDER), name);
}

}  // namespace voussoir
