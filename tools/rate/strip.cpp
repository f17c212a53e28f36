#include "tools/rate/strip.h"

#include <fmt/format.h>

#include "solver/base/error.h"

namespace voussoir {

namespace {

bool has_word(const Case& c, const std::string& ending, const std::string& usual) {
  for (const auto& [key, word] : c.generator_input.choices)
    if (key.ends_with(ending) && word != usual) return true;
  return false;
}

}  // namespace

Case strip_case(const Case& c, double width) {
  if (c.generator != "bridge")
    throw InputError(
        "{}: only a bridge of generator = \"bridge\" can be cut to a strip, and this one is {}: leave out --strip, or "
        "write the bridge with that generator",
        c.path, c.generator.empty() ? "an assembly file" : "of generator = \"" + c.generator + "\"");
  if (c.generator_input.choices.at("backfill") == "none")
    throw InputError("{}: there is no fill to load: set backfill in [bridge]", c.path);
  Case strip = c;
  GeneratorInput& in = strip.generator_input;
  in.choices["extent"] = "strip";
  in.choices["backfill"] = "deformable";
  in.values["strip_width"] = width;
  in.values["skew"] = 0.0;
  in.values["beam.length"] = 0.0;
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
  std::vector<std::string> remarks;
  const GeneratorInput& in = c.generator_input;
  if (in("skew") != 0.0)
    remarks.push_back(fmt::format("laid square: the skew of {:g} degrees is left out", in("skew")));
  if (in.choices.at("backfill") != "deformable") remarks.push_back("the fill is a continuum, not blocks");
  if (has_word(c, "makeup", "solid")) remarks.push_back("supports are solid");
  if (!c.effects.empty()) remarks.push_back(fmt::format("{} effects are left out", c.effects.size()));
  for (const StageSettings& stage : c.settings.stages)
    if (stage.construction) remarks.push_back("its weight comes at once, not in steps of construction");
  return remarks;
}

double effective_width(double over_wheels, double cover, double bridge_width) {
  constexpr double beside = 1.5;  // m
  return std::min(over_wheels + beside + cover, bridge_width);
}

}  // namespace voussoir
