// Better masonry than thought: the joints inside a part are stiffer.
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

Effect stiffer_masonry() {
  return {"stiffer_masonry",
          "the masonry of a part is stiffer than thought",
          {{"factor", "-", "on the stiffness of its joints", 1.0, 5.0, 1.0, 1.5, 0.3, true}},
          masonry_parts,
          apply,
          nullptr};
}

}  // namespace voussoir
