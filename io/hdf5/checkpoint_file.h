// Checkpoints: the whole state of a run at one instant, with checksums and a digest, bit for bit.
#pragma once
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "solver/base/arrays.h"

namespace voussoir {

struct CheckpointHeader {
  double time = 0.0;  // s since the start of the run
  std::int64_t step = 0;
  std::int64_t stage = 0;   // index into the case's stages
  double stage_time = 0.0;  // s since the stage began
  std::uint64_t assembly_hash = 0, case_hash = 0;
  std::uint64_t state_hash = 0;           // hash_arrays of the arrays; set by write_checkpoint
  std::string program_version;            // set by write_checkpoint when empty
  std::map<std::string, double> numbers;  // what else the run needs: time step, energies …; kept bit for bit
  /// One of them. Throws RunError when it is not there.
  double number(const std::string& name) const;
  /// The same where it counts something. Throws RunError when it is not a whole number from 0 on.
  std::int64_t count(const std::string& name) const;
};

/// Writes header and arrays atomically; an array's name is its dataset. Returns the state hash. Throws RunError.
std::uint64_t write_checkpoint(const std::string& path, CheckpointHeader header, const std::vector<NamedArray>& arrays);

/// Reads the header alone. Throws InputError when the file is no checkpoint or of a newer format, RunError
/// "checkpoint FILE is damaged (…)" when it cannot be read.
CheckpointHeader read_checkpoint_header(const std::string& path);

/// Reads the header and the arrays, which are resized to fit. Checksums and digest are verified; on any error nothing
/// should be believed of what was read so far. Throws as read_checkpoint_header.
void read_checkpoint(const std::string& path, CheckpointHeader& header, const std::vector<NamedArray>& arrays);

/// The file name for a time in s: "00012.500.h5".
std::string checkpoint_name(double time);
/// Paths of all checkpoints in a folder, newest simulated time first; those that cannot be read and have no time in
/// their name come last. Empty when there is no such folder.
std::vector<std::string> list_checkpoints(const std::string& directory);
/// Removes all but the newest `keep` readable checkpoints, never those named stage_*.h5 and never unreadable ones (they
/// do not count, so that three good ones stay), and leftovers of writes that were cut off. Returns how many files it
/// removed.
int prune_checkpoints(const std::string& directory, int keep = 3);

}  // namespace voussoir
