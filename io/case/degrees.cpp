#include "io/case/degrees.h"

#include <fmt/format.h>

#include <cmath>
#include <cstdlib>

#include "solver/base/constants.h"

namespace voussoir {

double to_radians(double degrees) {
  return degrees * (pi / 180.0);
}

std::string number_text(double value) {
  std::string text = fmt::format("{}", value);
  if (text.find_first_of(".en") == std::string::npos) text += ".0";
  return text;
}

std::string quoted(const std::string& text) {
  std::string out = "\"";
  for (const char c : text) {
    if (c == '"' || c == '\\') {
      out += '\\';
      out += c;
    } else if (static_cast<unsigned char>(c) < 0x20 || c == 0x7f) {
      out += fmt::format("\\u{:04x}", static_cast<unsigned char>(c));
    } else {
      out += c;
    }
  }
  return out + '"';
}

std::string degrees_text(double radians) {
  const double degrees = radians * (180.0 / pi);
  for (int digits = 6; digits <= 17; ++digits) {
    const double rounded = std::strtod(fmt::format("{:.{}g}", degrees, digits).c_str(), nullptr);
    if (to_radians(rounded) == radians) return number_text(rounded);
  }
  double below = degrees, above = degrees;
  for (int i = 0; i < 4; ++i) {
    below = std::nextafter(below, -HUGE_VAL);
    above = std::nextafter(above, HUGE_VAL);
    if (to_radians(below) == radians) return number_text(below);
    if (to_radians(above) == radians) return number_text(above);
  }
  return number_text(degrees);
}

double writable_angle(double radians) {
  return to_radians(std::strtod(degrees_text(radians).c_str(), nullptr));
}

}  // namespace voussoir
