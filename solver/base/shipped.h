// Files that come with the program: its cases, and libraries that it loads when it needs them.
#pragma once
#include <string>

namespace voussoir {

/// Where a file or folder of the program's is, by its path in the source tree ("cases/validation") or by its name
/// ("libvoussoir_mesher.so"): in the present folder, beside the program, in the folders above it (a build folder lies
/// in the source tree), or in lib/voussoir and share/voussoir of where it is installed. Empty: in none of these.
std::string find_shipped(const std::string& path);

/// The same; throws RunError that names the folders that were looked at.
std::string shipped(const std::string& path);

}  // namespace voussoir
