// Modes files: frequencies, masses and shapes of an eigenvalue analysis in HDF5, with a public layout
// (docs/formats.md).
#pragma once
#include "solver/modal/damped_mode.h"
#include "solver/modal/modes.h"

namespace voussoir {

struct ModesFile {
  std::string about;  // what was analysed, in words: "cs1-r.toml, intact joints"
  std::uint64_t assembly_hash = 0;
  double mass = 0.0;  // kg, of all movable blocks and of the fill
  BlockPlaces places;
  std::vector<Vec3> nodes;  // m, of the mesh of the fill in the assembly as built; empty: no fill
  std::vector<Mode> modes;
  std::vector<DampedMode> damped;  // of each mode; empty: no damping
};

/// Writes atomically. Every mode must have as many nodes as the file. Throws RunError.
void write_modes(const std::string& path, const ModesFile& file);
/// Files of older formats, without nodes, are read as files without a fill. Throws InputError with file and dataset if
/// it is not a modes file, has a newer format or is damaged.
ModesFile read_modes(const std::string& path);

}  // namespace voussoir
