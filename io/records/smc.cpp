// SMC of the USGS: eleven lines of text, six of whole numbers (eight a row of ten columns), ten of numbers (five a row
// of fifteen columns), comments that begin with "|", then accelerations in cm/s2, eight a row of ten columns.
#include "io/records/format.h"
#include "io/records/rows.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

constexpr std::size_t smc_text_lines = 11, whole_lines = 6, number_lines = 10;
constexpr FixedRows whole_rows{10, 8}, number_rows{15, 5}, sample_rows{10, 8};

bool is_smc(std::string_view text) {
  const std::string first = upper(trimmed(text.substr(0, text.find('\n'))));
  return first.starts_with("1 UNCORRECTED ACCELEROGRAM") || first.starts_with("2 CORRECTED ACCELEROGRAM") ||
         first.starts_with("3 VELOCITY") || first.starts_with("4 DISPLACEMENT");
}

/// "UP" and "DOWN" by the angle from the vertical, else the azimuth.
std::string direction_of(double from_vertical, double azimuth) {
  if (from_vertical == 0.0) return "UP";
  if (from_vertical == 180.0) return "DOWN";
  return azimuth >= 0.0 && azimuth <= 360.0 ? fmt::format("{:g}", azimuth) : "";
}

RecordFile read_smc(const std::string& text, const std::string& name, double dt) {
  const std::vector<std::string_view> lines = lines_of(text);
  if (const std::string first = upper(trimmed(lines[0])); first.find("ACCELEROGRAM") == std::string::npos)
    throw InputError("{}:1: '{}': use the file with the accelerations", name, excerpt(lines[0]));
  if (lines.size() < smc_text_lines + whole_lines + number_lines)
    throw InputError("{}: {}, but the heading of SMC has {}: the file is incomplete; download it again", name,
                     counted(lines.size(), "line"), smc_text_lines + whole_lines + number_lines);
  std::size_t at = smc_text_lines;
  const std::vector<double> whole = fixed_numbers(lines, at, whole_lines * whole_rows.per_row, whole_rows, name);
  const std::vector<double> numbers = fixed_numbers(lines, at, number_lines * number_rows.per_row, number_rows, name);
  while (at < lines.size() && lines[at].starts_with('|')) ++at;
  RecordFile file;
  const std::size_t samples = checked_samples(whole[16], name, smc_text_lines + 3);
  file.record.dt = checked_step(1.0 / numbers[1], name, smc_text_lines + whole_lines + 1);
  if (dt > 0.0) file.record.dt = dt;
  file.record.values = fixed_numbers(lines, at, samples, sample_rows, name);
  file.event = trimmed(lines[3]);
  file.station = trimmed(lines[2].substr(0, 4));
  if (file.station.empty()) file.station = trimmed(lines[5]);
  file.component = direction_of(whole[12], whole[13]);
  return file;
}

}  // namespace

RecordFormat smc() {
  return {"SMC", 0.01, is_smc, one_channel<read_smc>};
}

}  // namespace voussoir
