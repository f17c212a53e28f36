// Printing of remarks on the input.
#pragma once
#include <fmt/format.h>

#include <functional>
#include <string>
#include <vector>

namespace voussoir {

/// Prints each remark on its own line to the error stream, so that tables on the standard output stay intact. Prints
/// nothing if quiet.
inline std::function<void(const std::string&)> remarks_to(bool quiet) {
  return [quiet](const std::string& text) {
    if (!quiet) fmt::print(stderr, "remark: {}\n", text);
  };
}

inline void say_remarks(const std::vector<std::string>& remarks, bool quiet) {
  for (const std::string& text : remarks) remarks_to(quiet)(text);
}

}  // namespace voussoir
