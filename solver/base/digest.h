// Digests of files, for comparison with other copies.
#pragma once
#include <string>

namespace voussoir {

/// SHA-256 (FIPS 180-4) in hexadecimal digits, as sha256sum prints it. Throws RunError if the file cannot be read.
std::string sha256_of_file(const std::string& path);

}  // namespace voussoir
