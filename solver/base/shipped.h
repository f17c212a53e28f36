// Files of the program: its cases, and libraries that it loads on demand.
#pragma once
#include <string>

namespace voussoir {

/// Path of a file or folder of the source tree ("cases/validation"). It is searched in the current folder, in the
/// folder of the program, in the three folders above it (a build folder is in the source tree), and in share/voussoir
/// next to the folder of the program. The Python module first searches its own folder, the four folders above it, and
/// the prefix in which it is installed. Throws RunError with the searched folders.
std::string shipped(const std::string& path);

/// Absolute path of a library that the program loads ("libvoussoir_mesher.so"). It is searched in the folder of the
/// program, in the folder above it (for test programs), and in lib/voussoir next to the folder of the program (or
/// lib/x86_64-linux-gnu/voussoir on systems with such folders). The Python module first searches its own folder, the
/// two above it, and the prefix in which it is installed. The current folder is not searched because loaded code is
/// executed. Throws RunError with the searched folders.
std::string shipped_library(const std::string& name);

}  // namespace voussoir
