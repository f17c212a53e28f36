// Files that are either whole or absent: written under a temporary name, synced and renamed.
#pragma once
#include <functional>
#include <string>

namespace voussoir {

/// Calls `write` with a temporary path in the folder of `path`, syncs that file to disk and renames it to `path`.
/// Missing folders are made. Throws RunError naming the path when a folder cannot be made or the file cannot be
/// written; the temporary file is then removed and an older file of that name stays as it was.
void write_atomically(const std::string& path, const std::function<void(const std::string&)>& write);
/// The same for a text.
void write_text_atomically(const std::string& path, const std::string& text);

}  // namespace voussoir
