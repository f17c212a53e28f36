// Digests of files, by which someone else can tell whether theirs is the same.
#pragma once
#include <string>

namespace voussoir {

/// SHA-256 (FIPS 180-4) in hexadecimal digits, as sha256sum prints it. Throws RunError when the file cannot be read.
std::string sha256_of_file(const std::string& path);

}  // namespace voussoir
