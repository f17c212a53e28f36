// Modes files: frequencies, masses and shapes of an eigenvalue analysis in HDF5, a public layout (docs/formats.md).
#pragma once
#include "solver/modal/damped_mode.h"
#include "solver/modal/modes.h"

namespace voussoir {

struct ModesFile {
  std::string about;  // what was analysed, for people: "cs1-r.toml, intact joints"
  std::uint64_t assembly_hash = 0;
  double mass = 0.0;  // kg, of all blocks that can move, and of the fill
  BlockPlaces places;
  std::vector<Vec3> nodes;  // m, of the fill's mesh in the assembly as built; empty when there is none
  std::vector<Mode> modes;
  std::vector<DampedMode> damped;  // of each mode; empty when there is no damping
};

/// Writes atomically. Throws RunError. Every mode moves as many nodes as there are.
void write_modes(const std::string& path, const ModesFile& file);
/// Files of before a mode moved nodes read as without a fill. Throws InputError naming file and dataset when it is no
/// modes file, of a newer format, or damaged.
ModesFile read_modes(const std::string& path);

}  // namespace voussoir
