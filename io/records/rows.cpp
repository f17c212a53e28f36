#include "io/records/rows.h"

#include <algorithm>
#include <charconv>
#include <cmath>

#include "solver/base/error.h"

namespace voussoir {

std::vector<std::string_view> lines_of(std::string_view text) {
  std::vector<std::string_view> lines;
  while (!text.empty()) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    if (line.ends_with('\r')) line.remove_suffix(1);
    lines.push_back(line);
  }
  return lines;
}

std::string_view trimmed(std::string_view text) {
  constexpr std::string_view blanks = " \t\r";
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) - begin + 1);
}

double number_in(std::string_view word, const std::string& name, std::size_t row, std::string_view rule) {
  std::string_view digits = word;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size())
    throw InputError("{}:{}: '{}' is not a number: {}", name, row, word.substr(0, 60), rule);
  if (!std::isfinite(value)) throw InputError("{}:{}: {} is not a finite number: mend the record", name, row, word);
  return value;
}

void append_numbers(std::string_view line, std::string_view separators, const std::string& name, std::size_t row,
                    std::string_view rule, std::vector<double>& values) {
  while (true) {
    const std::size_t begin = line.find_first_not_of(separators);
    if (begin == std::string_view::npos) return;
    line.remove_prefix(begin);
    const std::size_t length = std::min(line.find_first_of(separators), line.size());
    values.push_back(number_in(line.substr(0, length), name, row, rule));
    line.remove_prefix(length);
  }
}

}  // namespace voussoir
