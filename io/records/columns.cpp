#include "io/records/columns.h"

#include <cmath>
#include <string_view>

#include "io/records/not_read.h"
#include "io/records/rows.h"
#include "solver/base/atomic_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

constexpr double even = 1e-6;  // s

struct Row {
  std::size_t number = 0;  // line in the file, from 1
  std::vector<double> values;
};

std::vector<Row> parse_rows(std::string_view text, const std::string& name) {
  std::vector<Row> rows;
  std::size_t number = 0;
  for (const std::string_view line : lines_of(text)) {
    Row row{++number, {}};
    append_numbers(line.substr(0, line.find('#')), column_separators, name, number,
                   "rows must be numbers, headings begin with #", row.values);
    if (!row.values.empty()) rows.push_back(std::move(row));
  }
  return rows;
}

void check_order(const std::vector<Row>& rows, const std::string& name) {
  for (std::size_t i = 1; i < rows.size(); ++i)
    if (const double t = rows[i].values[0], before = rows[i - 1].values[0]; !(t > before))
      throw InputError("{}:{}: the time {} s follows {} s. Times must increase.", name, rows[i].number, t, before);
}

/// The step of the times in the first column.
double time_step(const std::vector<Row>& rows, const std::string& name) {
  check_order(rows, name);
  const double first = rows.front().values[0], dt = (rows.back().values[0] - first) / double(rows.size() - 1);
  for (std::size_t i = 1; i < rows.size(); ++i) {
    const double t = rows[i].values[0], before = rows[i - 1].values[0];
    if (std::abs(t - before - dt) > even)
      throw InputError(
          "{}:{}: the time step is {:.9g} s here and {:.9g} s elsewhere. Time steps must be equal within {} s. "
          "Resample the record, or give accelerations alone and the key 'dt'.",
          name, rows[i].number, t - before, dt, even);
  }
  return dt;
}

}  // namespace

Record parse_columns(const std::string& text, const std::string& name, double dt) {
  for (const std::string_view line : lines_of(text)) {
    const std::string_view row = trimmed(line.substr(0, line.find('#')));
    if (row.empty()) continue;
    if (!all_numbers(row, column_separators)) not_read(text, name);
    break;
  }
  const std::vector<Row> rows = parse_rows(text, name);
  if (rows.size() < 2) throw InputError("{}: {} of numbers. At least 2 are needed.", name, counted(rows.size(), "row"));
  const std::size_t columns = dt > 0.0 ? 1 : 2;
  for (const Row& row : rows)
    if (row.values.size() != columns)
      throw InputError(
          "{}:{}: {}, expected {}", name, row.number, counted(row.values.size(), "column"),
          columns == 1
              ? "1 (acceleration) because 'dt' is given"
              : "2 (time in s, acceleration); for a single column give the key 'dt' in s, for several name them: "
                "columns = [\"t\", \"x\", \"y\", \"z\"]");
  Record record;
  record.dt = checked_step(columns == 1 ? dt : time_step(rows, name), name, rows.front().number);
  for (const Row& row : rows) record.values.push_back(row.values.back());
  return record;
}

}  // namespace voussoir
