#include "tools/campaign/table.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <set>

#include "solver/base/atomic_file.h"
#include "solver/base/csv.h"
#include "solver/base/error.h"
#include "solver/base/suggestion.h"

namespace voussoir {

namespace {

constexpr std::array<const char*, 4> status_names = {"done", "collapsed", "failed", "missing"};
constexpr std::array<const char*, 4> prefixes = {"material.", "im.", "edp.", "damage."};

bool is_number_column(const std::string& name) {
  return std::any_of(prefixes.begin(), prefixes.end(),
                     [&](const char* p) { return name.starts_with(p) && name.size() > std::string_view(p).size(); });
}

void check_columns(const CsvReader& reader) {
  const std::vector<std::string>& columns = reader.columns();
  for (const std::string& name : columns)
    if (!is_number_column(name) &&
        std::find(fixed_columns().begin(), fixed_columns().end(), name) == fixed_columns().end())
      reader.fail(
          reader.heading_row(),
          fmt::format("unknown column '{}'{}; columns of numbers have the names im.NAME, edp.NAME or damage.NAME",
                      shown(name), short_suggestion(name, fixed_columns())));
  for (const char* name : {"run", "case", "record", "status"})
    if (std::find(columns.begin(), columns.end(), name) == columns.end())
      reader.fail(
          reader.heading_row(),
          fmt::format("the column '{}' is missing. A table of a campaign has the columns run, case, record and status",
                      name));
}

RunStatus status_of(const CsvReader& reader, std::string_view word) {
  const auto at = std::find(status_names.begin(), status_names.end(), word);
  if (at == status_names.end())
    reader.fail(fmt::format("'{}' in column 'status'{}", shown(word),
                            short_suggestion(word, {status_names.begin(), status_names.end()})));
  return RunStatus(at - status_names.begin());
}

double number_of(const CsvReader& reader, std::string_view word, const std::string& column) {
  double value = no_number;
  const NumberTrouble trouble = parse_number(word, value);
  if (trouble == NumberTrouble::empty) return no_number;
  if (trouble != NumberTrouble::none)
    reader.fail(explain(trouble, word, column) + ". Leave the cell empty if there is no value");
  return value;
}

/// Stores a cell of a column that is not a number column.
void take_cell(const CsvReader& reader, CampaignRun& run, const std::string& column, std::string_view cell) {
  if (column == "run") run.run = cell;
  if (column == "case") run.case_name = cell;
  if (column == "record") run.record = cell;
  if (column == "event") run.event = cell;
  if (column == "sample") run.sample = cell;
  if (column == "reason") run.reason = cell;
  if (column == "scale") run.scale = number_of(reader, cell, column);
  if (column == "seconds") run.seconds = number_of(reader, cell, column);
  if (column == "status") run.status = status_of(reader, cell);
}

void read_row(CsvReader& reader, CampaignTable& table) {
  CampaignRun run;
  run.row = reader.row();
  run.scale = run.seconds = no_number;
  std::size_t number = 0;
  for (std::size_t i = 0; i < reader.columns().size(); ++i) {
    const std::string_view cell = reader.need_cell(i);
    if (const std::string& name = reader.columns()[i]; is_number_column(name))
      table.columns[number++].values.push_back(number_of(reader, cell, name));
    else
      take_cell(reader, run, name, cell);
  }
  reader.end_row();
  if (run.run.empty()) reader.fail("the cell in column 'run' is empty. It must be the name of a run");
  table.runs.push_back(std::move(run));
}

/// A cell in one line, quoted if necessary; empty for an empty text.
std::string text_cell(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
  return text.empty() ? text : csv_cell(text);
}

std::string number_text(double value) {
  return std::isfinite(value) ? fmt::format("{}", value) : std::string();  // fmt: shortest that reads back as it was
}

}  // namespace

const std::vector<std::string>& fixed_columns() {
  static const std::vector<std::string> names = {"run",    "case",   "record", "event",  "scale",
                                                 "sample", "status", "reason", "seconds"};
  return names;
}

const char* run_status_name(RunStatus status) {
  return status_names[std::size_t(status)];
}

const NumberColumn* CampaignTable::find(std::string_view name) const {
  const auto at = std::find_if(columns.begin(), columns.end(), [&](const NumberColumn& c) { return c.name == name; });
  return at == columns.end() ? nullptr : &*at;
}

const NumberColumn& CampaignTable::column(std::string_view name) const {
  if (const NumberColumn* found = find(name)) return *found;
  std::vector<std::string> known;
  for (const NumberColumn& c : columns) known.push_back(c.name);
  if (known.empty()) throw InputError("{}: there is no column '{}' and no other column of numbers", path, name);
  throw InputError("{}: there is no column '{}'{}", path, shown(name), short_suggestion(name, known));
}

std::vector<std::string> CampaignTable::names(std::string_view prefix) const {
  std::vector<std::string> found;
  for (const NumberColumn& c : columns)
    if (c.name.starts_with(prefix)) found.push_back(c.name);
  return found;
}

std::vector<std::string> CampaignTable::cases() const {
  std::vector<std::string> found;
  for (const CampaignRun& run : runs)
    if (std::find(found.begin(), found.end(), run.case_name) == found.end()) found.push_back(run.case_name);
  return found;
}

CampaignTable parse_table(const std::string& text, const std::string& path) {
  const TextFile file = {path, path, text};
  CsvReader reader(file, CsvQuotes::over_lines);
  check_columns(reader);
  CampaignTable table;
  table.path = path;
  for (const std::string& name : reader.columns())
    if (is_number_column(name)) table.columns.push_back({name, {}});
  std::set<std::string> seen;
  while (reader.next_row()) {
    read_row(reader, table);
    if (!seen.insert(table.runs.back().run).second)
      reader.fail(fmt::format("run '{}' occurs twice. Remove or rename one", shown(table.runs.back().run)));
  }
  if (table.runs.empty())
    reader.fail(reader.heading_row(), "there are no runs below the heading. Run the campaign first");
  return table;
}

CampaignTable read_table(const std::string& path) {
  return parse_table(read_text(path), path);
}

std::string table_text(const CampaignTable& table) {
  std::string text = fmt::format("{}", fmt::join(fixed_columns(), ","));
  for (const NumberColumn& c : table.columns) text += fmt::format(",{}", text_cell(c.name));
  text += "\n";
  for (std::size_t i = 0; i < table.runs.size(); ++i) {
    const CampaignRun& r = table.runs[i];
    text += fmt::format("{},{},{},{},{},{},{},{},{}", text_cell(r.run), text_cell(r.case_name), text_cell(r.record),
                        text_cell(r.event), number_text(r.scale), text_cell(r.sample), run_status_name(r.status),
                        text_cell(r.reason), number_text(r.seconds));
    for (const NumberColumn& c : table.columns) text += fmt::format(",{}", number_text(c.values[i]));
    text += "\n";
  }
  return text;
}

void write_table(const std::string& path, const CampaignTable& table) {
  write_atomically(path, table_text(table));
}

}  // namespace voussoir
