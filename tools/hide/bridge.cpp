#include "tools/hide/bridge.h"

#include <cmath>
#include <map>

#include "geometry/generator.h"
#include "solver/base/error.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

/// The case with other dimensions and other blocks. Dimensions that cannot be together are drawn again.
Assembly surveyed_wrongly(const Case& model, const HideRequest& request, Noise& noise) {
  for (int tries = 0;; ++tries) {
    Case c = model;
    // Two dimensions that are the same number are one on the bridge: backing that reaches the end still does, instead
    // of ending a centimetre short of it behind a slot of fill.
    std::map<double, double> errors;
    for (const Parameter& p : find_generator(c.generator).parameters) {
      double& value = c.generator_input.values.at(p.name);
      if (p.name == "block_scale") value = std::clamp(value * request.mesh, p.low, p.high);
      if (!is_dimension(p) || value <= 0.0) continue;
      const auto [error, first] = errors.try_emplace(value, 0.0);
      if (first) error->second = request.defects * noise.normal();
      value = std::clamp(value + error->second, p.low, p.high);
    }
    try {
      return make_assembly(c);
    } catch (const InputError&) {
      if (tries == 100) throw;
    }
  }
}

}  // namespace

Assembly hidden_bridge(const Case& model, const HideRequest& request, Noise& noise) {
  if (model.generator.empty()) throw InputError("{} is made from an assembly file; hide needs a generator", model.path);
  Assembly assembly = surveyed_wrongly(model, request, noise);
  const Effect calibration = find_effect("calibration");
  for (const std::string& where : calibration.places(assembly))
    apply_effect(assembly, {"calibration",
                            where,
                            {{"stiffness", std::exp(request.materials * noise.normal())},
                             {"density", std::exp(0.02 * noise.normal())}}});
  for (const std::string& part : masonry_parts(assembly))
    if (part != "all" && !part.ends_with("s"))
      scale_inside(assembly, masonry_part(assembly, part), std::exp(request.scatter * noise.normal()));
  return assembly;
}

}  // namespace voussoir
