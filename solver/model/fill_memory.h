// Variables of the fill: part of the state (solver/model/state.h), in the order of FillModel.
#pragma once
#include "solver/model/fill_model.h"

namespace voussoir {

/// Bits of FillMemory::yield.
enum TetYield : std::uint8_t {
  yields_in_shear = 1,
  yields_in_tension = 2,
  has_yielded_in_shear = 4,
  has_yielded_in_tension = 8,
  built_deformed = 16  // its nodes had moved before it was added: its plastic memory is its shape at that time
};

constexpr int plastic_width = 8, strain_rows = 7;
constexpr int row_volume = 6, row_shear = 7;  // of FillMemory::plastic

struct FillMemory {
  Array<double> pose;     // 4 per node: displacement (m), mean elastic volumetric strain about it at the last pass
  Array<double> motion;   // 4 per node: velocity at the last half step (m/s); the fourth is not used
  Array<float> searched;  // 4 per node: displacement relative to the base at the last search for patches about it (m);
                          // the fourth is not used
  Array<double> plastic;  // 8 rows of lanes per batch: Cp⁻¹ − 1 (xx yy zz xy xz yz), volumetric strain by dilation and
                          // tension, accumulated plastic shear strain
  Array<float> last;    // 7 rows of lanes per batch: elastic strain at the last pass, material axes, with the mean
                        // volumetric strain; then the tetrahedron's own
  Array<float> branch;  // 6 rows of lanes per batch and branch: q
  Array<std::uint8_t> yield;  // of each lane, TetYield bits
  Array<double> lost;  // 4 per tile, J: dissipated by plastic flow; work done on branches; work of held nodes and
                       // loads; dissipated by damping of nodes
};

/// At rest in the reference placement.
FillMemory initial_fill(const FillModel& fill);
/// Gives every tetrahedron memory for `count` branches. If the number is unchanged the values are kept, else they start
/// at zero.
void set_fill_branches(const FillModel& fill, FillMemory& memory, int count);

/// First of the eight lanes of number c of a batch's plastic memory.
inline std::size_t plastic_index(std::size_t batch, int c) {
  return lane_count * (plastic_width * batch + std::size_t(c));
}

}  // namespace voussoir
