#include "io/records/table.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>

#include "io/records/rows.h"
#include "io/records/sets.h"
#include "solver/base/constants.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/words.h"

namespace voussoir {

namespace {

constexpr std::string_view table_separators = " \t,;", without_commas = " \t;";
constexpr double even_step = 1e-6;  // s

/// Whether a line of numbers has decimal commas: every comma is between digits, there is another separator, and there
/// are no points.
bool looks_decimal(std::string_view line) {
  if (line.find('.') != std::string_view::npos || line.find(',') == std::string_view::npos) return false;
  for (std::size_t i = 0; i < line.size(); ++i)
    if (line[i] == ',' && (i == 0 || i + 1 == line.size() || !is_digit(line[i - 1]) || !is_digit(line[i + 1])))
      return false;
  for (const std::string_view word : words_of(line, without_commas))
    if (std::ranges::count(word, ',') > 1) return false;
  return words_of(line, without_commas).size() > 1;
}

std::string with_points(std::string_view line) {
  std::string text(line);
  std::ranges::replace(text, ',', '.');
  return text;
}

std::string_view uncommented(std::string_view line) {
  return trimmed(line.substr(0, line.find('#')));
}

/// Whether the whole file has decimal commas: "0,01;1" and "0;1" may be rows of one file.
bool decimal_commas(const std::vector<std::string_view>& lines) {
  bool some = false;
  for (const std::string_view whole : lines) {
    const std::string_view line = uncommented(whole);
    if (!all_numbers(line, table_separators)) continue;
    if (looks_decimal(line))
      some = true;
    else if (line.find('.') != std::string_view::npos || line.find(',') != std::string_view::npos)
      return false;
  }
  return some;
}

/// A unit in brackets belongs to the word before it.
std::vector<std::string> with_brackets(const std::vector<std::string_view>& words) {
  std::vector<std::string> names;
  for (const std::string_view word : words)
    if (!names.empty() && (word.starts_with('(') || word.starts_with('[')))
      names.back().append(" ").append(word);
    else
      names.emplace_back(word);
  return names;
}

std::vector<std::string> cells_of(const std::string& line, char separator) {
  std::vector<std::string> cells;
  for (std::size_t begin = 0; begin <= line.size();) {
    const std::size_t end = std::min(line.find(separator, begin), line.size());
    std::string_view cell = trimmed(std::string_view(line).substr(begin, end - begin));
    if (cell.size() > 1 && cell.front() == '"' && cell.back() == '"') cell = cell.substr(1, cell.size() - 2);
    cells.emplace_back(cell);
    begin = end + 1;
  }
  return cells;
}

/// Names in a line that has as many as there are columns.
std::vector<std::string> names_in(const std::string& heading, std::size_t columns) {
  for (const char separator : {';', '\t', ','})
    if (std::vector<std::string> names = cells_of(heading, separator); names.size() == columns) return names;
  if (std::vector<std::string> names = with_brackets(words_of(heading)); names.size() == columns) return names;
  return {};
}

/// Letters and figures in capitals, words apart.
std::vector<std::string> name_words(const std::string& name) {
  std::vector<std::string> words(1);
  for (const char c : upper(name.substr(0, name.find_first_of("([")))) {
    const bool kept = std::isalnum(static_cast<unsigned char>(c)) || c == '-';
    if (kept && c != '-') words.back() += c;
    if (!kept && !words.back().empty()) words.emplace_back();
  }
  if (words.back().empty()) words.pop_back();
  return words;
}

/// The step of a column of times.
double step_of(const TextTable& table, std::size_t column, double unit, const std::string& name) {
  const std::vector<double>& t = table.columns[column];
  const double dt = unit * (t.back() - t.front()) / double(t.size() - 1);
  for (std::size_t i = 1; i < t.size(); ++i)
    if (const double here = unit * (t[i] - t[i - 1]); !(std::abs(here - dt) <= even_step) || !(here > 0.0))
      throw InputError(
          "{}:{}: the time step is {:.9g} s here and {:.9g} s elsewhere. Time steps must be equal within {} s. "
          "Resample the record.",
          name, table.first_row + i, here, dt, even_step);
  return checked_step(dt, name, table.first_row);
}

}  // namespace

TextTable parse_table(std::string_view text, const std::string& name) {
  const std::vector<std::string_view> lines = lines_of(text);
  const bool decimal = decimal_commas(lines);
  const std::string_view between = decimal ? without_commas : table_separators;
  TextTable table;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string line = decimal ? with_points(uncommented(lines[i])) : std::string(uncommented(lines[i]));
    if (table.columns.empty() && !all_numbers(line, between)) {
      const std::string_view words = trimmed(lines[i]);
      if (!words.empty()) table.heading = words.substr(std::min(words.find_first_not_of("# \t"), words.size()));
      continue;
    }
    if (line.empty()) continue;
    std::vector<double> row;
    append_numbers(line, between, name, i + 1, "rows of a table must be numbers", row);
    if (table.columns.empty()) table.columns.resize(row.size()), table.first_row = i + 1;
    if (row.size() != table.columns.size())
      throw InputError("{}:{}: {}, but {} in the rows before", name, i + 1, counted(row.size(), "column"),
                       table.columns.size());
    for (std::size_t k = 0; k < row.size(); ++k) table.columns[k].push_back(row[k]);
  }
  if (table.columns.empty() || table.columns[0].size() < 2)
    throw InputError("{}: {} of numbers. At least 2 are needed.", name,
                     counted(table.columns.empty() ? 0 : table.columns[0].size(), "row"));
  table.names = names_in(table.heading, table.columns.size());
  return table;
}

const std::vector<std::string>& column_words() {
  static const std::vector<std::string> words = {"t", "x", "y", "z", ""};
  return words;
}

std::string column_role(const std::string& name) {
  const std::vector<std::string> words = name_words(name);
  for (const std::string& word : words)
    if (word == "T" || word == "TIME" || word == "TIMES" || word == "SEC" || word == "SECONDS") return "t";
  for (const std::string& word : words)
    for (const char* other : {"VEL", "VELOCITY", "DISP", "DISPLACEMENT", "DISPL", "PERIOD", "FREQUENCY"})
      if (word == other) return "";
  for (const std::string& word : words)
    if (const int axis = component_axis(word); axis >= 0) return std::string(1, "xyz"[axis]);
  return words.empty() ? "" : words.back();
}

double column_unit(const std::string& name) {
  static const std::map<std::string, double> known = {
      {"m/s2", 1.0},     {"m/s/s", 1.0},          {"m/sec2", 1.0},    {"m/sec/sec", 1.0},
      {"ms-2", 1.0},     {"g", standard_gravity}, {"cm/s2", 0.01},    {"cm/s/s", 0.01},
      {"cm/sec2", 0.01}, {"cm/sec/sec", 0.01},    {"gal", 0.01},      {"gals", 0.01},
      {"mm/s2", 0.001},  {"mm/s/s", 0.001},       {"mg", 9.80665e-3}, {"s", 1.0},
      {"sec", 1.0},      {"seconds", 1.0},        {"ms", 0.001}};
  const std::size_t open = name.find_first_of("([");
  if (open == std::string::npos) return 0.0;
  const std::string unit = name.substr(open + 1, name.find_first_of(")]", open) - open - 1);
  std::string plain;
  constexpr std::string_view square = "²";
  for (std::size_t i = 0; i < unit.size(); ++i) {
    const bool squared = std::string_view(unit).substr(i).starts_with(square);
    if (squared) i += square.size() - 1;
    if (const char c = squared ? '2' : unit[i]; c != ' ' && c != '^' && c != '*')
      plain += char(std::tolower(static_cast<unsigned char>(c)));
  }
  const auto found = known.find(plain);
  if (found == known.end())
    throw InputError("the unit in '{}' is not known. It must be m/s2, cm/s2, mm/s2, gal, g or mg; for times s or ms.",
                     excerpt(name));
  return found->second;
}

std::vector<RecordFile> channels_of(const TextTable& table, const std::vector<std::string>& roles,
                                    const std::string& name, double dt) {
  if (roles.size() != table.columns.size())
    throw InputError("{}:{}: {}, but 'columns' names {}. Name each column; \"\" skips one.", name, table.first_row,
                     counted(table.columns.size(), "column"), roles.size());
  std::vector<RecordFile> channels;
  double step = dt;
  for (std::size_t k = 0; k < roles.size(); ++k) {
    const double unit = k < table.names.size() ? column_unit(table.names[k]) : 0.0;
    if (roles[k] == "t" && !(dt > 0.0)) step = step_of(table, k, unit > 0.0 ? unit : 1.0, name);
    if (roles[k].empty() || roles[k] == "t") continue;
    RecordFile file;
    file.record.values = table.columns[k];
    file.unit = unit;
    file.component = roles[k];
    channels.push_back(file);
  }
  if (channels.empty()) throw InputError("{}: no column is a component. Name the components x, y or z.", name);
  if (!(step > 0.0))
    throw InputError(
        "{}:{}: there is neither a column of times nor a time step. Name a column \"t\", or give 'dt' in s.", name,
        table.first_row);
  for (RecordFile& file : channels) file.record.dt = step;
  return channels;
}

namespace {

/// The table at the beginning of a file, whose last line may be cut off; without names where it is none.
TextTable beginning_of(std::string_view text) {
  std::string_view part = text.substr(0, 8000);
  if (part.size() < text.size()) part = part.substr(0, part.rfind('\n'));
  try {
    TextTable table = parse_table(part, "");
    if (table.first_row < 2 || table.heading.empty()) return {};
    const bool marked = lines_of(part)[table.first_row - 2].starts_with('#');
    // A comment above one or two columns need not name them.
    if (marked && table.columns.size() < 3) table.names.clear();
    return table;
  } catch (const InputError&) {
    return {};
  }
}

bool names_components(const TextTable& table) {
  return std::ranges::any_of(table.names, [](const std::string& name) {
    const std::string role = column_role(name);
    return role == "t" || role == "x" || role == "y" || role == "z";
  });
}

bool has_units(const TextTable& table) {
  try {
    return std::ranges::any_of(
        table.names, [](const std::string& name) { return column_role(name) != "t" && column_unit(name) > 0.0; });
  } catch (const InputError&) {
    return true;  // reading says which one is not known
  }
}

std::vector<RecordFile> read_table(const std::string& text, const std::string& name, double dt) {
  const TextTable table = parse_table(text, name);
  std::vector<std::string> roles;
  for (const std::string& column : table.names) {
    roles.push_back(column_role(column));
    if (roles.back().empty())
      throw InputError(
          "{}:{}: column '{}' is not an acceleration. Name the columns with 'columns'; \"\" skips a column.", name,
          table.first_row - 1, excerpt(column));
  }
  return channels_of(table, roles, name, dt);
}

std::vector<RecordFile> read_with_units(const std::string& text, const std::string& name, double dt) {
  std::vector<RecordFile> channels;
  try {
    channels = read_table(text, name, dt);
  } catch (const InputError& error) {
    const std::string message = error.what();
    if (message.starts_with(name)) throw;
    throw InputError("{}: {}", name, message);
  }
  double some = 0.0;  // a column without a unit has that of the others
  for (const RecordFile& file : channels) some = std::max(some, file.unit);
  for (RecordFile& file : channels)
    for (double& value : file.record.values) value *= file.unit > 0.0 ? file.unit : some;
  for (RecordFile& file : channels) file.unit = 1.0;
  return channels;
}

}  // namespace

bool has_times(std::string_view text) {
  return std::ranges::any_of(beginning_of(text).names,
                             [](const std::string& name) { return column_role(name) == "t"; });
}

RecordFormat table_with_units() {
  return {"table with units", 1.0,
          [](std::string_view text) {
            const TextTable table = beginning_of(text);
            return names_components(table) && has_units(table);
          },
          read_with_units};
}

RecordFormat headed_table() {
  return {"table", 0.0, [](std::string_view text) { return names_components(beginning_of(text)); }, read_table};
}

}  // namespace voussoir
