#include "io/vtk/atomic.h"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>

#include "solver/base/error.h"

namespace voussoir {
namespace {

namespace fs = std::filesystem;

void make_folder_of(const fs::path& path) {
  if (path.parent_path().empty()) return;
  std::error_code error;
  fs::create_directories(path.parent_path(), error);
  if (error)
    throw RunError("{}: cannot make the folder ({}); give a folder you may write to", path.parent_path().string(),
                   error.message());
}

void sync(const std::string& path) {
  const int file = ::open(path.c_str(), O_RDONLY);
  if (file < 0) throw RunError("{}: was not written ({}); is the disk full?", path, std::strerror(errno));
  const int failed = ::fsync(file);
  const int reason = errno;
  ::close(file);
  // Some file systems cannot sync (EINVAL, EROFS on special mounts); only a real write error counts.
  if (failed && (reason == EIO || reason == ENOSPC || reason == EDQUOT))
    throw RunError("{}: could not be brought to disk ({})", path, std::strerror(reason));
}

}  // namespace

void write_atomically(const std::string& path, const std::function<void(const std::string&)>& write) {
  make_folder_of(path);
  const std::string temporary = fmt::format("{}.{}.part", path, ::getpid());
  std::error_code ignored;
  try {
    write(temporary);
    sync(temporary);
  } catch (...) {
    fs::remove(temporary, ignored);
    throw;
  }
  std::error_code error;
  fs::rename(temporary, path, error);
  if (error) {
    fs::remove(temporary, ignored);
    throw RunError("{}: cannot be written ({}); check the permissions and whether it is a folder", path,
                   error.message());
  }
}

void write_text_atomically(const std::string& path, const std::string& text) {
  write_atomically(path, [&](const std::string& temporary) {
    std::ofstream out(temporary, std::ios::binary);
    out << text;
    out.close();
    if (!out) throw RunError("{}: cannot be written; is the disk full, or the folder closed to you?", path);
  });
}

}  // namespace voussoir
