#include "solver/base/shipped.h"

#include <dlfcn.h>
#include <fmt/ranges.h>

#include <filesystem>
#include <vector>

#include "built_with.h"  // made by CMakeLists.txt
#include "solver/base/error.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

/// The folder of a file and those above it, `count` in all.
void add_folders(const fs::path& file, int count, std::vector<std::string>& folders) {
  fs::path folder = file.parent_path();
  for (int up = 0; up < count; ++up, folder = folder.parent_path()) folders.push_back(folder.string());
}

/// The folder of the program and the folders above it, `count` in all, and a folder next to that of the program; none
/// if the system does not say which program runs. If this code is part of a shared library (the Python module, whose
/// program is Python), the folders of that library come first; it lies one folder deeper.
std::vector<std::string> folders_of_program(int count, const char* installed) {
  std::error_code error;
  const fs::path program = fs::read_symlink("/proc/self/exe", error);
  if (error) return {};
  std::vector<std::string> folders;
  Dl_info us{};
  static const char here = 0;
  if (dladdr(&here, &us) != 0 && us.dli_fname != nullptr) {
    const fs::path library = fs::canonical(us.dli_fname, error);
    if (!error && library != program) {
      add_folders(library, count + 1, folders);
      // As installed: PREFIX/lib/pythonX/site-packages/voussoir.
      const fs::path prefix = library.parent_path().parent_path().parent_path().parent_path().parent_path();
      folders.push_back((prefix / installed).string());
    }
  }
  folders.push_back((program.parent_path().parent_path() / installed).string());
  add_folders(program, count, folders);
  return folders;
}

std::string found_in(const std::vector<std::string>& folders, const std::string& path) {
  std::error_code ignored;
  for (const std::string& folder : folders)
    if (std::string there = folder + "/" + path; fs::exists(there, ignored)) return there;
  throw RunError(
      "the file '{}' of the program is in none of these folders: {}. Run the program where it was built or installed, "
      "or copy the file into the folder of the program.",
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
