// voussoir hide.
#include "tools/hide/hide.h"

#include <fmt/format.h>

#include <filesystem>
#include <sstream>

#include "io/case/case.h"
#include "solver/base/atomic_file.h"
#include "solver/base/error.h"
#include "tools/voussoir/options.h"

namespace voussoir {

namespace {

/// "abutment_restraint both stiffness_share=0.5": what stands between the name and the parameters is the place.
EffectSetting parse_effect(const std::string& text) {
  std::istringstream words(text);
  EffectSetting effect;
  std::string word;
  words >> effect.name;
  while (words >> word) {
    const std::size_t at = word.find('=');
    if (at == std::string::npos) {
      effect.where += (effect.where.empty() ? "" : " ") + word;
      continue;
    }
    try {
      effect.values[word.substr(0, at)] = std::stod(word.substr(at + 1));
    } catch (const std::exception&) {
      throw InputError("--effect \"{}\": {} is no parameter=number", text, word);
    }
  }
  complete(effect);
  return effect;
}

/// "key=value".
std::pair<std::string, std::string> parse_truth(const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    throw InputError("--truth \"{}\": expected KEY=VALUE, such as backfill=deformable or width=7.3", text);
  return {text.substr(0, at), text.substr(at + 1)};
}

/// What a case without a generator does not have: blocks and dimensions of its own. Default values do not act there.
void keep_blocks(HideRequest& request, const options::variables_map& values) {
  if (!read_case(request.case_file, CaseUse::geometry).generator.empty()) return;
  for (const char* option : {"mesh", "defects"})
    if (!values[option].defaulted())
      throw InputError("--{}: {} is made from an assembly file, whose blocks stay as they are; leave it out", option,
                       request.case_file);
  request.mesh = 1.0, request.defects = 0.0;
}

void write(const HideRequest& request, const HiddenBridge& hidden) {
  std::filesystem::create_directories(request.directory);
  write_measured(hidden.measured, request.directory + "/measured");
  write_atomically(request.directory + "/answer.toml", hidden.answer);
  fmt::print("{} at {} sensors in {}/measured; the answer is in {}/answer.toml\n",
             request.shaken > 0.0    ? fmt::format("{:g} s of an earthquake", request.shaken)
             : request.minutes > 0.0 ? fmt::format("{:g} min of vibration", request.minutes)
                                     : fmt::format("{} modes", hidden.measured.modes.size()),
             hidden.measured.sensors.size(), request.directory, request.directory);
}

int hide_run(const std::vector<std::string>& arguments) {
  CommandLine line("hide", "hide CASE --effect \"NAME PLACE PARAMETER=VALUE\" -o DIR",
                   "voussoir hide cases/cs1-f.toml --effect \"abutment_restraint both\" --seed 7 -o hidden");
  HideRequest request;
  using Texts = std::vector<std::string>;
  line.described.add_options()("effect", options::value<Texts>()->composing(),
                               "what the case lacks; may be repeated; none: nothing")(
      "loosen", options::value<Texts>()->composing(),
      "what the case lacks and no effect makes: \"x=12..14 z=9.. part=arch 1 factor=0.05\", on the stiffness of joints "
      "whose centroids lie in the box (m), or density= on the mass of its blocks; may be repeated")(
      "truth", options::value<Texts>()->composing(),
      "KEY=VALUE, a key of the generator that the true bridge has otherwise, such as backfill=deformable; may be "
      "repeated")("sensors", options::value<std::string>(&request.sensors)->default_value(request.sensors),
                  "sparse, rich, none (periods alone), a number of channels from 5 to 40 drawn by the seed, or a file "
                  "like measured/sensors.csv")(
      "modes", whole_option("modes", 1, 1000, &request.modes)->default_value(6), "that are measured")(
      "minutes", real_option("minutes", 0.0, 600.0, &request.minutes)->default_value(0.0),
      "of ambient vibration instead of modes; the noise of its channels is five times --noise")(
      "shaken", real_option("shaken", 0.0, 3600.0, &request.shaken)->default_value(0.0),
      "s of a synthetic earthquake, recorded on the ground too, instead of modes; noise as with --minutes")(
      "noise",
      real_option("noise", 0.0, 0.999, &request.noise)->default_value(request.noise, fmt::format("{}", request.noise)),
      "standard deviation of periods, share; of shapes twice that")(
      "noise-said", real_option("noise-said", 0.01, 100.0, &request.noise_said)->default_value(1.0),
      "deviations as they are written over the true ones: 0.5 understates them by half")(
      "scatter",
      real_option("scatter", 0.0, 0.999, &request.scatter)
          ->default_value(request.scatter, fmt::format("{}", request.scatter)),
      "of the stiffness of each part (standard deviation of the logarithm)")(
      "materials",
      real_option("materials", 0.0, 0.999, &request.materials)
          ->default_value(request.materials, fmt::format("{}", request.materials)),
      "the same, of each material")("defects",
                                    real_option("defects", 0.0, 0.999, &request.defects)
                                        ->default_value(request.defects, fmt::format("{}", request.defects)),
                                    "m, standard deviation of every dimension")(
      "mesh",
      real_option("mesh", 0.2, 5.0, &request.mesh)->default_value(request.mesh, fmt::format("{}", request.mesh)),
      "size of the true bridge's blocks over the case's")(
      "parapet-gaps", whole_option("parapet-gaps", 0, 1000, &request.parapet_gaps)->default_value(0),
      "movement joints in the parapets, at places drawn by the seed, that the case does not have")(
      "trace",
      "write to answer.toml how much of the effects shows in the modes: their sum of squares in standard "
      "deviations that fitted materials leave")(
      "seed", options::value<std::uint64_t>(&request.seed)->default_value(request.seed), "of all that is random")(
      "output,o", options::value<std::string>(&request.directory)->value_name("DIR"), "where to");
  line.positional = {"CASE"};
  line.required = {"CASE", "output"};
  options::variables_map values;
  if (!line.parse(arguments, values)) return 0;
  request.case_file = values["CASE"].as<std::string>();
  request.trace = values.count("trace") > 0;
  const auto texts = [&](const char* option) { return values.count(option) ? values[option].as<Texts>() : Texts{}; };
  for (const std::string& text : texts("effect")) request.effects.push_back(parse_effect(text));
  for (const std::string& text : texts("loosen")) request.loosenings.push_back(parse_loosening(text));
  for (const std::string& text : texts("truth")) request.truth.push_back(parse_truth(text));
  keep_blocks(request, values);
  write(request, hide(request));
  return 0;
}

}  // namespace

Verb hide_verb() {
  return {"hide", "measurements of a bridge that has what its case lacks: to try diagnose on", hide_run};
}

}  // namespace voussoir
