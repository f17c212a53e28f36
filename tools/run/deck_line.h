// Settlement of the road along a bridge.
#pragma once
#include "geometry/road.h"
#include "solver/model/state.h"

namespace voussoir {

/// Stations along the middle of the road. A run with quasi-static stages records their settlement.
class DeckLine {
 public:
  DeckLine() = default;
  explicit DeckLine(const Assembly& assembly);                       // no stations if there is no road
  const std::vector<double>& stations() const { return stations_; }  // m, x
  static std::string channel(double station);                        // "deck/12.500"
  /// Vertical displacements of the stations (m, upwards positive) since the blocks were built, relative to the ground.
  /// They are means over a narrow strip of the road, weighted by area.
  std::vector<double> displacements(const Model& model, const State& state) const;

 private:
  std::vector<double> stations_;
  std::vector<RoadShare> shares_;
};

}  // namespace voussoir
