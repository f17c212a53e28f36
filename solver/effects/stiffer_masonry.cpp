// The masonry is stiffer than assumed: the joints inside a part are stiffer.
#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

Effect stiffer_masonry() {
  return {"stiffer_masonry",
          "the masonry of a part is stiffer than assumed",
          "Take a core of that part, or measure the speed of sound through it. It may be of another masonry, or backed "
          "by concrete.",
          {{"factor", "-", "factor on the stiffness of its joints", 1.0, 5.0, 1.0, 1.5, 0.3, true}},
          masonry_parts,
          scale_masonry_part,
          nullptr};
}

}  // namespace voussoir
