#include "io/records/columns.h"

#include <charconv>
#include <cmath>
#include <string_view>

#include "io/hdf5/atomic_file.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

constexpr double even = 1e-6;  // s
constexpr std::string_view separators = " \t,;\r";

struct Row {
  std::size_t number = 0;  // line in the file, from 1
  std::vector<double> values;
};

double parse_number(std::string_view word, const std::string& name, std::size_t row) {
  std::string_view digits = word;
  if (digits.starts_with('+')) digits.remove_prefix(1);
  double value = 0.0;
  const auto [end, error] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
  if (error != std::errc() || end != digits.data() + digits.size())
    throw InputError("{}:{}: '{}' is not a number: rows must be numbers, headings begin with #", name, row, word);
  if (!std::isfinite(value)) throw InputError("{}:{}: {} is not a finite number: mend the record", name, row, word);
  return value;
}

std::vector<Row> parse_rows(std::string_view text, const std::string& name) {
  std::vector<Row> rows;
  for (std::size_t number = 1; !text.empty(); ++number) {
    const std::size_t end = text.find('\n');
    std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    line = line.substr(0, line.find('#'));
    Row row{number, {}};
    while (true) {
      const std::size_t begin = line.find_first_not_of(separators);
      if (begin == std::string_view::npos) break;
      line.remove_prefix(begin);
      const std::size_t length = std::min(line.find_first_of(separators), line.size());
      row.values.push_back(parse_number(line.substr(0, length), name, number));
      line.remove_prefix(length);
    }
    if (!row.values.empty()) rows.push_back(std::move(row));
  }
  return rows;
}

void check_order(const std::vector<Row>& rows, const std::string& name) {
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (const double t = rows[i].values[0], before = rows[i - 1].values[0]; !(t > before))
      throw InputError("{}:{}: time {} s after {} s: times must increase", name, rows[i].number, t, before);
}

/// The step of the times in the first column.
double time_step(const std::vector<Row>& rows, const std::string& name) {
  check_order(rows, name);
  const double first = rows.front().values[0], dt = (rows.back().values[0] - first) / double(rows.size() - 1);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double t = rows[i].values[0], before = rows[i - 1].values[0];
    if (std::abs(t - before - dt) > even)
      throw InputError(
          "{}:{}: time step {:.9g} s, elsewhere {:.9g} s: steps must be equal within {} s; resample the record, or "
          "give accelerations alone and the key 'dt'",
          name, rows[i].number, t - before, dt, even);
  }
  return dt;
}

}  // namespace

Record parse_columns(const std::string& text, const std::string& name, double dt) {
  const std::vector<Row> rows = parse_rows(text, name);
  if (rows.size() < 2) throw InputError("{}: {} rows of numbers, expected at least 2", name, rows.size());
  const std::size_t columns = dt > 0.0 ? 1 : 2;
  for (const Row& row : rows)
    if (row.values.size() != columns)
      throw InputError("{}:{}: {} columns, expected {}", name, row.number, row.values.size(),
                       columns == 1 ? "1 (acceleration) because 'dt' is given"
                                    : "2 (time in s, acceleration); for a single column give the key 'dt' in s");
  Record record;
  record.dt = columns == 1 ? dt : time_step(rows, name);
  for (const Row& row : rows) record.values.push_back(row.values.back());
  return record;
}

Record read_columns(const std::string& path, double dt) {
  return parse_columns(read_text(path), path, dt);
}

}  // namespace voussoir
