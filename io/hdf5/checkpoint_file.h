// Checkpoints: the complete state of a run at one time, bit for bit, with checksums and a digest.
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
  std::int64_t stage = 0;   // index into the stages of the case
  double stage_time = 0.0;  // s since the stage began
  std::uint64_t assembly_hash = 0, case_hash = 0;
  std::uint64_t state_hash = 0;           // hash_arrays of the arrays; set by write_checkpoint
  std::string program_version;            // set by write_checkpoint if empty
  std::map<std::string, double> numbers;  // further numbers of the run: time step, energies …; kept bit for bit
  /// One of the numbers. Throws RunError if it is missing.
  double number(const std::string& name) const;
  /// The same for a count. Throws RunError if it is not a whole number of 0 or more.
  std::int64_t count(const std::string& name) const;
};

/// Writes header and arrays atomically; the name of an array is that of its dataset. Returns the state hash. Throws
/// RunError.
std::uint64_t write_checkpoint(const std::string& path, CheckpointHeader header, const std::vector<NamedArray>& arrays);

/// Reads the header alone. Throws InputError if there is no such file, or if it is an HDF5 file that is not a
/// checkpoint or has a newer format. Throws RunError "checkpoint FILE is damaged: …" for every other file that cannot
/// be read.
CheckpointHeader read_checkpoint_header(const std::string& path);

/// Reads the header and the arrays, which are resized to fit. Checksums and digest are verified. After an error the
/// arrays are not valid. Throws as read_checkpoint_header(), and InputError for an older format, too.
void read_checkpoint(const std::string& path, CheckpointHeader& header, const std::vector<NamedArray>& arrays);

/// The file name for a time in s: "00012.500.h5".
std::string checkpoint_name(double time);
/// Paths of all checkpoints in a folder, newest simulated time first; those that cannot be read and have no time in
/// their name come last. Empty if there is no such folder.
std::vector<std::string> list_checkpoints(const std::string& directory);
/// Removes all but the newest `keep` readable checkpoints. It never removes those named stage_*.h5 and unreadable ones,
/// and does not count them in `keep`. Also removes leftovers of interrupted writes. Returns the number of removed
/// files.
int prune_checkpoints(const std::string& directory, int keep = 3);

}  // namespace voussoir
