// The rings of a vault have separated: the joints between them are softer.
#include <fmt/format.h>

#include "geometry/rings.h"
#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

void apply_ring_separation(Assembly& assembly, const std::string& where, const std::vector<double>& values) {
  const RingJoints between(assembly);
  for (Joint& joint : assembly.joints) {
    const std::int32_t vault = assembly.blocks[std::size_t(joint.a)].part;
    if (is_tie(assembly, joint) || !between(joint) || (where != "all" && where != fmt::format("arch {}", vault)))
      continue;
    joint.kn *= values[0], joint.ks *= values[0];
  }
}

std::vector<std::string> places_of_ring_separation(const Assembly& assembly) {
  std::vector<std::string> names;
  const RingJoints between(assembly);
  for (const std::int32_t vault : between.vaults()) names.push_back(fmt::format("arch {}", vault));
  if (names.size() > 1) names.push_back("all");
  return names;
}

}  // namespace

Effect ring_separation() {
  return {
      "ring_separation",
      "the rings of a vault have separated",
      "Tap the vault from below with a hammer: separated rings sound hollow. A core through the rings, or radar from "
      "below, shows the gap.",
      {{"factor", "-", "factor on the stiffness of the joints between the rings", 0.001, 1.0, 1.0, 0.1, 1.0, true}},
      places_of_ring_separation,
      apply_ring_separation,
      nullptr};
}

}  // namespace voussoir
