#include "solver/base/shipped.h"

#include <fmt/ranges.h>

#include <filesystem>
#include <vector>

#include "solver/base/error.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

std::vector<std::string> shelves() {
  std::vector<std::string> folders = {"."};
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return folders;
  fs::path folder = program.parent_path();
  for (const char* installed : {"lib/voussoir", "share/voussoir"})
    folders.push_back((folder.parent_path() / installed).string());
  for (int up = 0; up < 4; ++up, folder = folder.parent_path()) folders.push_back(folder.string());
  return folders;
}

}  // namespace

std::string find_shipped(const std::string& path) {
  std::error_code ignored;
  for (const std::string& folder : shelves()) {
    const std::string there = folder == "." ? path : folder + "/" + path;
    if (fs::exists(there, ignored)) return there;
  }
  return {};
}

std::string shipped(const std::string& path) {
  std::string there = find_shipped(path);
  if (there.empty())
    throw RunError(
        "'{}', which comes with the program, is in none of these folders: {}; run the program where it was built or "
        "installed, or copy the file beside it",
        path, fmt::join(shelves(), ", "));
  return there;
}

}  // namespace voussoir
