#include "io/records/curve.h"

#include <charconv>
#include <cmath>
#include <optional>
#include <string_view>

#include "io/records/rows.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

/// Takes one number off the front of a line.
std::optional<double> take_number(std::string_view& line) {
  line.remove_prefix(std::min(line.find_first_not_of(column_separators), line.size()));
  std::string_view word = line.substr(0, line.find_first_of(column_separators));
  line.remove_prefix(word.size());
  if (word.starts_with('+')) word.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (error != std::errc() || end != word.data() + word.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

}  // namespace

Curve parse_curve(const std::string& text, const std::string& name) {
  Curve curve;
  std::string_view rest = text;
  for (std::size_t row = 1; !rest.empty(); ++row) {
    std::string_view line = rest.substr(0, rest.find('\n'));
    rest.remove_prefix(std::min(line.size() + 1, rest.size()));
    if (line.find_first_not_of(column_separators) == std::string_view::npos || line.starts_with('#')) continue;
    const std::string whole(line);
    const std::optional<double> x = take_number(line), y = x ? take_number(line) : std::nullopt;
    if (y) {
      curve.x.push_back(*x);
      curve.y.push_back(*y);
    } else if (!curve.x.empty()) {
      throw InputError("{}:{}: '{}' does not begin with two finite numbers, as the lines before it do", name, row,
                       whole.substr(0, whole.find('\r')));
    }
  }
  if (curve.x.size() < 2)
    throw InputError("{}: {} with two numbers. At least 2 are needed.", name,
                     counted(curve.x.size(), "line begins", "lines begin"));
  return curve;
}

}  // namespace voussoir
