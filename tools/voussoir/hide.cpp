// voussoir hide.
#include "tools/hide/hide.h"

#include <fmt/format.h>

#include <filesystem>
#include <sstream>

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
  line.described.add_options()("effect", options::value<std::vector<std::string>>()->composing(),
                               "what the case lacks; may be repeated; none: nothing")(
      "sensors", options::value<std::string>(&request.sensors)->default_value(request.sensors),
      "sparse, rich or none (periods alone)")("modes", whole_option("modes", 1, 1000, &request.modes)->default_value(6),
                                              "that are measured")(
      "minutes", real_option("minutes", 0.0, 600.0, &request.minutes)->default_value(0.0),
      "of ambient vibration instead of modes; the noise of its channels is five times --noise")(
      "shaken", real_option("shaken", 0.0, 3600.0, &request.shaken)->default_value(0.0),
      "s of a synthetic earthquake, recorded on the ground too, instead of modes; noise as with --minutes")(
      "noise",
      real_option("noise", 0.0, 0.999, &request.noise)->default_value(request.noise, fmt::format("{}", request.noise)),
      "standard deviation of periods, share; of shapes twice that")(
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
  if (values.count("effect"))
    for (const std::string& text : values["effect"].as<std::vector<std::string>>())
      request.effects.push_back(parse_effect(text));
  write(request, hide(request));
  return 0;
}

}  // namespace

Verb hide_verb() {
  return {"hide", "measurements of a bridge that has what its case lacks: to try diagnose on", hide_run};
}

}  // namespace voussoir
