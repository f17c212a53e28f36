// Files that come with the program: its cases, and libraries that it loads when it needs them.
#pragma once
#include <string>

namespace voussoir {

/// Where a file or folder of the source tree is ("cases/validation"): in the present folder, in the program's, in one
/// of the three above it (a build folder lies in the source tree), or in share/voussoir beside the program's folder. In
/// the Python module, first in the module's folder or one of the four above it.
/// Throws RunError that names the folders that were searched.
std::string shipped(const std::string& path);

/// Where a library is that the program loads ("libvoussoir_mesher.so"), as an absolute path: in the program's folder,
/// in the one above it (test programs), or in lib/voussoir beside the program's folder (where the system has
/// them, in lib/x86_64-linux-gnu/voussoir). In the Python module, first in the module's folder or one of the two above
/// it. Never in the present folder: what is loaded is run. Throws RunError that names the folders that were searched.
std::string shipped_library(const std::string& name);

}  // namespace voussoir
