// GeoNet of New Zealand (V1A uncorrected, V2A corrected): for each of three components sixteen lines of text, four of
// whole numbers (ten a row of eight columns), six of numbers, then accelerations in mm/s2, ten a row of eight columns;
// of corrected ones velocities and displacements, too.
#include <cmath>

#include "io/records/format.h"
#include "io/records/rows.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/words.h"

namespace voussoir {

namespace {

constexpr std::size_t geonet_text_lines = 16, heading_lines = 26;
constexpr FixedRows rows{8, 10};

bool recognises(std::string_view text) {
  const std::string first = upper(text.substr(0, text.find('\n')));
  return first.find("CORRECTED ACCELEROGRAM") != std::string::npos && first.find("GNS") != std::string::npos;
}

/// The number after `key` in a line of text, such as "Number of points  1200"; NaN: no such line.
double said(const std::vector<std::string_view>& lines, std::size_t head, std::string_view key) {
  for (std::size_t i = head; i < head + geonet_text_lines; ++i)
    if (const std::size_t at = upper(lines[i]).find(key); at != std::string::npos)
      return first_number(lines[i].substr(at + key.size()));
  return std::nan("");
}

/// The time step of a line that ends "… at 0.010 sec intervals".
double said_step(const std::vector<std::string_view>& lines, std::size_t head) {
  for (std::size_t i = head; i < head + geonet_text_lines; ++i) {
    const std::string line = upper(lines[i]);
    const std::size_t end = line.find("SEC INTERVAL"), begin = end == std::string::npos ? end : line.rfind("AT ", end);
    if (begin != std::string::npos) return first_number(std::string_view(line).substr(begin + 3));
  }
  return std::nan("");
}

/// "N25E" is an azimuth of 25 degrees, "S72W" one of 252.
std::string azimuth_of(const std::string& direction) {
  const std::string word = upper(direction);
  const double angle = word.size() < 3 ? std::nan("") : first_number(std::string_view(word).substr(1));
  if (!(angle >= 0.0 && angle <= 90.0)) return word;
  const bool north = word.front() == 'N', east = word.back() == 'E';
  const double azimuth = north ? (east ? angle : 360.0 - angle) : (east ? 180.0 - angle : 180.0 + angle);
  return fmt::format("{:.0f}", azimuth);
}

std::string component_of(const std::vector<std::string_view>& lines, std::size_t head) {
  for (std::size_t i = head; i < head + geonet_text_lines; ++i) {
    const std::vector<std::string_view> words = words_of(lines[i]);
    if (words.size() > 1 && upper(words[0]) == "COMPONENT") return azimuth_of(std::string(words[1]));
  }
  return "";
}

RecordFile channel_of(const std::vector<std::string_view>& lines, std::size_t& at, double dt, const std::string& name) {
  const std::size_t head = at;
  if (head + heading_lines > lines.size())
    throw InputError("{}:{}: {} left, but a heading of GeoNet has {}: the file is incomplete; download it again", name,
                     head + 1, counted(lines.size() - head, "line is", "lines are"), heading_lines);
  at = head + geonet_text_lines;
  const std::vector<double> numbers = fixed_numbers(lines, at, 100, rows, name);
  const bool corrected = upper(lines[head]).find("UNCORRECTED") == std::string::npos;
  // Values of the tables take precedence over those of the text, except the time step of uncorrected records.
  double samples = numbers[corrected ? 33 : 30], step = corrected ? numbers[65] : said_step(lines, head);
  if (!(samples > 0.0)) samples = said(lines, head, "NUMBER OF POINTS");
  if (!(step > 0.0)) step = corrected ? said_step(lines, head) : numbers[64];
  RecordFile file;
  const std::size_t count = checked_samples(samples, name, head + geonet_text_lines + 4);
  file.record.dt = dt > 0.0 ? dt : checked_step(step, name, head + geonet_text_lines + 7);
  file.record.values = fixed_numbers(lines, at, count, rows, name);
  const std::vector<std::string_view> first = words_of(lines[head]), site = words_of(lines[head + 1]);
  if (first.size() > 2) file.event = first[2].substr(0, 15);  // 20161113_110256_WTMC_20: date and time
  if (site.size() > 1) file.station = site[1];
  file.component = component_of(lines, head);
  for (const std::size_t others : {34u, 35u})
    if (corrected && numbers[others] > 0.0)
      fixed_numbers(lines, at, checked_samples(numbers[others], name, head + geonet_text_lines + 4), rows, name);
  return file;
}

std::vector<RecordFile> read(const std::string& text, const std::string& name, double dt) {
  const std::vector<std::string_view> lines = lines_of(text);
  std::vector<RecordFile> channels;
  for (std::size_t at = 0; at < lines.size();)
    if (trimmed(lines[at]).empty())
      ++at;
    else
      channels.push_back(channel_of(lines, at, dt, name));
  return channels;
}

}  // namespace

RecordFormat geonet() {
  return {"GeoNet", 0.001, recognises, read};
}

}  // namespace voussoir
