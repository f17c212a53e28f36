// Output folders.
#pragma once
#include <string>

namespace voussoir {

/// Creates the folder that contains `path`, and its parents. Throws RunError with its name if that fails.
void make_folder_of(const std::string& path);

}  // namespace voussoir
