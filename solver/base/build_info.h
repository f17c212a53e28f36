// Identification of this program, for report pages and for --version.
#pragma once
#include <string>

namespace voussoir {

/// "0.2.0".
std::string program_version();
/// Commit of the sources, ten digits, with "-dirty" if they were changed; "unknown" outside a repository.
std::string build_commit();
/// "g++ 12.2.0".
std::string build_compiler();
/// Libraries and versions of the build: "Eigen 3.4.0, VTK 9.1.0, …".
std::string build_libraries();

}  // namespace voussoir
