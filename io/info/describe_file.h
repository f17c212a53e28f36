// What a file holds, in words: the answer of `voussoir info`.
#pragma once
#include <string>

namespace voussoir {

/// Describes a run directory, a case (.toml), an assembly, checkpoint, history or modes file (HDF5), or a motion record
/// (text columns): what it is, counts, masses, sizes, time range, peaks, with units. Several lines, no trailing
/// newline. Throws InputError when the file cannot be read or is none of these.
std::string describe_file(const std::string& path);

}  // namespace voussoir
