// Comma-separated tables, with errors that tell the user what to correct.
#pragma once
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/base/shown.h"

namespace voussoir {

/// Value of a table cell without a number (NaN).
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// A text file in memory.
struct TextFile {
  std::string path;  // path as opened, for errors
  std::string name;  // name within the folder, for reports: "records/wind.csv"
  std::string text;
};

/// Reason why a text is not a valid number.
enum class NumberTrouble { none, empty, not_a_number, out_of_range, not_finite };
NumberTrouble parse_number(std::string_view word, double& value);
/// "'1,5' in column 'x' is not a number: write a decimal point".
std::string explain(NumberTrouble trouble, std::string_view word, const std::string& column);

/// suggestion() for words and lists that can be very long.
std::string short_suggestion(std::string_view word, const std::vector<std::string>& known);
/// A cell for writing, quoted if necessary.
std::string csv_cell(const std::string& text);

/// Whether a quoted cell may contain line breaks, as RFC 4180 allows. Without line breaks, the error of a missing
/// closing quote names the right line.
enum class CsvQuotes { within_line, over_lines };

/// Reads a CSV text cell by cell without copying it. The file must outlive the reader.
class CsvReader {
 public:
  /// Reads the heading. Throws InputError if the text is not UTF-8, or if the heading is missing or has unnamed or
  /// repeated columns.
  explicit CsvReader(const TextFile& file, CsvQuotes quotes = CsvQuotes::within_line);

  const std::vector<std::string>& columns() const { return columns_; }
  int heading_row() const { return heading_row_; }
  int row() const { return row_; }  // line in the file, from 1
  /// The text after the present line.
  std::string_view rest() const { return rest_; }

  /// Moves to the next line that is neither empty nor a comment; false at the end.
  bool next_row();
  /// The next cell of the row, trimmed and without quotes, valid until the next call; false if there is none.
  bool next_cell(std::string_view& cell);
  /// The next cell, which must exist, for column number `index`.
  std::string_view need_cell(std::size_t index);
  /// Throws InputError if the row has more cells than there are columns.
  void end_row();

  [[noreturn]] void fail(int row, const std::string& message) const;
  [[noreturn]] void fail(const std::string& message) const { fail(row_, message); }

 private:
  void read_heading();
  bool quoted_cell(std::string_view& cell);
  bool take_next_line();
  [[noreturn]] void wrong_count(std::size_t count) const;

  const TextFile& file_;
  CsvQuotes quotes_;
  std::string_view rest_, line_;
  std::string unquoted_;
  bool line_done_ = true;
  char separator_ = ',';
  int row_ = 0, heading_row_ = 0;
  std::vector<std::string> columns_;
};

/// A small table with known columns, in any order. The file must outlive the table.
class CsvTable {
 public:
  /// Throws InputError for an unknown or missing column, a row with too few or too many cells, or a table without rows.
  CsvTable(const TextFile& file, const std::vector<std::string>& required, const std::vector<std::string>& optional);

  std::size_t size() const { return rows_.size(); }
  int row(std::size_t i) const { return rows_[i].number; }
  int heading_row() const { return reader_.heading_row(); }
  bool has(const std::string& column) const;
  /// Empty if there is no such column.
  const std::string& text(std::size_t i, const std::string& column) const;
  std::string required_text(std::size_t i, const std::string& column) const;
  /// None if the cell is empty or there is no such column.
  std::optional<double> number(std::size_t i, const std::string& column) const;
  double required_number(std::size_t i, const std::string& column) const;
  /// A standard deviation: 0 if it is not given.
  double deviation(std::size_t i, const std::string& column) const;

  [[noreturn]] void fail(std::size_t i, const std::string& message) const { reader_.fail(row(i), message); }
  [[noreturn]] void fail_heading(const std::string& message) const { reader_.fail(heading_row(), message); }

 private:
  struct Row {
    int number = 0;
    std::vector<std::string> cells;
  };
  void check_columns(const std::vector<std::string>& required, const std::vector<std::string>& optional) const;

  CsvReader reader_;
  std::vector<Row> rows_;
};

}  // namespace voussoir
