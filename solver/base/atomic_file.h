// Files that are either whole or not there: written under a temporary name, synced and renamed.
#pragma once
#include <cstddef>
#include <functional>
#include <span>
#include <string>

namespace voussoir {

/// Calls `write` with a temporary name beside `path`, syncs what it wrote to the disk and renames it to `path`. When
/// anything fails the temporary is removed, the file that was at `path` stays as it was, and the error is thrown on;
/// failures of the system are RunError and say plainly that e.g. the disk is full.
void write_atomically(const std::string& path, const std::function<void(const std::string& temporary)>& write);
/// The same for bytes that are ready in memory.
void write_atomically(const std::string& path, std::span<const std::byte> bytes);
void write_atomically(const std::string& path, const std::string& text);

/// Writes bytes to a new or emptied file without any of that. Throws RunError with the system's reason.
void write_bytes(const std::string& path, std::span<const std::byte> bytes);
/// The whole file. Throws InputError when it cannot be read.
std::string read_text(const std::string& path);

/// What the end of the name of an unfinished file is.
inline constexpr const char* unfinished_suffix = ".partial";

}  // namespace voussoir
