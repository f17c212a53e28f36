// voussoir effects.
#include <fmt/format.h>
#include <fmt/ranges.h>

#include "io/case/case.h"
#include "solver/effects/effect.h"
#include "tools/voussoir/verb.h"

namespace voussoir {

namespace {

void print_effect(const Effect& effect) {
  fmt::print("| `{}` | {} |", effect.name, effect.help);
  std::string text;
  for (const EffectParameter& p : effect.parameters)
    text += fmt::format("{}`{}` ({}) {}: {:g} to {:g}, usually {:g}", text.empty() ? "" : "; ", p.name, p.unit, p.help,
                        p.low, p.high, p.usual);
  fmt::print(" {} |", text);
}

int effects_verb_run(const std::vector<std::string>& arguments) {
  CommandLine line("effects", "effects [CASE]", "voussoir effects cases/cs1-f.toml");
  line.positional = {"CASE"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  if (!values.count("CASE")) {
    fmt::print("| effect | description | parameters |\n| --- | --- | --- |\n");
    for (const Effect& effect : effects()) {
      print_effect(effect);
      fmt::print("\n");
    }
    return 0;
  }
  const Assembly assembly = make_assembly(read_case(values["CASE"].as<std::string>(), CaseUse::geometry));
  fmt::print("| effect | places in {} |\n| --- | --- |\n", values["CASE"].as<std::string>());
  for (const Effect& effect : effects()) {
    const std::vector<std::string> places = effect.places(assembly);
    fmt::print("| `{}` | {} |\n", effect.name, places.empty() ? "none" : fmt::format("{}", fmt::join(places, ", ")));
  }
  return 0;
}

}  // namespace

Verb effects_verb() {
  return {"effects", "list the effects that a model can lack ([[effect]]), and where each can act", effects_verb_run};
}

}  // namespace voussoir
