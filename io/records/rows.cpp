#include "io/records/rows.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <limits>

#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/words.h"

namespace voussoir {

namespace {

constexpr double largest_number = 1e12;
constexpr double smallest_step = 1e-5, largest_step = 1.0;  // s
constexpr double most_samples = 1e8;

/// The fields of a row; empty if one of them is not a number.
std::vector<double> fields_of(std::string_view line, const FixedRows& rows) {
  std::vector<double> values;
  for (std::size_t begin = 0; begin < line.size() && values.size() < rows.per_row; begin += rows.width) {
    const std::string_view word = trimmed(line.substr(begin, rows.width));
    if (word.empty()) break;
    if (!all_numbers(word, " \t") || word.find_first_of(" \t") != std::string_view::npos) return {};
    values.push_back(number_in(word, "", 0, ""));
  }
  return values;
}

}  // namespace

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

bool is_digit(char c) {
  return std::isdigit(static_cast<unsigned char>(c));
}

std::string_view excerpt(std::string_view text) {
  return trimmed(text).substr(0, 100);
}

std::string upper(std::string_view text) {
  std::string word(text);
  for (char& c : word) c = char(std::toupper(static_cast<unsigned char>(c)));
  return word;
}

double number_in(std::string_view word, const std::string& name, std::size_t row, std::string_view rule) {
  std::string_view digits = word;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size())
    throw InputError("{}:{}: '{}' is not a number: {}", name, row, word.substr(0, 60), rule);
  if (!std::isfinite(value))
    throw InputError("{}:{}: {} is not a finite number: correct the record", name, row, word.substr(0, 60));
  if (!(std::abs(value) <= largest_number))
    throw InputError("{}:{}: the number {} is too large. It must be at most {:g} in size. Correct the record.", name,
                     row, word.substr(0, 60), largest_number);
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

double first_number(std::string_view text) {
  for (std::size_t i = 0; i < text.size(); ++i) {
    double value = 0.0;
    const auto [end, error] = std::from_chars(text.data() + i, text.data() + text.size(), value);
    const bool begins = std::isdigit(static_cast<unsigned char>(text[i])) || text[i] == '.' || text[i] == '-';
    if (begins && error == std::errc() && std::isfinite(value)) return value;
  }
  return std::numeric_limits<double>::quiet_NaN();
}

bool all_numbers(std::string_view line, std::string_view separators) {
  const std::vector<std::string_view> words = words_of(line, separators);
  return !words.empty() && std::ranges::all_of(words, [](std::string_view word) {
    if (word.starts_with('+')) word.remove_prefix(1);
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    return error != std::errc::invalid_argument && end == word.data() + word.size();
  });
}

std::vector<double> fixed_numbers(const std::vector<std::string_view>& lines, std::size_t& at, std::size_t count,
                                  const FixedRows& rows, const std::string& name) {
  std::vector<double> values;
  for (; values.size() < count; ++at) {
    if (at >= lines.size()) not_whole(name, values.size(), count);
    const std::size_t wanted = std::min(rows.per_row, count - values.size());
    std::vector<double> row = all_numbers(lines[at], " \t") && words_of(lines[at]).size() == wanted
                                  ? std::vector<double>{}
                                  : fields_of(lines[at], rows);
    if (row.empty())
      append_numbers(lines[at], " \t", name, at + 1,
                     fmt::format("rows must be {} numbers of {} columns each", rows.per_row, rows.width), row);
    if (row.size() < wanted)
      throw InputError(
          "{}:{}: after {} of {} a row has fewer than {} numbers: the file is incomplete; download it again", name,
          at + 1, values.size() + row.size(), counted(count, "sample"), rows.per_row);
    values.insert(values.end(), row.begin(), row.begin() + std::ptrdiff_t(wanted));
  }
  return values;
}

double checked_step(double step, const std::string& name, std::size_t row) {
  if (!(step >= smallest_step && step <= largest_step))
    throw InputError("{}:{}: the time step is {:g} s. It must be from {:g} to {:g} s. Correct the heading.", name, row,
                     step, smallest_step, largest_step);
  return step;
}

std::size_t checked_samples(double samples, const std::string& name, std::size_t row) {
  if (!(samples >= 2.0 && samples <= most_samples) || samples != std::floor(samples))
    throw InputError(
        "{}:{}: the number of samples is {:g}. It must be a whole number from 2 to {:g}. Correct the heading.", name,
        row, samples, most_samples);
  return std::size_t(samples);
}

void not_whole(const std::string& name, std::size_t samples, std::size_t expected) {
  throw InputError("{}: only {} of {}: the file is incomplete; download it again", name, samples,
                   counted(expected, "sample"));
}

}  // namespace voussoir
