#include "tools/blind/trials.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>

#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

bool is_fault(const std::string& effect) {
  return effect.starts_with("sensor_fault ");
}

}  // namespace

TrialKind kind_of(const BlindTrial& t) {
  if (t.effects.empty() && t.loosened.empty()) return TrialKind::nothing;
  if (!t.without.empty() || !t.loosened.empty()) return TrialKind::outside;
  if (std::all_of(t.effects.begin(), t.effects.end(), is_fault)) return TrialKind::fault;
  return t.effects.size() > 1 ? TrialKind::two : TrialKind::one;
}

std::string hidden_text(const BlindTrial& t, const std::vector<std::string>& effects) {
  std::vector<std::string> parts = effects;
  for (const std::string& l : t.loosened) parts.push_back("loosened " + l);
  std::string text = parts.empty() ? "nothing" : fmt::format("{}", fmt::join(parts, " + "));
  if (t.minutes > 0.0) text += fmt::format(", {:g} min recorded", t.minutes);
  if (t.shaken > 0.0) text += fmt::format(", {:g} s of an earthquake", t.shaken);
  return t.without.empty() ? text : fmt::format("{}, out of the library", text);
}

std::string truth_text(const BlindTrial& t) {
  std::string text = fmt::format("mesh {:.2f}, defects {:.3f} m, scatter {:.3f}", t.mesh, t.defects, t.scatter);
  if (t.noise_said != 1.0) text += fmt::format(", noise said {:g}", t.noise_said);
  if (t.fill != "rigid") text += fmt::format(", case with backfill={}", t.fill);
  for (const std::string& key : t.truth) text += ", " + key;
  if (t.parapet_gaps > 0) text += fmt::format(", {}", counted(t.parapet_gaps, "parapet gap"));
  return text;
}

Suite find_suite(const std::string& name) {
  if (name == "first") return {name, first_suite()};
  if (name == "second" || name == "third")
    return {name, drawn_suite(name == "second" ? 2 : 3), 0.8, 80.0, 5.0, 3.0, 90.0, 97.0, 95.0};
  throw InputError("--suite is '{}'. It must be first, second or third", name);
}

std::string case_of(const BlindTrial& t) {
  return fmt::format(
      "[bridge]\ngenerator = \"{}\"\nabutments = \"free\"\nbackfill = \"{}\"\nfill_edge = 1.2\nblock_scale = {}\n"
      "abutment_leaf_length = 1.5\n",  // of cs1, when the suites were drawn
      t.bridge, t.fill, t.bridge == "cs1" ? 3.0 : 1.8);
}

}  // namespace voussoir
