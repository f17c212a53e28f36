// The error for a file that no format recognises.
#pragma once
#include <string>
#include <string_view>

namespace voussoir {

/// Throws InputError "NAME:1: …" with the first line of the file or, if known, the name of its format, the known
/// formats, and how to convert other files.
[[noreturn]] void not_read(std::string_view text, const std::string& name);

}  // namespace voussoir
