#include "tools/run/damage_words.h"

#include <fmt/format.h>

#include <cmath>

namespace voussoir {

namespace {

constexpr double fallen = 1.0;  // m, opening from which a stone counts as fallen

/// Of a length: 0.04 mm, 3.2 mm, 18 mm.
int decimals_of(double metres) {
  return metres < 1e-4 ? 2 : metres < 1e-2 ? 1 : 0;
}

}  // namespace

const std::vector<DamageClass>& damage_classes() {
  static const std::vector<DamageClass> classes = {{"negligible", 1e-4}, {"very slight", 1e-3},
                                                   {"slight", 5e-3},     {"moderate", 15e-3},
                                                   {"severe", 25e-3},    {"very severe", INFINITY}};
  return classes;
}

const char* damage_word(double opening) {
  for (const DamageClass& c : damage_classes())
    if (opening < c.below) return c.word;
  return damage_classes().back().word;
}

std::string mm_text(double metres, int decimals) {
  const double mm = 1e3 * metres, step = std::pow(10.0, -decimals);
  return std::abs(mm) < 0.5 * step ? fmt::format("less than {:.{}f} mm", step, decimals)
                                   : fmt::format("{:.{}f} mm", mm, decimals);
}

std::string bound_text(double metres, int decimals) {
  const std::string text = mm_text(metres, decimals);
  return text.starts_with("less") ? text : "up to " + text;
}

std::string damage_sentence(const nlohmann::json& damage) {
  const double opening = damage.value("largest_opening", 0.0), slip = damage.value("largest_slip", 0.0),
               broken = damage.value("broken_share", 0.0);
  std::string text = damage_word(opening);
  if (opening >= fallen) {
    text += fmt::format(": joints opened by more than {:g} m, stones fell", fallen);
  } else {
    text += ": joints opened by " + bound_text(opening, decimals_of(opening));
    const double residual = damage.value("residual_opening", 0.0);
    if (damage.contains("residual_opening") && opening >= 5e-6)
      text += fmt::format(" ({} still open)", mm_text(residual, decimals_of(residual)));
    text += ", slid by " + bound_text(slip, decimals_of(slip));
  }
  if (!damage.value("bonded", true)) return text + "; joints without bond";
  return text + fmt::format("; {} of the bonded joint area broken",
                            broken == 0.0    ? "nothing"
                            : broken < 0.001 ? "less than 0.1 %"
                                             : fmt::format("{:.{}f} %", 100.0 * broken, broken < 0.1 ? 1 : 0));
}

}  // namespace voussoir
