// Folders for what is written.
#pragma once
#include <string>

namespace voussoir {

/// Makes the folder that `path` lies in, with those above it. Throws RunError naming it when that cannot be done.
void make_folder_of(const std::string& path);

}  // namespace voussoir
