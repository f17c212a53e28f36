// Remarks on what was read, for people.
#pragma once
#include <fmt/format.h>

#include <functional>
#include <string>
#include <vector>

namespace voussoir {

/// Prints a remark on a line of its own, to the error stream, so that a table on the other one stays whole; nothing
/// when quiet.
inline std::function<void(const std::string&)> remarks_to(bool quiet) {
  return [quiet](const std::string& text) {
    if (!quiet) fmt::print(stderr, "remark: {}\n", text);
  };
}

inline void say_remarks(const std::vector<std::string>& remarks, bool quiet) {
  for (const std::string& text : remarks) remarks_to(quiet)(text);
}

}  // namespace voussoir
