#include "io/measured/parts.h"
#include "tools/fuzz/answer.h"
#include "tools/fuzz/readers.h"

namespace voussoir::fuzz {

void read_table(const std::string& bytes) {
  Measured measured;
  std::string name = "sensors.csv", text;
  const auto finish_part = [&] {
    const TextFile file{name, name, text};
    answer([&] {
      if (name == "modes.csv") return parse_modes(file, measured);
      if (name == "shapes.csv") return parse_shapes(file, measured);
      if (name == "about.toml") return parse_about(file, measured);
      if (name == "record.csv") return parse_record(file, measured);
      parse_sensors(file, measured);
    });
  };
  for (std::size_t at = 0; at < bytes.size();) {
    const std::size_t end = std::min(bytes.find('\n', at), bytes.size() - 1) + 1;
    const std::string line = bytes.substr(at, end - at);
    at = end;
    if (!line.starts_with("%% ")) {
      text += line;
      continue;
    }
    finish_part();
    name = line.substr(3, line.find_last_not_of("\r\n") - 2);
    text.clear();
  }
  finish_part();
}

}  // namespace voussoir::fuzz
