#include "tools/diagnosis/diagnosis_values.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace voussoir {

namespace {

std::string superscript(int number) {
  static const std::vector<std::string> digits = {"⁰", "¹", "²", "³", "⁴", "⁵", "⁶", "⁷", "⁸", "⁹"};
  std::string text = number < 0 ? "⁻" : "";
  for (char c : std::to_string(std::abs(number))) text += digits[std::size_t(c - '0')];
  return text;
}

/// The first digit of the standard deviation is the last of the value, and the second where the first is 1.
int decimals_of(double std) {
  const double power = std::floor(std::log10(std));
  return std::clamp(int(-power) + (std / std::pow(10.0, power) < 2.0 ? 1 : 0), 0, 9);
}

std::string plain_number(double value) {
  std::string text = fmt::format("{:.3g}", value);
  if (text[0] == '-') text.replace(0, 1, "−");
  return text;
}

std::string minus_sign(std::string text) {
  if (!text.empty() && text[0] == '-') text.replace(0, 1, "−");
  return text;
}

}  // namespace

std::string with_std(double value, double std) {
  const double size = std::max(std::abs(value), std::isfinite(std) ? std : 0.0);
  if (size > 0.0 && (size >= 1e5 || size < 1e-3)) {
    const int power = int(std::floor(std::log10(size)));
    const double scale = std::pow(10.0, power);
    const std::string number = with_std(value / scale, std / scale);
    return std > 0.0 ? fmt::format("({}) × 10{}", number, superscript(power))
                     : fmt::format("{} × 10{}", number, superscript(power));
  }
  if (!std::isfinite(std) || std <= 0.0) return plain_number(value);
  const int decimals = decimals_of(std);
  return minus_sign(fmt::format("{:.{}f} ± {:.{}f}", value, decimals, std, decimals));
}

std::string FittedValue::text() const {
  const std::string number = unit == "-" || unit.empty() ? with_std(value, std) : with_std(value, std) + " " + unit;
  return fmt::format("{} {}{}", name, number, at_bound ? " (at its bound)" : "");
}

std::vector<FittedValue> fitted_values(const Fit& fit, std::size_t index) {
  auto at = fit.hypothesis.materials.size();
  for (std::size_t i = 0; i < index; ++i) at += fit.hypothesis.effects[i].parameters.size();
  const Candidate& c = fit.hypothesis.effects[index];
  std::vector<FittedValue> values;
  for (std::size_t i = 0; i < c.parameters.size(); ++i, ++at) {
    const FitParameter& p = c.parameters[i];
    const double x = fit.best.x[Eigen::Index(at)], std = fit.std[Eigen::Index(at)];
    const bool bound = at < fit.at_bound.size() && fit.at_bound[at];
    values.push_back({p.name, p.unit, p.value(x), 0.5 * (p.value(x + std) - p.value(x - std)), bound});
  }
  if (c.kind == Candidate::Kind::gain && c.parameters.empty()) values.push_back({"gain", "-", c.gain, 0.0, false});
  if (c.turn != 0.0) values.push_back({"turn", "deg", c.turn, 0.0, false});
  if (c.tilt != 0.0) values.push_back({"tilt", "deg", c.tilt, 0.0, false});
  return values;
}

std::string fitted_text(const Fit& fit, std::size_t index) {
  std::string text;
  for (const FittedValue& v : fitted_values(fit, index)) text += (text.empty() ? "" : ", ") + v.text();
  return text;
}

std::string nameless_text(const Fit& fit, std::size_t index) {
  const FittedValue value = fitted_values(fit, index).front();
  const Candidate& c = fit.hypothesis.effects[index];
  if (value.name != "factor")
    return fmt::format("{} between {} and the ground are missing: {} {}", c.name, c.where,
                       with_std(value.value, value.std), value.unit);
  return fmt::format("{} of {} should be {} times as large", c.name, c.where, with_std(value.value, value.std));
}

std::string probability_text(double probability) {
  if (probability < 0.005) return "below 0.01";
  if (probability > 0.995) return "above 0.99";
  return fmt::format("{:.2f}", probability);
}

std::string gap_text(double gap) {
  return std::isfinite(gap) ? fmt::format("{:.2f}", gap) : std::string("none");
}

std::string plain_name(const Candidate& c) {
  std::string text = c.full_text();
  std::replace(text.begin(), text.begin() + std::ptrdiff_t(c.name.size()), '_', ' ');
  return text;
}

std::vector<const Round*> accepted_rounds(const std::vector<Round>& rounds) {
  std::vector<const Round*> accepted;
  for (const Round& round : rounds)
    if (round.accepted) accepted.push_back(&round);
  return accepted;
}

std::string mode_title(const ModeComparison& mode) {
  const bool number = std::all_of(mode.name.begin(), mode.name.end(), [](char c) { return c >= '0' && c <= '9'; });
  return number ? fmt::format("mode {}", mode.name) : mode.name;
}

std::string mode_motion(const ModeComparison& mode) {
  if (!mode.direction.empty()) return mode.direction;
  if (mode.after > 0.0) return fmt::format("as {}", mode.words_after);
  return mode.before > 0.0 ? fmt::format("as {}", mode.words_before) : std::string("direction not given");
}

}  // namespace voussoir
