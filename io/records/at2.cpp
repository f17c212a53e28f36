// PEER AT2 (NGA-West2): four lines of heading, then numbers, five a row. The step is given with four decimals, so that
// 1/409.6 s reads .0024; `dt` gives the exact time step.
#include <algorithm>
#include <cctype>

#include "io/records/format.h"
#include "io/records/rows.h"
#include "solver/base/constants.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

constexpr std::size_t heading = 4;  // lines

bool is_at2(std::string_view text) {
  const std::vector<std::string_view> lines = lines_of(text.substr(0, 2000));
  return lines.size() > heading && upper(lines[heading - 1]).find("NPTS") != std::string::npos &&
         upper(lines[heading - 1]).find("DT") != std::string::npos;
}

/// "NPTS=  16392, DT=   .0024 SEC" or "16392  .0024  NPTS, DT": the numbers in their order.
std::pair<double, double> size_and_step(const std::string& line, const std::string& name) {
  std::vector<double> numbers;
  std::string word;
  for (const char c : line + " ") {
    if (std::isdigit(static_cast<unsigned char>(c)) || c == '.' || ((c == 'E' || c == '-') && !word.empty())) {
      word += c;
    } else if (!word.empty()) {
      if (word != ".")
        numbers.push_back(number_in(word, name, heading, "the number of samples and the time step are expected here"));
      word.clear();
    }
  }
  if (numbers.size() < 2)
    throw InputError(
        "{}:{}: '{}' does not state the number of samples and the time step (s). It must have the form 'NPTS= 4000, "
        "DT= .0050 SEC'.",
        name, heading, excerpt(line));
  return {double(checked_samples(numbers[0], name, heading)), checked_step(numbers[1], name, heading)};
}

RecordFile read_at2(const std::string& text, const std::string& name, double dt) {
  const std::vector<std::string_view> lines = lines_of(text);
  const std::string quantity = upper(lines[2]);
  if (quantity.find("VELOCITY") != std::string::npos || quantity.find("DISPLACEMENT") != std::string::npos)
    throw InputError("{}:3: '{}': the program reads only accelerations, not velocities and displacements (VT2, DT2)",
                     name, excerpt(lines[2]));
  if (quantity.find("ACCELERATION") == std::string::npos || quantity.find(" G") == std::string::npos)
    throw InputError("{}:3: '{}' is not a time series of accelerations in units of g", name, excerpt(lines[2]));
  const auto [samples, step] = size_and_step(upper(lines[heading - 1]), name);
  RecordFile file;
  file.record.dt = dt > 0.0 ? dt : step;
  for (std::size_t i = heading; i < lines.size(); ++i)
    append_numbers(lines[i], " \t", name, i + 1, "accelerations are expected after four lines of heading",
                   file.record.values);
  if (double(file.record.values.size()) != samples)
    throw InputError("{}: {}, but line {} says {:.0f}: the file is incomplete; download it again", name,
                     counted(file.record.values.size(), "sample"), heading, samples);
  // "Imperial Valley-06, 10/15/1979, Agrarias, 3"
  const std::string_view about = lines[1];
  std::vector<std::string> parts;
  for (std::size_t begin = 0; begin <= about.size();) {
    const std::size_t end = std::min(about.find(',', begin), about.size());
    parts.emplace_back(trimmed(about.substr(begin, end - begin)));
    begin = end + 1;
  }
  file.event = parts.front();
  if (parts.size() > 2) file.station = parts[parts.size() - 2];
  if (parts.size() > 1) file.component = parts.back();
  return file;
}

}  // namespace

RecordFormat peer_at2() {
  return {"PEER AT2", standard_gravity, is_at2, one_channel<read_at2>};
}

}  // namespace voussoir
