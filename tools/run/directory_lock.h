// One program at a time in a run directory.
#pragma once
#include <string>

namespace voussoir {

/// Holds a folder until it goes out of scope or the process ends, however it ends; leaves nothing behind. Throws
/// InputError when another process holds it. Where the file system knows no locks there is none.
class DirectoryLock {
 public:
  explicit DirectoryLock(const std::string& directory);
  ~DirectoryLock();
  DirectoryLock(DirectoryLock&& other) noexcept : handle_(other.handle_) { other.handle_ = -1; }
  DirectoryLock& operator=(DirectoryLock&&) = delete;

 private:
  int handle_ = -1;
};

}  // namespace voussoir
