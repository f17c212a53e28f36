// Components side by side as two agencies hand them out: AFAD of Turkey (formerly NSMN), three columns without times,
// and CWA of Taiwan, times and three columns; both in gal.
#include "io/records/format.h"
#include "io/records/rows.h"
#include "io/records/table.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/words.h"

namespace voussoir {

namespace {

/// The text after the colon of the line that begins with `key`, and the number of the line from 1; "" and 0: none.
std::pair<std::string, std::size_t> after(const std::vector<std::string_view>& lines, std::string_view key) {
  for (std::size_t i = 0; i < lines.size() && i < 100; ++i)
    if (upper(trimmed(lines[i])).starts_with(key))
      if (const std::size_t colon = lines[i].find(':'); colon != std::string_view::npos)
        return {std::string(trimmed(lines[i].substr(colon + 1))), i + 1};
  return {"", 0};
}

std::pair<std::string, std::size_t> needed(const std::vector<std::string_view>& lines, std::string_view key,
                                           const std::string& name) {
  const auto found = after(lines, key);
  if (found.second == 0)
    throw InputError("{}: the heading has no line '{}': the file is incomplete; download it again", name, key);
  return found;
}

void name_all(std::vector<RecordFile>& channels, const std::string& event, const std::string& station) {
  for (RecordFile& channel : channels) channel.event = event, channel.station = station;
}

bool is_afad(std::string_view text) {
  return upper(text.substr(0, 200)).find("STRONG GROUND MOTION RECORDS") != std::string::npos;
}

std::vector<RecordFile> read_afad(const std::string& text, const std::string& name, double dt) {
  const std::vector<std::string_view> lines = lines_of(text);
  const auto [step, step_line] = needed(lines, "SAMPLING INTERVAL", name);
  const auto [count, count_line] = needed(lines, "NUMBER OF DATA", name);
  const std::size_t samples = checked_samples(first_number(count), name, count_line);
  const double told = checked_step(first_number(step), name, step_line);
  const TextTable table = parse_table(text, name);
  if (table.columns.size() != 3)
    throw InputError("{}:{}: {}, expected three: N-S, E-W, U-D", name, table.first_row,
                     counted(table.columns.size(), "column"));
  if (table.columns[0].size() != samples)
    throw InputError("{}: {}, but line {} says {}: the file is incomplete; download it again", name,
                     counted(table.columns[0].size(), "sample"), count_line, samples);
  std::vector<RecordFile> channels;
  std::vector<std::string> roles = {"y", "x", "z"};
  for (std::size_t k = 0; k < table.names.size(); ++k) roles[k] = column_role(table.names[k]);
  TextTable plain = table;
  plain.names.clear();
  channels = channels_of(plain, roles, name, dt > 0.0 ? dt : told);
  name_all(channels, after(lines, "EARTHQUAKE DATE").first, after(lines, "STATION ID").first);
  return channels;
}

bool is_cwa(std::string_view text) {
  const std::string first = upper(text.substr(0, 40));
  return first.starts_with("#EARTHQUAKE INFORMATION") || first.starts_with("#STATIONCODE");
}

std::vector<RecordFile> read_cwa(const std::string& text, const std::string& name, double dt) {
  const std::vector<std::string_view> lines = lines_of(text);
  const auto [unit, unit_line] = needed(lines, "#AMPLITUDEUNIT", name);
  if (!upper(unit).starts_with("GAL"))
    throw InputError("{}:{}: the unit is '{}'. It must be gal.", name, unit_line, excerpt(unit));
  const auto [rate, rate_line] = needed(lines, "#SAMPLERATE", name);
  const double step = checked_step(1.0 / first_number(rate), name, rate_line);
  std::vector<std::string> roles = {"t", "z", "y", "x"};  // Time U(+); N(+); E(+)
  const std::string order = upper(after(lines, "#DATASEQUENCE").first);
  std::size_t k = 1;
  for (const std::string_view word : words_of(order, " \t;,()+-"))
    if (const std::string role = column_role(std::string(word)); k < 4 && (role == "x" || role == "y" || role == "z"))
      roles[k++] = role;
  // Fields of ten columns may touch each other.
  std::size_t at = 0;
  while (at < lines.size() && (lines[at].starts_with('#') || trimmed(lines[at]).empty())) ++at;
  TextTable table;
  table.first_row = at + 1;
  table.columns.resize(4);
  while (at < lines.size()) {
    if (trimmed(lines[at]).empty()) {
      ++at;
      continue;
    }
    const std::vector<double> row = fixed_numbers(lines, at, 4, {10, 4}, name);
    for (std::size_t i = 0; i < 4; ++i) table.columns[i].push_back(row[i]);
  }
  if (table.columns[0].size() < 2) throw InputError("{}: no samples after the heading", name);
  std::vector<RecordFile> channels = channels_of(table, roles, name, dt > 0.0 ? dt : step);
  std::string event = after(lines, "#ORIGIN TIME").first;
  if (event.empty()) event = after(lines, "#STARTTIME").first;
  name_all(channels, event, after(lines, "#STATIONCODE").first);
  return channels;
}

}  // namespace

RecordFormat afad() {
  return {"AFAD", 0.01, is_afad, read_afad};
}

RecordFormat cwa() {
  return {"CWA", 0.01, is_cwa, read_cwa};
}

}  // namespace voussoir
