// Files that are either complete or absent: written under a temporary name, synced and renamed.
#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <string>

namespace voussoir {

/// Calls `write` with a temporary name beside `path`, syncs what it wrote to the disk and renames it to `path`. If
/// anything fails, the temporary file is removed, an existing file at `path` is unchanged, and the error is thrown
/// again. Failures of the system are RunError with a plain message, for example that the disk is full.
void write_atomically(const std::string& path, const std::function<void(const std::string& temporary)>& write);
/// The same for bytes in memory.
void write_atomically(const std::string& path, std::span<const std::byte> bytes);
void write_atomically(const std::string& path, const std::string& text);

/// Writes bytes to a new or emptied file directly. Throws RunError with the reason of the system.
void write_bytes(const std::string& path, std::span<const std::byte> bytes);
/// The content of a file. Throws InputError if it cannot be read.
std::string read_text(const std::string& path);

/// Suffix of the name of an unfinished file.
inline constexpr const char* unfinished_suffix = ".partial";

}  // namespace voussoir
