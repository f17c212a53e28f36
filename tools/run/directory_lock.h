// A lock that lets only one program at a time work in a run directory.
#pragma once
#include <string>

namespace voussoir {

/// Locks a folder until the object is destroyed or the process ends in any way. Leaves no file behind. Throws
/// InputError if another process holds the lock. On a file system without locks it does nothing.
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
