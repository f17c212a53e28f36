// Splits lines into words.
#pragma once
#include <string_view>
#include <vector>

namespace voussoir {

/// The words of a line between `separators`.
inline std::vector<std::string_view> words_of(std::string_view line, std::string_view separators = " \t") {
  std::vector<std::string_view> words;
  while (true) {
    const std::size_t begin = line.find_first_not_of(separators);
    if (begin == std::string_view::npos) return words;
    line.remove_prefix(begin);
    words.push_back(line.substr(0, line.find_first_of(separators)));
    line.remove_prefix(words.back().size());
  }
}

}  // namespace voussoir
