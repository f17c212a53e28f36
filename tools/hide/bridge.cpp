#include "tools/hide/bridge.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <map>

#include "geometry/generator.h"
#include "solver/base/csv.h"
#include "solver/base/error.h"
#include "solver/base/suggestion.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

void set_key(Case& c, const std::string& key, const std::string& word) {
  const Generator& generator = find_generator(c.generator);
  if (key == "block_scale")
    throw InputError(
        "--truth block_scale={}: block_scale cannot be set here. Use --mesh, the block size of the true bridge "
        "relative to that of the case",
        word);
  std::vector<std::string> known;
  const Keys keys = keys_of(generator, c.generator_input);
  for (const Parameter& p : keys.parameters) known.push_back(p.name);
  for (const Choice& choice : keys.choices) known.push_back(choice.name);
  if (std::find(known.begin(), known.end(), key) == known.end())
    throw InputError("--truth {}={}: generator \"{}\" has no key '{}'{}", key, word, c.generator, key,
                     suggestion(key, known));
  if (c.generator_input.choices.contains(key)) {
    c.generator_input.choices[key] = word;
  } else if (parse_number(word, c.generator_input.values[key]) != NumberTrouble::none) {
    throw InputError("--truth {}={}: the value must be a number. `voussoir generate --keys {}` lists the keys", key,
                     word, c.generator);
  }
}

/// The case with the values of --truth.
Case as_it_is(const Case& model, const HideRequest& request) {
  Case c = model;
  for (const auto& [key, word] : request.truth) set_key(c, key, word);
  check_input(find_generator(c.generator), c.generator_input);
  return c;
}

/// The bridge with other dimensions and block sizes. Impossible combinations of dimensions are drawn again.
Assembly surveyed_wrongly(const Case& model, const HideRequest& request) {
  const Case truth = as_it_is(model, request);
  for (int tries = 0;; ++tries) {
    Case c = truth;
    // Two dimensions with the same value are one dimension of the bridge. Backing that reaches the end then still does
    // so, instead of ending a centimetre before it with a slot of fill.
    std::map<double, double> errors;
    for (const Parameter& p : keys_of(find_generator(c.generator), c.generator_input).parameters) {
      double& value = c.generator_input.values.at(p.name);
      if (p.name == "block_scale") value = std::clamp(value * request.mesh, p.low, p.high);
      if (!is_dimension(p) || value <= 0.0) continue;
      const auto [error, first] = errors.try_emplace(value, 0.0);
      if (first) error->second = request.defects * stream_of(request, "dimension " + p.name, tries).normal();
      value = std::clamp(value + error->second, p.low, p.high);
    }
    try {
      return make_assembly(c);
    } catch (const InputError&) {
      if (tries == 100) throw;
    }
  }
}

void set_stiffness(Assembly& assembly, const HideRequest& request) {
  const Effect calibration = find_effect("calibration");
  for (const std::string& where : calibration.places(assembly)) {
    RandomStream random = stream_of(request, "material " + where);
    const double stiffness = std::exp(request.materials * random.normal()), density = std::exp(0.02 * random.normal());
    apply_effect(assembly, {"calibration", where, {{"stiffness", stiffness}, {"density", density}}});
  }
  for (const std::string& part : masonry_parts(assembly))
    if (part != "all" && !part.ends_with("s"))
      scale_inside(assembly, masonry_part(assembly, part),
                   std::exp(request.scatter * stream_of(request, "part " + part).normal()));
}

}  // namespace

Assembly hidden_bridge(const Case& model, const HideRequest& request) {
  if (model.generator.empty() && !request.truth.empty())
    throw InputError("{} is made from an assembly file, which has no keys. --truth needs a case with a generator",
                     model.path);
  Assembly assembly = model.generator.empty() ? make_assembly(model) : surveyed_wrongly(model, request);
  set_stiffness(assembly, request);
  return assembly;
}

}  // namespace voussoir
