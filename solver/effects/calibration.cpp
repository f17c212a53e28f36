// Uncertain properties of every model: stiffness and density of masonry, infill and backfill. A diagnosis fits them
// before it searches for missing effects, and writes them to the case as this effect.
#include <algorithm>

#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

/// A joint belongs to the weaker of its two materials.
enum class Kind { none, masonry, infill, fill };
const char* const kind_names[] = {"none", "masonry", "infill", "backfill"};

Kind kind_of(const Block& block) {
  switch (block.component) {
    case Component::base:
    case Component::restraint:
      return Kind::none;
    case Component::backfill:
      return Kind::fill;
    case Component::infill:
      return Kind::infill;
    default:
      return Kind::masonry;
  }
}

void apply_calibration(Assembly& assembly, const std::string& where, const std::vector<double>& values) {
  const auto kind = Kind(std::find(std::begin(kind_names), std::end(kind_names), where) - std::begin(kind_names));
  for (Joint& joint : assembly.joints) {
    const Kind a = kind_of(assembly.blocks[std::size_t(joint.a)]), b = kind_of(assembly.blocks[std::size_t(joint.b)]);
    if (std::max(a, b) != kind || is_tie(assembly, joint)) continue;
    joint.kn *= values[0];
    joint.ks *= values[0];
  }
  scale_density(assembly, blocks_where(assembly, [&](const Block& b) { return kind_of(b) == kind; }), values[1]);
  if (kind != Kind::fill || assembly.fill.empty()) return;
  scale_fill(assembly, values[0], values[1]);
  scale_patches(assembly, BlockSet(assembly.blocks.size(), true), values[0]);
}

std::vector<std::string> places_of_calibration(const Assembly& assembly) {
  std::vector<std::string> names;
  for (Kind kind : {Kind::masonry, Kind::infill, Kind::fill})
    if ((kind == Kind::fill && !assembly.fill.empty()) ||
        std::any_of(assembly.blocks.begin(), assembly.blocks.end(),
                    [&](const Block& b) { return !b.fixed && kind_of(b) == kind; }))
      names.push_back(kind_names[std::size_t(kind)]);
  return names;
}

}  // namespace

Effect calibration() {
  return {"calibration",
          "factors on the uncertain properties of a material (not a missing effect)",
          "",
          {{"stiffness", "-", "factor on the stiffness of its joints", 0.2, 5.0, 1.0, 1.0, 0.25, true},
           {"density", "-", "factor on its density", 0.5, 2.0, 1.0, 1.0, 0.05, true}},
          places_of_calibration,
          apply_calibration,
          nullptr,
          nullptr,
          0.0};
}

}  // namespace voussoir
