// The contact between the backfill and the masonry around it is lost, or stiffer than assumed.
#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

void apply_fill_interface(Assembly& assembly, const std::string& where, const std::vector<double>& values) {
  const BlockSet masonry = masonry_part(assembly, where);
  scale_between(assembly, component(assembly, Component::backfill), masonry, values[0]);
  scale_patches(assembly, masonry, values[0]);
}

std::vector<std::string> places_of_fill_interface(const Assembly& assembly) {
  std::vector<std::string> names = all_if_filled(assembly);
  if (!names.empty() && !all_if_any(assembly, Component::spandrel).empty()) names.push_back("spandrels");
  return names;
}

}  // namespace

Effect fill_interface() {
  return {"fill_interface",
          "the contact between backfill and masonry is lost, or stiffer than assumed",
          "Look for gaps between the fill and the masonry: from the road along the walls, and at places where water "
          "comes out of the vaults.",
          {{"factor", "-", "factor on the stiffness of these joints", 0.01, 10.0, 1.0, 0.3, 0.8, true}},
          places_of_fill_interface,
          apply_fill_interface,
          nullptr};
}

}  // namespace voussoir
