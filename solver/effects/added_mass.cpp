// Mass on the deck: pavement, ballast, a water main. It moves with the topmost stones between the parapets, in
// proportion to their volume.
#include <fmt/format.h>

#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

/// Free stones other than parapets that reach the highest level of any such stone.
BlockSet deck(const Assembly& assembly) {
  const auto counts = [](const Block& b) { return !b.fixed && b.component != Component::parapet; };
  double top = -1e300;
  for (const Block& b : assembly.blocks)
    if (counts(b)) top = std::max(top, block_box(b).high.z());
  return blocks_where(assembly, [&](const Block& b) { return counts(b) && block_box(b).high.z() > top - 1e-6; });
}

void apply(Assembly& assembly, const std::string&, const std::vector<double>& values) {
  const BlockSet on_deck = deck(assembly);
  double low = 1e300, high = -1e300, volume = 0.0;
  for (std::size_t i = 0; i < on_deck.size(); ++i) {
    if (!on_deck[i]) continue;
    const Box box = block_box(assembly.blocks[i]);
    low = std::min(low, box.low.x()), high = std::max(high, box.high.x());
    volume += mass_properties(assembly.blocks[i].cells).volume;
  }
  const double density = values[0] * (high - low) / volume;  // kg/m3, to be added
  if (density == 0.0) return;
  std::map<std::int32_t, std::int32_t> loaded;  // materials
  for (std::size_t i = 0; i < on_deck.size(); ++i) {
    if (!on_deck[i]) continue;
    Block& block = assembly.blocks[i];
    if (!loaded.contains(block.material)) {
      Material heavier = assembly.materials[std::size_t(block.material)];
      heavier.name += fmt::format(" + {:g} kg/m", values[0]);
      heavier.density += density;
      loaded[block.material] = std::int32_t(assembly.materials.size());
      assembly.materials.push_back(heavier);
    }
    block.material = loaded[block.material];
  }
  finish_blocks(assembly);
}

std::vector<std::string> places(const Assembly&) {
  return {"deck"};
}

}  // namespace

Effect added_mass() {
  return {"added_mass",
          "mass on the deck that the model does not have: pavement, ballast, a water main",
          {{"mass_per_length", "kg/m", "over the whole length", 0.0, 50000.0, 0.0, 5000.0, 8000.0}},
          places,
          apply,
          nullptr};
}

}  // namespace voussoir
