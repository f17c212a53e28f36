// Lost share of the bond of each part of a structure.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "solver/model/state.h"

namespace voussoir {

/// Name of the joints between two components: "arch" if both stones belong to that component, else "arch-spandrel", in
/// the order of the enumeration. The joints between a leaf and its infill form a separate family.
std::string joint_family(Component a, Component b);

/// Families with joints that began with a bond (tensile strength or cohesion, or an elastic law), in the order of the
/// enumeration; those within a component first.
std::vector<std::string> bonded_families(const Assembly& assembly);

/// Lost share of the bond of each family of joints.
class LostBonds {
 public:
  LostBonds(const Assembly& assembly, const Model& model);
  /// Counts the joints of one tile of bodies in their present state. Several threads may count tiles at the same time.
  void count(const Model& model, const State& state, std::size_t tile);
  /// Lost share of the initially bonded area, 0 to 1, for each of bonded_families(). Call it when all tiles are
  /// counted. The sum runs over tiles in the order of the state: the bits are the same for any number of threads and
  /// after a restart.
  std::vector<double> shares() const;

 private:
  struct Bond {
    double area = 0.0;   // m2; 0: none
    std::size_t of = 0;  // index of its family in bonded_families()
  };
  std::vector<Bond> bonds_;                // of Assembly::joints
  std::vector<double> bonded_;             // m2, of each family
  std::vector<std::vector<double>> lost_;  // m2, the same of each tile
};

}  // namespace voussoir
