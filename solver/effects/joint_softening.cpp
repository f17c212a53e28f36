// Cracked or decayed masonry: the joints inside a part are softer.
#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

void apply(Assembly& assembly, const std::string& where, const std::vector<double>& values) {
  const BlockSet part = masonry_part(assembly, where);
  scale_joints(assembly, values[0],
               [&](std::int64_t a, std::int64_t b) { return part[std::size_t(a)] && part[std::size_t(b)]; });
}

}  // namespace

Effect joint_softening() {
  return {"joint_softening",
          "the masonry of a part is cracked or decayed",
          {{"factor", "-", "on the stiffness of its joints", 0.02, 1.0, 1.0, 0.5, 0.5, true}},
          masonry_parts,
          apply,
          nullptr};
}

}  // namespace voussoir
