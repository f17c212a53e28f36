// CSMIP volume 2: text and tables, then accelerations (velocities and displacements after them), eight a row of ten
// columns each, which may touch each other. Files since about 2000 say the same in small letters and name the layout
// of the rows; they hold all channels of a station, one after the other.
#include <cmath>

#include "io/records/format.h"
#include "io/records/rows.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

constexpr std::string_view mark = "POINTS OF ACCEL DATA EQUALLY SPACED AT", title = "CORRECTED ACCELEROGRAM";

bool is_csmip(std::string_view text) {
  return upper(text).find(mark) != std::string::npos;
}

/// The text after `key` up to two blanks.
std::string after(std::string_view line, std::string_view key) {
  const std::size_t at = upper(line).find(key);
  if (at == std::string::npos) return "";
  line = trimmed(line.substr(at + key.size()));
  return std::string(trimmed(line.substr(0, line.find("  "))));
}

bool has_any(const std::string& line, std::initializer_list<const char*> words) {
  for (const char* word : words)
    if (line.find(word) != std::string::npos) return true;
  return false;
}

/// "(8F10.3)"; a line without it means that, too.
FixedRows rows_of(const std::string& line) {
  FixedRows rows;
  const std::size_t open = line.rfind('('), letter = line.find('F', open);
  if (open == std::string::npos || letter == std::string::npos) return rows;
  const double per_row = first_number(line.substr(open + 1, letter - open - 1)),
               width = first_number(line.substr(letter + 1));
  if (per_row >= 1.0 && per_row <= 100.0) rows.per_row = std::size_t(per_row);
  if (width >= 2.0 && width <= 40.0) rows.width = std::size_t(width);
  return rows;
}

struct Announced {
  std::size_t samples = 0;
  double step = 0.0;  // s
  FixedRows rows;
};

/// Reads them from their line.
Announced announced_in(std::string_view text, const std::string& name, std::size_t row) {
  const std::string rule =
      "this line must have the form '5696 " + std::string(mark) + "  .010 SEC.  (UNITS: CM/SEC/SEC)'";
  const std::string line = upper(text);
  const std::size_t at = line.find(mark);
  const std::string_view before = trimmed(std::string_view(line).substr(0, at)),
                         rest = trimmed(std::string_view(line).substr(at + mark.size()));
  if (!has_any(line, {"CM/SEC/SEC", "CM/SEC2", "CM/SEC^2", "CM/SEC**2", "CM/S/S", "CM/S2", "CM/S^2", "GAL"}))
    throw InputError("{}:{}: '{}': {}", name, row, excerpt(text), rule);
  Announced found;
  found.samples = checked_samples(number_in(before, name, row, rule), name, row);
  found.step = checked_step(number_in(rest.substr(0, rest.find(' ')), name, row, rule), name, row);
  found.rows = rows_of(line);
  return found;
}

/// A channel whose heading begins at lines[head] and whose samples begin at lines[at].
RecordFile channel_of(const std::vector<std::string_view>& lines, std::size_t head, std::size_t& at,
                      const Announced& announced, const std::string& name) {
  RecordFile file;
  file.record.dt = announced.step;
  if (head + 2 < at) file.event = trimmed(lines[head + 2]);
  if (head + 6 < at) file.station = trimmed(lines[head + 6]);
  for (std::size_t i = head; i < at && file.component.empty(); ++i) file.component = after(lines[i], "CHAN ");
  file.record.values = fixed_numbers(lines, at, announced.samples, announced.rows, name);
  return file;
}

std::vector<RecordFile> read_csmip(const std::string& text, const std::string& name, double dt) {
  const std::vector<std::string_view> lines = lines_of(text);
  std::vector<RecordFile> channels;
  std::size_t head = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    const std::string line = upper(lines[i]);
    if (trimmed(line).starts_with(title)) head = i;
    if (line.find(mark) == std::string::npos) continue;
    const Announced announced = announced_in(lines[i], name, i + 1);
    std::size_t at = i + 1;
    channels.push_back(channel_of(lines, head, at, announced, name));
    if (dt > 0.0) channels.back().record.dt = dt;
    i = at - 1;
    head = at;
  }
  return channels;
}

}  // namespace

RecordFormat csmip_v2() {
  return {"CSMIP V2", 0.01, is_csmip, read_csmip};
}

}  // namespace voussoir
