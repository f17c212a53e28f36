#include "tools/rate/strip.h"

#include <fmt/format.h>

#include <algorithm>

#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

bool has_word(const Case& c, const std::string& ending, const std::string& usual) {
  for (const auto& [key, word] : c.generator_input.choices)
    if (key.ends_with(ending) && word != usual) return true;
  return false;
}

constexpr const char* beam_length = "beam.length";
constexpr const char* beam_group = "load";

}  // namespace

bool is_loading_test(const Case& c) {
  const auto length = c.generator_input.values.find(beam_length);
  return length != c.generator_input.values.end() && length->second > 0.0;
}

Case without_loading_test(const Case& c) {
  if (!is_loading_test(c)) return c;
  Case without = c;
  without.generator_input.values[beam_length] = 0.0;
  std::erase_if(without.settings.guides, [](const Guide& g) { return g.group == beam_group; });
  std::vector<StageSettings>& stages = without.settings.stages;
  const auto test = std::find_if(stages.begin(), stages.end(), [](const StageSettings& stage) {
    return std::any_of(stage.drives.begin(), stage.drives.end(), [](auto& d) { return d.group == beam_group; });
  });
  stages.erase(test, stages.end());
  without.motions.resize(stages.size());
  return without;
}

Case strip_case(const Case& c, double width) {
  if (c.generator != "bridge")
    throw InputError(
        "{}: only a bridge of generator = \"bridge\" can be reduced to a strip, and this one is {}. Leave out --strip, "
        "or write the bridge with that generator",
        c.path, c.generator.empty() ? "an assembly file" : "of generator = \"" + c.generator + "\"");
  if (c.generator_input.choices.at("backfill") == "none")
    throw InputError("{}: there is no fill to load. Set backfill in [bridge]", c.path);
  Case strip = without_loading_test(c);
  GeneratorInput& in = strip.generator_input;
  in.choices["extent"] = "strip";
  in.choices["backfill"] = "deformable";
  in.values["strip_width"] = width;
  in.values["skew"] = 0.0;
  for (auto& [key, word] : in.choices)
    if (key.ends_with("makeup")) word = "solid";
  for (auto& [key, value] : in.values)
    if ((key.starts_with("pier.") || key.starts_with("abutment.")) && key.ends_with(".width")) value = 0.0;
  strip.effects.clear();
  strip.sensors.clear();
  strip.settings.guides.clear();
  for (StageSettings& stage : strip.settings.stages) stage.construction.reset();
  std::erase_if(strip.settings.stages, [](const StageSettings& s) { return s.kind != StageSettings::Kind::gravity; });
  strip.motions.resize(strip.settings.stages.size());
  return strip;
}

std::vector<std::string> strip_remarks(const Case& c) {
  std::vector<std::string> remarks = {"the model has no spandrel walls and no parapets"};
  const GeneratorInput& in = c.generator_input;
  if (in("skew") != 0.0)
    remarks.push_back(fmt::format("the strip is square: the skew of {:g} degrees is left out", in("skew")));
  if (in.choices.at("backfill") != "deformable") remarks.push_back("the fill is a continuum instead of blocks");
  if (has_word(c, "makeup", "solid")) remarks.push_back("supports are solid");
  if (!c.effects.empty())
    remarks.push_back(fmt::format("{} left out", counted(c.effects.size(), "effect is", "effects are")));
  const Case rated = without_loading_test(c);
  const auto others = std::ranges::count_if(
      rated.settings.stages, [](const StageSettings& s) { return s.kind != StageSettings::Kind::gravity; });
  if (others > 0)
    remarks.push_back(
        fmt::format("{} left out", counted(others, "stage after gravity is", "stages after gravity are")));
  if (!rated.settings.guides.empty())
    remarks.push_back(fmt::format("{} left out", counted(rated.settings.guides.size(), "guide is", "guides are")));
  for (const StageSettings& stage : c.settings.stages)
    if (stage.construction) remarks.push_back("the whole weight acts at once, without construction steps");
  return remarks;
}

double effective_width(double over_wheels, double cover, double bridge_width) {
  constexpr double beside = 1.5;  // m
  return std::min(over_wheels + beside + cover, bridge_width);
}

}  // namespace voussoir
