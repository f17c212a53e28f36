// How much of the bond of each part of a structure is lost.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "solver/model/state.h"

namespace voussoir {

/// What a joint is between: "arch" where both stones are of that component, else "arch-spandrel", in the order of the
/// enumeration. The bond between a leaf and its infill is not that of the leaf.
std::string joint_family(Component a, Component b);

/// Families with joints that began with tensile strength or cohesion, in the order of the enumeration; those within a
/// component first.
std::vector<std::string> bonded_families(const Assembly& assembly);

/// How much of the bond of each family of joints is lost.
class LostBonds {
 public:
  LostBonds(const Assembly& assembly, const Model& model);
  /// Looks at the joints of one tile of bodies as they are now. Tiles may be counted by several threads at once.
  void count(const Model& model, const State& state, std::size_t tile);
  /// Share of the area that began with a bond, 0 to 1, of each of bonded_families(), once all tiles are counted.
  /// Summed tile after tile in the state's order: the same bits for any number of threads, and after a restart.
  std::vector<double> shares() const;

 private:
  struct Bond {
    double area = 0.0;   // m2; 0: none
    std::size_t of = 0;  // its family's number among bonded_families()
  };
  std::vector<Bond> bonds_;                // of Assembly::joints
  std::vector<double> bonded_;             // m2, of each family
  std::vector<std::vector<double>> lost_;  // m2, the same of each tile
};

}  // namespace voussoir
