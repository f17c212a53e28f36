// voussoir hide.
#include "tools/hide/hide.h"

#include <fmt/format.h>

#include <filesystem>
#include <sstream>

#include "io/case/case.h"
#include "solver/base/atomic_file.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "tools/voussoir/options.h"

namespace voussoir {

namespace {

/// Reads "abutment_restraint both stiffness_share=0.5". The words between the name and the parameters are the place.
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
    double value = 0.0;
    if (parse_number(std::string_view(word).substr(at + 1), value) != NumberTrouble::none)
      throw InputError("--effect \"{}\": {} must have the form PARAMETER=NUMBER", text, word);
    effect.values[word.substr(0, at)] = value;
  }
  complete(effect);
  return effect;
}

/// "key=value".
std::pair<std::string, std::string> parse_truth(const std::string& text) {
  const std::size_t at = text.find('=');
  if (at == std::string::npos || at == 0 || at + 1 == text.size())
    throw InputError("--truth \"{}\" must have the form KEY=VALUE, such as backfill=deformable or width=7.3", text);
  return {text.substr(0, at), text.substr(at + 1)};
}

/// Refuses options that change blocks or dimensions if the case has no generator. Their defaults then have no effect.
void keep_blocks(HideRequest& request, const options::variables_map& values) {
  if (!read_case(request.case_file, CaseUse::geometry).generator.empty()) return;
  for (const char* option : {"mesh", "defects"})
    if (!values[option].defaulted())
      throw InputError("--{}: {} is made from an assembly file, whose blocks cannot change. Leave the option out",
                       option, request.case_file);
  request.mesh = 1.0, request.defects = 0.0;
}

void write(const HideRequest& request, const HiddenBridge& hidden) {
  std::filesystem::create_directories(request.directory);
  write_measured(hidden.measured, request.directory + "/measured");
  write_atomically(request.directory + "/answer.toml", hidden.answer);
  fmt::print("{} at {} in {}/measured; what was hidden is in {}/answer.toml\n",
             request.shaken > 0.0    ? fmt::format("{:g} s of an earthquake", request.shaken)
             : request.minutes > 0.0 ? fmt::format("{:g} min of ambient vibration", request.minutes)
                                     : counted(hidden.measured.modes.size(), "mode"),
             counted(hidden.measured.sensors.size(), "sensor"), request.directory, request.directory);
}

int hide_run(const std::vector<std::string>& arguments) {
  CommandLine line("hide", "hide CASE --effect \"NAME PLACE PARAMETER=VALUE\" -o DIR",
                   "voussoir hide cases/cs1-f.toml --effect \"abutment_restraint both\" --seed 7 -o hidden");
  HideRequest request;
  using Texts = std::vector<std::string>;
  line.described.add_options()("effect", options::value<Texts>()->composing(),
                               "effect that the case lacks; may be repeated; none: no effect")(
      "loosen", options::value<Texts>()->composing(),
      "change that the case lacks and that is no effect of the library, such as \"x=12..14 z=9.. part=arch 1 "
      "factor=0.05\": in this box (m), factor= multiplies the stiffness of the joints, and density= the mass of the "
      "blocks; may be repeated")(
      "truth", options::value<Texts>()->composing(),
      "KEY=VALUE: a key of the generator that differs in the true bridge, such as backfill=deformable; may "
      "be repeated")("sensors", options::value<std::string>(&request.sensors)->default_value(request.sensors),
                     "plan of the sensors: sparse, rich, none (periods alone), a number of channels from 5 "
                     "to 40 drawn by the seed, or a file in the format of sensors.csv")(
      "modes", whole_option("modes", 1, 1000, &request.modes)->default_value(6),
      "number of measured modes: the lowest that are not local")(
      "minutes", real_option("minutes", 0.0, 600.0, &request.minutes)->default_value(0.0),
      "minutes of ambient vibration instead of modes; the noise of its channels is five times --noise")(
      "shaken", real_option("shaken", 0.0, 3600.0, &request.shaken)->default_value(0.0),
      "seconds of a synthetic earthquake instead of modes, recorded on the ground too; noise as with --minutes")(
      "noise",
      real_option("noise", 0.0, 0.999, &request.noise)->default_value(request.noise, fmt::format("{}", request.noise)),
      "standard deviation of the periods, as a share; that of the shapes is twice as large")(
      "noise-said", real_option("noise-said", 0.01, 100.0, &request.noise_said)->default_value(1.0),
      "ratio of the stated standard deviations to the true ones; 0.5 understates them by half")(
      "scatter",
      real_option("scatter", 0.0, 0.999, &request.scatter)
          ->default_value(request.scatter, fmt::format("{}", request.scatter)),
      "scatter of the stiffness of each part of the masonry, standard deviation of the logarithm")(
      "materials",
      real_option("materials", 0.0, 0.999, &request.materials)
          ->default_value(request.materials, fmt::format("{}", request.materials)),
      "scatter of the stiffness of each material, standard deviation of the logarithm")(
      "defects",
      real_option("defects", 0.0, 0.999, &request.defects)
          ->default_value(request.defects, fmt::format("{}", request.defects)),
      "standard deviation of every dimension, m")(
      "mesh",
      real_option("mesh", 0.2, 5.0, &request.mesh)->default_value(request.mesh, fmt::format("{}", request.mesh)),
      "ratio of the block sizes of the true bridge to those of the case")(
      "parapet-gaps", whole_option("parapet-gaps", 0, 1000, &request.parapet_gaps)->default_value(0),
      "number of movement joints in the parapets that the case lacks, at random places")(
      "trace",
      "write to answer.toml how clearly the effects show in the modes: the sum of the squared residuals, in standard "
      "deviations, that remains after the materials have been fitted")(
      "seed", options::value<std::uint64_t>(&request.seed)->default_value(request.seed), "seed of all random numbers")(
      "output,o", options::value<std::string>(&request.directory)->value_name("DIR"), "folder to write to");
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
  return {"hide", "make synthetic measurements of a bridge with an effect that its case lacks, to test diagnose",
          hide_run};
}

}  // namespace voussoir
