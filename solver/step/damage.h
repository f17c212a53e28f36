// How much of the bond of each part of a structure is lost.
#pragma once
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/assembly.h"
#include "solver/model/state.h"

namespace voussoir {

/// Whether a joint of this law begins with a bond that it can lose; elastic ones count, though they never do.
bool has_bond(const LawConstants& law);

/// Components with joints that began with tensile strength or cohesion, in the order of the enumeration.
std::vector<Component> bonded_components(const Assembly& assembly);

/// How much of the bond of each component is lost. A joint counts for the components on both its sides.
class LostBonds {
 public:
  LostBonds(const Assembly& assembly, const Model& model);
  /// Looks at the joints of one tile of bodies as they are now. Tiles may be counted by several threads at once.
  void count(const Model& model, const State& state, std::size_t tile);
  /// Share of the area that began with a bond, 0 to 1, of each of bonded_components(), once all tiles are counted.
  /// Summed tile after tile in the state's order: the same bits for any number of threads, and after a restart.
  std::vector<double> shares() const;

 private:
  struct Bond {
    double area = 0.0;               // m2; 0: none
    std::array<std::uint8_t, 2> of;  // numbers among bonded_components(), of both sides
  };
  std::vector<Bond> bonds_;                // of Assembly::joints
  std::vector<double> bonded_;             // m2, of each component
  std::vector<std::vector<double>> lost_;  // m2, the same of each tile
};

}  // namespace voussoir
