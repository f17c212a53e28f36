// Describes files in words, for `voussoir info`.
#pragma once
#include <string>

namespace voussoir {

/// Describes a run directory, a case (.toml), an assembly, checkpoint, history or modes file (HDF5), or a motion record
/// (text columns): what it is, counts, masses, sizes, time range, peaks, with units. Several lines without a newline
/// at the end. Throws InputError if the file cannot be read or is of another kind.
std::string describe_file(const std::string& path);

}  // namespace voussoir
