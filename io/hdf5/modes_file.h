// Modes files: frequencies, masses and shapes of an eigenvalue analysis in HDF5, a public layout (docs/formats.md).
#pragma once
#include "solver/modal/damped_mode.h"
#include "solver/modal/modes.h"

namespace voussoir {

struct ModesFile {
  std::string about;  // what was analysed, for people: "cs1-r.toml, intact joints"
  std::uint64_t assembly_hash = 0;
  double mass = 0.0;  // kg, of all blocks that can move
  BlockPlaces places;
  std::vector<Mode> modes;
  std::vector<DampedMode> damped;  // of each mode; empty when there is no damping
};

/// Writes atomically. Throws RunError.
void write_modes(const std::string& path, const ModesFile& file);
/// Throws InputError naming file and dataset when it is no modes file, of a newer format, or damaged.
ModesFile read_modes(const std::string& path);

}  // namespace voussoir
