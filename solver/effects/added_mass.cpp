// Mass on the deck: pavement, ballast, a water main. It moves with the topmost stones between the parapets and the
// elements of a deformable fill that have a face there, in proportion to their volume.
#include <fmt/format.h>

#include <algorithm>

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

double volume_of(const FillMesh& fill, std::size_t tet) {
  const auto at = [&](std::size_t k) { return fill.nodes[std::size_t(fill.tets[tet][k])]; };
  return (at(1) - at(0)).cross(at(2) - at(0)).dot(at(3) - at(0)) / 6.0;
}

/// Tetrahedra with a face on the highest level of the fill.
std::vector<std::size_t> deck_of_fill(const FillMesh& fill) {
  double top = -1e300;
  for (const Vec3& node : fill.nodes) top = std::max(top, node.z());
  std::vector<std::size_t> found;
  for (std::size_t i = 0; i < fill.tets.size(); ++i) {
    const auto high = [&](std::int32_t node) { return fill.nodes[std::size_t(node)].z() > top - 1e-6; };
    if (std::count_if(fill.tets[i].begin(), fill.tets[i].end(), high) >= 3) found.push_back(i);
  }
  return found;
}

void apply_added_mass(Assembly& assembly, const std::string&, const std::vector<double>& values) {
  const BlockSet on_deck = deck(assembly);
  const std::vector<std::size_t> elements = deck_of_fill(assembly.fill);
  double low = 1e300, high = -1e300, volume = 0.0;
  for (const std::size_t tet : elements) {
    volume += volume_of(assembly.fill, tet);
    for (const std::int32_t node : assembly.fill.tets[tet]) {
      const double x = assembly.fill.nodes[std::size_t(node)].x();
      low = std::min(low, x), high = std::max(high, x);
    }
  }
  for (std::size_t i = 0; i < on_deck.size(); ++i) {
    if (!on_deck[i]) continue;
    const Box box = block_box(assembly.blocks[i]);
    low = std::min(low, box.low.x()), high = std::max(high, box.high.x());
    volume += mass_properties(assembly.blocks[i].cells).volume;
  }
  const double density = values[0] * (high - low) / volume;  // kg/m3, to be added
  if (density == 0.0) return;
  std::map<std::int32_t, std::int32_t> loaded;  // materials
  const auto load = [&](std::int32_t& material) {
    const auto [own, fresh] = loaded.try_emplace(material, std::int32_t(assembly.materials.size()));
    if (fresh) {
      Material heavier = assembly.materials[std::size_t(material)];
      heavier.name += fmt::format(" + {:g} kg/m", values[0]);
      heavier.density += density;
      assembly.materials.push_back(heavier);
    }
    material = own->second;
  };
  for (std::size_t i = 0; i < on_deck.size(); ++i)
    if (on_deck[i]) load(assembly.blocks[i].material);
  for (const std::size_t tet : elements) load(assembly.fill.material[tet]);
  finish_blocks(assembly);
}

std::vector<std::string> places_of_added_mass(const Assembly&) {
  return {"deck"};
}

}  // namespace

Effect added_mass() {
  return {"added_mass",
          "the deck carries mass that the model does not include, such as pavement, ballast or a water main",
          "Look for mass on the bridge that the drawings do not show: surfacing, ballast, services. Open the road in "
          "one place.",
          {{"mass_per_length", "kg/m", "added mass per length, over the whole length of the bridge", 0.0, 50000.0, 0.0,
            5000.0, 8000.0}},
          places_of_added_mass,
          apply_added_mass,
          nullptr};
}

}  // namespace voussoir
