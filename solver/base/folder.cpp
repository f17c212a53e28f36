#include "solver/base/folder.h"

#include <filesystem>

#include "solver/base/error.h"

namespace voussoir {

void make_folder_of(const std::string& path) {
  const std::filesystem::path folder = std::filesystem::path(path).parent_path();
  if (folder.empty()) return;
  std::error_code error;
  std::filesystem::create_directories(folder, error);
  if (error) throw RunError("cannot create the folder {}: {}. Choose another folder", folder.string(), error.message());
}

}  // namespace voussoir
