// Files of the program: its cases, and libraries that it loads on demand.
#pragma once
#include <string>

namespace voussoir {

/// Path of a file or folder of the source tree ("cases/validation"). It is searched in this order: the current folder,
/// share/voussoir next to the folder of the program, the folder of the program, and the three folders above it (a build
/// folder is in the source tree). Directly after the current folder, the Python module also searches its own folder,
/// the four folders above it, and share/voussoir in the prefix in which it is installed. Throws RunError with the
/// searched folders.
std::string shipped(const std::string& path);

/// Absolute path of a library that the program loads ("libvoussoir_mesher.so"). It is searched in this order:
/// lib/voussoir next to the folder of the program (or lib/x86_64-linux-gnu/voussoir on systems with such folders), the
/// folder of the program, and the folder above it (for test programs). The Python module first searches its own folder,
/// the two above it, and the prefix in which it is installed. The current folder is not searched because loaded code is
/// executed. Throws RunError with the searched folders.
std::string shipped_library(const std::string& name);

}  // namespace voussoir
