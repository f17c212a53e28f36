#include "tools/run/directory_lock.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>

#include "solver/base/error.h"

namespace voussoir {

DirectoryLock::DirectoryLock(const std::string& directory)
    : handle_(open(directory.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)) {
  if (handle_ < 0 || flock(handle_, LOCK_EX | LOCK_NB) == 0 || errno != EWOULDBLOCK) return;
  close(handle_);
  throw InputError("{} is in use by another voussoir. Wait until it has ended, stop it, or choose another folder",
                   directory);
}

DirectoryLock::~DirectoryLock() {
  if (handle_ >= 0) close(handle_);
}

}  // namespace voussoir
