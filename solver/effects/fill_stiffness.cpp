// The backfill itself is softer or stiffer than thought.
#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

void apply(Assembly& assembly, const std::string&, const std::vector<double>& values) {
  const BlockSet fill = component(assembly, Component::backfill);
  scale_joints(assembly, values[0],
               [&](std::int64_t a, std::int64_t b) { return fill[std::size_t(a)] && fill[std::size_t(b)]; });
}

std::vector<std::string> places(const Assembly& assembly) {
  const BlockSet fill = component(assembly, Component::backfill);
  for (bool one : fill)
    if (one) return {"all"};
  return {};
}

}  // namespace

Effect fill_stiffness() {
  return {"fill_stiffness",
          "the backfill is softer or stiffer than thought",
          {{"factor", "-", "on the stiffness of its joints", 0.05, 20.0, 1.0, 1.0, 0.7, true}},
          places,
          apply,
          nullptr};
}

}  // namespace voussoir
