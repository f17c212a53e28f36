// What this program is: for pages that are filed, and for --version.
#pragma once
#include <string>

namespace voussoir {

/// "0.2.0".
std::string program_version();
/// Of the sources it was built from, ten digits, with "-dirty" where they were changed since; "unknown" outside of a
/// repository.
std::string build_commit();
/// "g++ 12.2.0".
std::string build_compiler();
/// The libraries and the versions it was built with: "Eigen 3.4.0, VTK 9.1.0, …".
std::string build_libraries();

}  // namespace voussoir
