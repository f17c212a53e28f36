#include "tools/run/deck_line.h"

#include <fmt/format.h>

#include <optional>

#include "solver/base/error.h"
#include "solver/step/make_snapshot.h"

namespace voussoir {

DeckLine::DeckLine(const Assembly& assembly) {
  constexpr int parts = 40;
  std::optional<Road> road;
  try {
    road.emplace(assembly);
  } catch (const InputError&) {
    return;
  }
  const RoadArea all = road->extent();
  const double length = (all.x1 - all.x0) / parts, middle = 0.5 * (all.y0 + all.y1), half = 0.1 * (all.y1 - all.y0);
  for (int i = 0; i < parts; ++i) {
    const double x = all.x0 + (i + 0.5) * length;
    RoadShare share = road->under({x - 0.25 * length, x + 0.25 * length, middle - half, middle + half});
    if (share.area <= 0.0) continue;
    stations_.push_back(x);
    shares_.push_back(std::move(share));
  }
}

std::string DeckLine::channel(double station) {
  return fmt::format("deck/{:.3f}", station);
}

std::vector<double> DeckLine::displacements(const Model& model, const State& state) const {
  std::vector<double> all;
  for (const RoadShare& share : shares_) {
    double sum = 0.0;
    for (const RoadShare::OfBlock& of : share.blocks)
      sum += of.area * displacement_since_built(model, state, of.block, of.centre).z();
    for (const RoadShare::OfNode& of : share.nodes) {
      const auto node = std::size_t(model.fill.node_of[std::size_t(of.node)]);
      sum += of.area * (state.fill.pose[node_width * node + 2] - state.base_displacement().z());
    }
    all.push_back(sum / share.area);
  }
  return all;
}

}  // namespace voussoir
