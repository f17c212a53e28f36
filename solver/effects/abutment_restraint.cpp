// The ground behind an abutment: a fixed block over the whole end face, from the base to the deck, whose joints have a
// share of the stiffness of the adjacent material in all three directions (50 % in "From Monitoring to Modeling",
// calibrated on monitoring; docs/case-studies.md).
#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

void apply_abutment_restraint(Assembly& assembly, const std::string& where, const std::vector<double>& values) {
  if (values[0] == 0.0) return;
  for (bool left : {true, false}) {
    if (!acts_at(where, left)) continue;
    const std::vector<EndFace> faces = end_faces(assembly, left);
    Box box = box_of(faces);
    (left ? box.low : box.high).x() += left ? -1.0 : 1.0;
    const std::int64_t block = add_box_block(assembly, box.low, box.high, Component::restraint, 0, true);
    assembly.groups[left ? "restraint left" : "restraint right"] = {block};
    join_end(assembly, faces, block, values[0]);
  }
}

}  // namespace

Effect abutment_restraint() {
  return {
      "abutment_restraint",
      "the ground behind an abutment holds its end face",
      "Inspect the joint between the abutment and the ground or structure behind it. Check whether it is open or "
      "filled, and how firm the ground behind the end wall is.",
      {{"stiffness_share", "-", "stiffness of the restraint as a share of the joint stiffness of the adjacent material",
        0.0, 2.0, 0.0, 0.5, 0.3}},
      free_ends,
      apply_abutment_restraint,
      nullptr};
}

}  // namespace voussoir
