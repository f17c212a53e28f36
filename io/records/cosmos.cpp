// COSMOS 1.2 (V1 and V2): thirteen lines of text or more, tables of whole numbers and of numbers, comments, samples;
// each table is announced by a line that says how many follow and in which layout. Channels follow each other.
#include <cmath>

#include "io/records/format.h"
#include "io/records/rows.h"
#include "solver/base/constants.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

constexpr std::size_t numbers_needed = 62;  // numbers of each table that are looked at

bool is_cosmos(std::string_view text) {
  return upper(text.substr(0, text.find('\n'))).find("(FORMAT V") != std::string::npos;
}

/// "(10I8)", "(6F15.6)", "(8f10.5)": the last of a line. Without one it is eight of ten columns.
FixedRows layout_of(const std::string& line) {
  FixedRows rows;
  const std::size_t open = line.rfind('('), letter = line.find_first_of("IFE", open);
  if (open == std::string::npos || letter == std::string::npos) return rows;
  const double per_row = first_number(line.substr(open + 1, letter - open - 1)),
               width = first_number(line.substr(letter + 1));
  if (per_row >= 1.0 && per_row <= 100.0 && width >= 1.0 && width <= 40.0)
    rows = {std::size_t(width), std::size_t(per_row)};
  return rows;
}

/// m/s2 of the codes of physical units. 0: no unit of accelerations.
double unit_of(int code) {
  switch (code) {
    case 2:
      return standard_gravity;  // g
    case 4:
    case 10:
      return 0.01;  // cm/s2, gal
    case 7:
      return 0.0254;  // in/s2
    case 11:
      return 9.80665e-3;  // mg
    case 12:
      return 9.80665e-6;  // micro g
    default:
      return 0.0;
  }
}

/// 1 to 360 is an azimuth; above are words.
std::string direction_of(int code) {
  if (code >= 0 && code <= 360) return fmt::format("{}", code);
  if (code == 400 || code == 402) return "UP";
  if (code == 401) return "DOWN";
  if (code == 500 || code == 600 || code == 700) return "H1";
  if (code == 501 || code == 601 || code == 701) return "H2";
  return "";
}

struct Table {
  std::vector<double> values;
  std::size_t row = 0;  // of the line that announces it, from 1
};

/// The table that a line with `words` announces; lines[at] becomes the one behind it.
Table table_at(const std::vector<std::string_view>& lines, std::size_t& at, std::string_view words,
               const std::string& name) {
  for (; at < lines.size(); ++at) {
    const std::string line = upper(lines[at]);
    if (line.find(words) == std::string::npos || line.find("FORMAT") == std::string::npos) continue;
    Table table;
    table.row = at + 1;
    const std::size_t count = checked_samples(first_number(line), name, table.row);
    table.values = fixed_numbers(lines, ++at, count, layout_of(line), name);
    return table;
  }
  throw InputError("{}: there is no line '… {} … Format=': the file is incomplete, or has no accelerations", name,
                   words);
}

RecordFile channel_of(const std::vector<std::string_view>& lines, std::size_t& at, const std::string& name) {
  const std::size_t head = at;
  const Table whole = table_at(lines, at, "INTEGER", name), numbers = table_at(lines, at, "REAL", name);
  if (whole.values.size() < numbers_needed || numbers.values.size() < numbers_needed)
    throw InputError("{}:{}: the tables have {} and {} numbers. They must have at least {} each.", name, whole.row,
                     whole.values.size(), numbers.values.size(), numbers_needed);
  const auto code = [&](std::size_t i) { return std::abs(whole.values[i]) < 1e6 ? int(whole.values[i]) : -1; };
  const Table samples = table_at(lines, at, "ACCELERATION", name);
  RecordFile file;
  file.unit = unit_of(code(2));
  if (file.unit == 0.0)
    throw InputError(
        "{}:{}: the code of the physical units is {}. It must be 2 (g), 4 (cm/s2), 7 (in/s2), 10 (gal), 11 (mg) or "
        "12 (micro g). If the file has counts (V0), use the file of volume 1 or 2.",
        name, whole.row, code(2));
  file.record.dt = checked_step(1e-3 * numbers.values[61], name, numbers.row);
  file.record.values = samples.values;
  file.event = trimmed(lines[head + 1]);
  if (lines.size() > head + 4)
    file.station = trimmed(lines[head + 4].substr(std::min<std::size_t>(lines[head + 4].size(), 28)));
  file.component = direction_of(code(53));
  while (at < lines.size() && upper(lines[at]).find("(FORMAT V") == std::string::npos) ++at;
  return file;
}

std::vector<RecordFile> read_cosmos(const std::string& text, const std::string& name, double dt) {
  const std::vector<std::string_view> lines = lines_of(text);
  if (lines.size() < 5)
    throw InputError("{}: {}: the file is incomplete; download it again", name, counted(lines.size(), "line"));
  if (upper(lines[0]).find("ACCELERATION") == std::string::npos)
    throw InputError("{}:1: '{}': use the file with the accelerations", name, excerpt(lines[0]));
  std::vector<RecordFile> channels;
  for (std::size_t at = 0; at < lines.size();) {
    channels.push_back(channel_of(lines, at, name));
    if (dt > 0.0) channels.back().record.dt = dt;
  }
  return channels;
}

}  // namespace

RecordFormat cosmos() {
  return {"COSMOS", 0.01, is_cosmos, read_cosmos};
}

}  // namespace voussoir
