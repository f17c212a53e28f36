// What is said of a file that no format recognises.
#pragma once
#include <string>
#include <string_view>

namespace voussoir {

/// Throws InputError "NAME:1: …" with the file's first line or the name of its format where that is known, what is
/// read, and how columns are made of it.
[[noreturn]] void not_read(std::string_view text, const std::string& name);

}  // namespace voussoir
