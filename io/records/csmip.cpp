// CSMIP volume 2: text and tables, then accelerations (velocities and displacements after them), eight a row of ten
// columns each, which may touch each other.
#include <cmath>

#include "io/records/format.h"
#include "io/records/rows.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

constexpr std::string_view mark = "POINTS OF ACCEL DATA EQUALLY SPACED AT";
constexpr std::size_t width = 10, per_row = 8;

bool recognises(std::string_view text) {
  return text.find(mark) != std::string_view::npos;
}

/// What follows `key` up to two blanks.
std::string after(std::string_view line, std::string_view key) {
  const std::size_t at = line.find(key);
  if (at == std::string_view::npos) return "";
  line = trimmed(line.substr(at + key.size()));
  return std::string(trimmed(line.substr(0, line.find("  "))));
}

/// Number of samples and step of a line that says them.
std::pair<double, double> size_and_step(std::string_view line, const std::string& name, std::size_t row) {
  const std::string rule = "expected as in '5696 " + std::string(mark) + "  .010 SEC.  (UNITS: CM/SEC/SEC)'";
  const std::size_t at = line.find(mark);
  const std::string_view rest = trimmed(line.substr(at + mark.size()));
  const double samples = number_in(trimmed(line.substr(0, at)), name, row, rule),
               step = number_in(rest.substr(0, rest.find(' ')), name, row, rule);
  if (line.find("CM/SEC/SEC") == std::string_view::npos || !(samples >= 2.0 && samples < 1e9) ||
      samples != std::floor(samples) || !(step > 0.0))
    throw InputError("{}:{}: '{}': {}", name, row, trimmed(line), rule);
  return {samples, step};
}

RecordFile read(const std::string& text, const std::string& name, double dt) {
  const std::vector<std::string_view> lines = lines_of(text);
  RecordFile file;
  std::size_t begin = 0, samples = 0;
  for (std::size_t i = 0; i < lines.size(); ++i) {
    if (lines[i].find(mark) == std::string_view::npos) continue;
    if (begin > 0)
      throw InputError("{}:{}: accelerations of another channel begin: give a file with one channel", name, i + 1);
    const auto [size, step] = size_and_step(lines[i], name, i + 1);
    samples = std::size_t(size);
    file.record.dt = dt > 0.0 ? dt : step;
    begin = i + 1;
  }
  for (std::size_t i = begin; i < lines.size() && file.record.values.size() < samples; ++i)
    for (std::size_t k = 0; k < per_row && file.record.values.size() < samples; ++k) {
      const std::string_view word = k * width < lines[i].size() ? trimmed(lines[i].substr(k * width, width)) : "";
      if (word.empty())
        throw InputError(
            "{}:{}: {} of {} samples, then a row with fewer than {}: the file is not whole; fetch it again", name,
            i + 1, file.record.values.size(), samples, per_row);
      file.record.values.push_back(number_in(word, name, i + 1, "rows must be eight numbers of ten columns each"));
    }
  if (file.record.values.size() < samples)
    throw InputError("{}: {} of {} samples: the file is not whole; fetch it again", name, file.record.values.size(),
                     samples);
  if (lines.size() > 2) file.event = trimmed(lines[2]);
  if (lines.size() > 6) file.station = trimmed(lines[6]);
  file.component = after(lines[0], "CHAN");
  return file;
}

}  // namespace

RecordFormat csmip_v2() {
  return {"CSMIP V2", 0.01, recognises, read};
}

}  // namespace voussoir
