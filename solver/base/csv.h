// Comma-separated tables with errors a person can act on.
#pragma once
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "solver/base/shown.h"

namespace voussoir {

/// What a table holds where there is no number.
constexpr double no_number = std::numeric_limits<double>::quiet_NaN();

/// A text file of a folder, in memory.
struct TextFile {
  std::string path;  // as opened, for errors
  std::string name;  // within the folder, for reports: "records/wind.csv"
  std::string text;
};

/// Why a text is no number one can compute with.
enum class NumberTrouble { none, empty, not_a_number, out_of_range, not_finite };
NumberTrouble parse_number(std::string_view word, double& value);
/// "'1,5' in column 'x' is not a number: write a decimal point".
std::string explain(NumberTrouble trouble, std::string_view word, const std::string& column);

/// suggestion() for words and lists that may be very long.
std::string short_suggestion(std::string_view word, const std::vector<std::string>& known);
/// A cell as it is written: quoted when it must be.
std::string csv_cell(const std::string& text);

/// Whether a quoted cell may hold line breaks, as RFC 4180 allows. People who forget to close a quote are better told
/// so on its line.
enum class CsvQuotes { within_line, over_lines };

/// Goes through a CSV text cell by cell without copying it; the file must outlive the reader.
class CsvReader {
 public:
  /// Reads the heading. Throws InputError when the text is not UTF-8, has no heading, or one with nameless or repeated
  /// columns.
  explicit CsvReader(const TextFile& file, CsvQuotes quotes = CsvQuotes::within_line);

  const std::vector<std::string>& columns() const { return columns_; }
  int heading_row() const { return heading_row_; }
  int row() const { return row_; }  // line in the file, from 1
  std::string_view rest() const { return rest_; }

  /// Goes to the next line that is neither empty nor a comment; false at the end.
  bool next_row();
  /// The next cell of the row, trimmed and without quotes, valid until the next call; false when there are no more.
  bool next_cell(std::string_view& cell);
  /// The next cell, when the row must have one for column number `index`.
  std::string_view need_cell(std::size_t index);
  /// Throws when the row has more cells than columns.
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

/// A small table with known columns, in any order.
class CsvTable {
 public:
  /// Throws InputError for an unknown or missing column, a row with too few or too many cells, or no rows at all.
  CsvTable(const TextFile& file, const std::vector<std::string>& required, const std::vector<std::string>& optional);

  std::size_t size() const { return rows_.size(); }
  int row(std::size_t i) const { return rows_[i].number; }
  int heading_row() const { return reader_.heading_row(); }
  bool has(const std::string& column) const;
  /// Empty when there is no such column.
  const std::string& text(std::size_t i, const std::string& column) const;
  std::string required_text(std::size_t i, const std::string& column) const;
  /// None when the cell is empty or there is no such column.
  std::optional<double> number(std::size_t i, const std::string& column) const;
  double required_number(std::size_t i, const std::string& column) const;
  /// A standard deviation: 0 when not given.
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
