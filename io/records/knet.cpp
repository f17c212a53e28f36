// K-NET and KiK-net of Japan (NIED): seventeen lines "Key   value", then counts, eight a row. A count is worth the
// scale factor of the heading, "3920(gal)/6182761"; counts have an offset, so that the mean is taken off.
#include <map>

#include "io/records/format.h"
#include "io/records/rows.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

constexpr std::size_t key_width = 18;

bool is_knet(std::string_view text) {
  const std::string head = upper(text.substr(0, 3000));
  return head.starts_with("ORIGIN TIME") && head.find("SCALE FACTOR") != std::string::npos;
}

struct Heading {
  std::map<std::string, std::pair<std::string, std::size_t>> values;  // and their lines, from 1
  std::size_t lines = 0;

  const std::pair<std::string, std::size_t>& at(const std::string& key, const std::string& name) const {
    const auto found = values.find(key);
    if (found == values.end())
      throw InputError("{}: the heading of K-NET has no line '{}': the file is incomplete; download it again", name,
                       key);
    return found->second;
  }
  std::string text(const std::string& key) const {
    const auto found = values.find(key);
    return found == values.end() ? "" : found->second.first;
  }
};

Heading heading_of(const std::vector<std::string_view>& lines) {
  Heading heading;
  for (const std::string_view line : lines) {
    if (heading.lines > 0 && all_numbers(line, " \t")) break;
    ++heading.lines;
    const std::string_view key = trimmed(line.substr(0, key_width));
    const std::string_view value = line.size() > key_width ? trimmed(line.substr(key_width)) : "";
    heading.values[upper(key)] = {std::string(value), heading.lines};
  }
  return heading;
}

/// gal of a count.
double scale_of(const Heading& heading, const std::string& name) {
  const auto& [text, line] = heading.at("SCALE FACTOR", name);
  const std::size_t slash = text.find('/');
  const double above = first_number(text),
               below = slash == std::string::npos ? 0.0 : first_number(std::string_view(text).substr(slash + 1));
  if (!(above > 0.0 && above <= 1e6 && below >= 1.0 && below <= 1e12))
    throw InputError("{}:{}: the scale factor is '{}'. It must have the form '3920(gal)/6182761'.", name, line,
                     excerpt(text));
  return above / below;
}

/// "N-S" of K-NET; KiK-net numbers its sensors, 1 to 3 in the borehole, 4 to 6 at the surface.
std::string direction_of(const std::string& text) {
  constexpr const char* numbered[] = {"NS1", "EW1", "UD1", "NS2", "EW2", "UD2"};
  if (text.size() == 1 && text[0] >= '1' && text[0] <= '6') return numbered[text[0] - '1'];
  std::string word;
  for (const char c : text)
    if (c != '-') word += c;
  return word;
}

RecordFile read_knet(const std::string& text, const std::string& name, double dt) {
  const std::vector<std::string_view> lines = lines_of(text);
  const Heading heading = heading_of(lines);
  const double scale = scale_of(heading, name);
  const auto& [rate, rate_line] = heading.at("SAMPLING FREQ(HZ)", name);
  RecordFile file;
  file.record.dt = checked_step(1.0 / first_number(rate), name, rate_line);
  const auto& [duration, duration_line] = heading.at("DURATION TIME(S)", name);
  const double expected = first_number(duration) / file.record.dt;
  checked_samples(std::round(expected), name, duration_line);
  if (dt > 0.0) file.record.dt = dt;
  std::vector<double>& values = file.record.values;
  for (std::size_t i = heading.lines; i < lines.size(); ++i)
    append_numbers(lines[i], " \t", name, i + 1, "counts are expected after the heading", values);
  if (std::abs(double(values.size()) - expected) > 1.0)
    throw InputError("{}: {}, but line {} says {:.0f}: the file is incomplete; download it again", name,
                     counted(values.size(), "sample"), duration_line, expected);
  double mean = 0.0;
  for (const double count : values) mean += count / double(values.size());
  for (double& value : values) value = (value - mean) * scale;
  file.event = heading.text("ORIGIN TIME");
  file.component = direction_of(heading.text("DIR."));
  // The two sensors of a place are two recordings.
  file.station = heading.text("STATION CODE") + (file.component.ends_with('1') ? " borehole" : "");
  return file;
}

}  // namespace

RecordFormat knet() {
  return {"K-NET", 0.01, is_knet, one_channel<read_knet>};
}

}  // namespace voussoir
