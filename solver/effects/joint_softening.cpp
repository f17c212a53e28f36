// Cracked or decayed masonry: the joints inside a part are softer.
#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

Effect joint_softening() {
  return {
      "joint_softening",
      "the masonry of a part is cracked or decayed",
      "Inspect that part for cracks, open joints, water and decay. Sound it with a hammer, and take a core through it.",
      {{"factor", "-", "factor on the stiffness of its joints", 0.02, 1.0, 1.0, 0.5, 0.5, true}},
      masonry_parts,
      scale_masonry_part,
      nullptr};
}

}  // namespace voussoir
