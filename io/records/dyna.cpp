// Files of ITACA and ESM (ITACA 1.1 and 2.0, DYNA 1.0 and 1.2): lines "KEY: value", then one number a line.
#include <cctype>
#include <map>

#include "io/records/format.h"
#include "io/records/rows.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

bool is_dyna(std::string_view text) {
  return upper(text.substr(0, 11)) == "EVENT_NAME:";
}

struct Header {
  std::map<std::string, std::pair<std::string, std::size_t>, std::less<>> values;  // and their lines, from 1
  std::size_t lines = 0;
};

Header header_of(const std::vector<std::string_view>& lines) {
  Header header;
  for (const std::string_view line : lines) {
    const std::size_t colon = line.find(':');
    if (colon == std::string_view::npos || !std::isalpha(static_cast<unsigned char>(line[0]))) break;
    ++header.lines;
    header.values[upper(trimmed(line.substr(0, colon)))] = {std::string(trimmed(line.substr(colon + 1))), header.lines};
  }
  return header;
}

double number_of(const Header& header, std::string_view key, const std::string& name) {
  const auto at = header.values.find(key);
  if (at == header.values.end())
    throw InputError("{}: the heading has no line '{}:': the file is incomplete; download it again", name, key);
  const auto& [value, line] = at->second;
  return number_in(value, name, line, std::string(key) + " must be a number");
}

std::string text_of(const Header& header, std::string_view key) {
  const auto at = header.values.find(key);
  return at == header.values.end() ? "" : at->second.first;
}

RecordFile read_dyna(const std::string& text, const std::string& name, double dt) {
  const std::vector<std::string_view> lines = lines_of(text);
  const Header header = header_of(lines);
  RecordFile file;
  const std::string type = text_of(header, "DATA_TYPE"), units = text_of(header, "UNITS");
  const std::string kind = upper(type);
  if (kind.find("ACCELERATION") == std::string::npos || kind.find("SPECTR") != std::string::npos)
    throw InputError("{}: DATA_TYPE is '{}': use the file with the accelerations (…ACC.ASC)", name, excerpt(type));
  if (const std::string unit = upper(units); unit != "CM/S^2" && unit != "CM/S2" && unit != "GAL")
    throw InputError("{}: UNITS is '{}', expected cm/s^2", name, excerpt(units));
  const double step = number_of(header, "SAMPLING_INTERVAL_S", name), samples = number_of(header, "NDATA", name);
  checked_step(step, name, header.values.find("SAMPLING_INTERVAL_S")->second.second);
  checked_samples(samples, name, header.values.find("NDATA")->second.second);
  file.record.dt = dt > 0.0 ? dt : step;
  for (std::size_t i = header.lines; i < lines.size(); ++i)
    append_numbers(lines[i], " \t", name, i + 1, "accelerations are expected after the heading", file.record.values);
  if (double(file.record.values.size()) != samples)
    throw InputError("{}: {}, but NDATA is {:.0f}: the file is incomplete; download it again", name,
                     counted(file.record.values.size(), "sample"), samples);
  file.event = text_of(header, "EVENT_NAME");
  file.station = text_of(header, "STATION_CODE");
  file.component = text_of(header, "COMPONENT");
  if (file.component.empty()) file.component = text_of(header, "STREAM");
  return file;
}

}  // namespace

RecordFormat dyna() {
  return {"ITACA/ESM ASCII", 0.01, is_dyna, one_channel<read_dyna>};
}

}  // namespace voussoir
