#include "solver/base/csv.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>

#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/suggestion.h"

namespace voussoir {

namespace {

constexpr std::string_view blanks = " \t";
constexpr std::size_t most_listed = 20;  // words

std::string_view trimmed(std::string_view text) {
  const std::size_t begin = text.find_first_not_of(blanks);
  if (begin == std::string_view::npos) return {};
  return text.substr(begin, text.find_last_not_of(blanks) + 1 - begin);
}

/// Bytes of the UTF-8 character beyond ASCII at the beginning of a text; 0 when there is none (Unicode 15, table 3-7).
std::size_t character_length(std::string_view text) {
  const auto byte = [&](std::size_t i) { return i < text.size() ? static_cast<unsigned char>(text[i]) : 0u; };
  const unsigned lead = byte(0), second = byte(1);
  const std::size_t length = lead >= 0xf0 ? 4 : lead >= 0xe0 ? 3 : 2;
  if (lead < 0xc2 || lead > 0xf4) return 0;
  if ((lead == 0xe0 && second < 0xa0) || (lead == 0xed && second >= 0xa0)) return 0;
  if ((lead == 0xf0 && second < 0x90) || (lead == 0xf4 && second >= 0x90)) return 0;
  for (std::size_t i = 1; i < length; ++i)
    if ((byte(i) & 0xc0) != 0x80) return 0;
  return length;
}

/// Bytes of the character at the beginning of a text, 0 when it has no place in a table.
std::size_t table_character(std::string_view text) {
  const auto c = static_cast<unsigned char>(text[0]);
  if (c >= 0x80) return character_length(text);
  if (c == '\r') return text.size() == 1 || text[1] == '\n' ? 1 : 0;
  return (c >= 0x20 && c != 0x7f) || c == '\n' || c == '\t' ? 1 : 0;
}

void check_characters(const TextFile& file) {
  const std::string_view text = file.text;
  for (std::size_t i = 0; i < text.size();) {
    const std::size_t length = table_character(text.substr(i));
    if (length == 0)
      throw InputError(
          "{}:{}: byte 0x{:02x} is not UTF-8 text. Save the file as CSV in UTF-8 with lines that end in a line feed.",
          file.path, 1 + std::count(text.begin(), text.begin() + std::ptrdiff_t(i), '\n'),
          static_cast<unsigned>(static_cast<unsigned char>(text[i])));
    i += length;
  }
}

/// Semicolons separate when there are some and no commas, quoted cells left out.
char separator_of(std::string_view heading) {
  bool quoted = false, semicolon = false;
  for (const char c : heading) {
    if (c == '"') quoted = !quoted;
    if (quoted) continue;
    if (c == ',') return ',';
    semicolon |= c == ';';
  }
  return semicolon ? ';' : ',';
}

}  // namespace

NumberTrouble parse_number(std::string_view word, double& value) {
  if (word.empty()) return NumberTrouble::empty;
  if (word.front() == '+' && word.size() > 1 && word[1] != '-') word.remove_prefix(1);
  const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
  if (end != word.data() + word.size() || error == std::errc::invalid_argument) return NumberTrouble::not_a_number;
  if (error != std::errc()) return NumberTrouble::out_of_range;
  return std::isfinite(value) ? NumberTrouble::none : NumberTrouble::not_finite;
}

std::string explain(NumberTrouble trouble, std::string_view word, const std::string& column) {
  switch (trouble) {
    case NumberTrouble::empty:
      return fmt::format("the cell in column '{}' is empty, but a number is needed", shown(column));
    case NumberTrouble::out_of_range:
      return fmt::format("'{}' in column '{}' is outside the range of numbers", shown(word), shown(column));
    case NumberTrouble::not_finite:
      return fmt::format("'{}' in column '{}' is not a finite number", shown(word), shown(column));
    default:
      return fmt::format("'{}' in column '{}' is not a number{}", shown(word), shown(column),
                         word.find(',') == std::string_view::npos ? "" : ": write a decimal point, not a comma");
  }
}

std::string short_suggestion(std::string_view word, const std::vector<std::string>& known) {
  std::vector<std::string> words;
  for (const std::string& w : known) words.push_back(shown(w));
  if (words.size() <= most_listed) return suggestion(shown(word), words);
  if (const std::string near = nearest_word(shown(word), words); !near.empty())
    return fmt::format(": did you mean '{}'?", near);
  return fmt::format(": expected one of: {}, … ({} in all)",
                     fmt::join(words.begin(), words.begin() + most_listed, ", "), words.size());
}

std::string csv_cell(const std::string& text) {
  const bool plain =
      !text.empty() && text.front() != '#' && text.find_first_of(",;\"") == std::string::npos && trimmed(text) == text;
  if (plain) return text;
  std::string out = "\"";
  for (const char c : text) out += c == '"' ? std::string("\"\"") : std::string(1, c);
  return out + '"';
}

CsvReader::CsvReader(const TextFile& file, CsvQuotes quotes) : file_(file), quotes_(quotes), rest_(file.text) {
  if (rest_.starts_with("\xef\xbb\xbf")) rest_.remove_prefix(3);  // byte-order mark
  check_characters(file);
  read_heading();
}

void CsvReader::fail(int row, const std::string& message) const {
  throw InputError("{}:{}: {}", file_.path, row, message);
}

void CsvReader::read_heading() {
  if (!next_row()) throw InputError("{}:1: the file is empty. It must begin with a row of column names.", file_.path);
  heading_row_ = row_;
  separator_ = separator_of(line_);
  std::set<std::string> seen;
  for (std::string_view cell; next_cell(cell);) {
    if (cell.empty())
      fail(fmt::format("column {} has no name. Name it, or remove its separator.", columns_.size() + 1));
    if (cell.find('\t') != std::string_view::npos)
      fail("the name of a column contains a tab. Separate the cells of all rows by commas or semicolons.");
    if (!seen.emplace(cell).second)
      fail(fmt::format("two columns have the name '{}'. Remove or rename one of them.", shown(cell)));
    columns_.emplace_back(cell);
  }
}

bool CsvReader::next_row() {
  while (!rest_.empty()) {
    ++row_;
    const std::size_t end = std::min(rest_.find('\n'), rest_.size());
    line_ = rest_.substr(0, end);
    rest_.remove_prefix(std::min(end + 1, rest_.size()));
    if (line_.ends_with('\r')) line_.remove_suffix(1);
    const std::size_t begin = line_.find_first_not_of(blanks);
    if (begin == std::string_view::npos || line_[begin] == '#') continue;
    line_done_ = false;
    return true;
  }
  return false;
}

bool CsvReader::next_cell(std::string_view& cell) {
  if (line_done_) return false;
  const std::size_t begin = std::min(line_.find_first_not_of(blanks), line_.size());
  line_.remove_prefix(begin);
  if (line_.starts_with('"')) return quoted_cell(cell);
  const std::size_t end = line_.find(separator_);
  line_done_ = end == std::string_view::npos;
  cell = trimmed(line_.substr(0, end));
  line_.remove_prefix(line_done_ ? line_.size() : end + 1);
  return true;
}

/// The line in hand goes on over the line break.
bool CsvReader::take_next_line() {
  if (quotes_ == CsvQuotes::within_line || rest_.empty()) return false;
  ++row_;
  const std::size_t end = std::min(rest_.find('\n'), rest_.size());
  line_ = {line_.data(), std::size_t(rest_.data() + end - line_.data())};
  rest_.remove_prefix(std::min(end + 1, rest_.size()));
  if (line_.ends_with('\r')) line_.remove_suffix(1);
  return true;
}

bool CsvReader::quoted_cell(std::string_view& cell) {
  unquoted_.clear();
  const int began = row_;
  std::size_t i = 1;
  for (; i < line_.size() || take_next_line(); ++i) {
    if (line_[i] == '"' && !line_.substr(i + 1).starts_with('"')) break;
    if (line_[i] == '"') ++i;  // a doubled quote is one within the text
    unquoted_ += line_[i];
  }
  if (i >= line_.size())
    fail(began, quotes_ == CsvQuotes::within_line ? "a quoted cell does not end on its line. Close the quote."
                                                  : "a quoted cell does not end. Close the quote.");
  const std::size_t next = std::min(line_.find_first_not_of(blanks, i + 1), line_.size());
  line_done_ = next == line_.size();
  if (!line_done_ && line_[next] != separator_)
    fail(
        fmt::format("there is text after the closing quote of \"{}\", where '{}' is expected. Write quotes within a "
                    "quoted cell twice.",
                    shown(unquoted_), separator_));
  line_.remove_prefix(line_done_ ? next : next + 1);
  cell = unquoted_;
  return true;
}

std::string_view CsvReader::need_cell(std::size_t index) {
  std::string_view cell;
  if (!next_cell(cell)) wrong_count(index);
  return cell;
}

void CsvReader::end_row() {
  if (line_done_) return;
  std::size_t count = columns_.size();
  for (std::string_view cell; next_cell(cell);) ++count;
  wrong_count(count);
}

void CsvReader::wrong_count(std::size_t count) const {
  fail(
      fmt::format("the row has {}, the heading has {}. Write numbers with a decimal point, and put text that "
                  "contains '{}' in quotes.",
                  counted(count, "cell"), columns_.size(), separator_));
}

CsvTable::CsvTable(const TextFile& file, const std::vector<std::string>& required,
                   const std::vector<std::string>& optional)
    : reader_(file) {
  check_columns(required, optional);
  while (reader_.next_row()) {
    Row row{reader_.row(), {}};
    for (std::size_t i = 0; i < reader_.columns().size(); ++i) row.cells.emplace_back(reader_.need_cell(i));
    reader_.end_row();
    rows_.push_back(std::move(row));
  }
  if (rows_.empty()) fail_heading("there are no rows below the heading. Fill the table, or remove the file.");
}

void CsvTable::check_columns(const std::vector<std::string>& required, const std::vector<std::string>& optional) const {
  std::vector<std::string> known = required;
  known.insert(known.end(), optional.begin(), optional.end());
  for (const std::string& column : reader_.columns())
    if (std::find(known.begin(), known.end(), column) == known.end())
      fail_heading(fmt::format("unknown column '{}'{}", shown(column), short_suggestion(column, known)));
  for (const std::string& column : required)
    if (!has(column))
      fail_heading(
          fmt::format("the column '{}' is missing; the required columns are: {}", column, fmt::join(required, ", ")));
}

bool CsvTable::has(const std::string& column) const {
  const auto& columns = reader_.columns();
  return std::find(columns.begin(), columns.end(), column) != columns.end();
}

const std::string& CsvTable::text(std::size_t i, const std::string& column) const {
  static const std::string none;
  const auto& columns = reader_.columns();
  const auto found = std::find(columns.begin(), columns.end(), column);
  return found == columns.end() ? none : rows_[i].cells[std::size_t(found - columns.begin())];
}

std::string CsvTable::required_text(std::size_t i, const std::string& column) const {
  if (text(i, column).empty()) fail(i, fmt::format("the cell in column '{}' is empty. Enter a name.", column));
  return text(i, column);
}

std::optional<double> CsvTable::number(std::size_t i, const std::string& column) const {
  if (text(i, column).empty()) return std::nullopt;
  return required_number(i, column);
}

double CsvTable::required_number(std::size_t i, const std::string& column) const {
  double value = 0.0;
  const std::string& word = text(i, column);
  if (const NumberTrouble trouble = parse_number(word, value); trouble != NumberTrouble::none)
    fail(i, explain(trouble, word, column));
  return value;
}

double CsvTable::deviation(std::size_t i, const std::string& column) const {
  const double value = number(i, column).value_or(0.0);
  if (value < 0.0)
    fail(i, fmt::format("{} is {}. A standard deviation must be 0 or more. Leave the cell empty if it is unknown.",
                        column, value));
  return value;
}

}  // namespace voussoir
