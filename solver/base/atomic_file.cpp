#include "solver/base/atomic_file.h"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <cstring>
#include <filesystem>

#include "solver/base/error.h"

namespace voussoir {

namespace {

std::string plainly(int error) {
  switch (error) {
    case ENOSPC:
      return "the disk is full. Free some space, or write to another disk";
    case EDQUOT:
      return "your quota of disk space is used up. Free some space, or write to another disk";
    case EFBIG:
      return "the file would be larger than this process may write (ulimit -f)";
    case EACCES:
    case EROFS:
      return "you have no permission to write there. Choose another folder";
    case ENOENT:
      return "the folder does not exist. Create it first";
    default:
      return std::strerror(error);
  }
}

[[noreturn]] void fail(const std::string& path, int error) {
  throw RunError("cannot write {}: {}", path, plainly(error));
}

/// A file descriptor that closes itself.
struct Descriptor {
  int number = -1;
  ~Descriptor() {
    if (number >= 0) ::close(number);
  }
};

void sync(const std::string& path, int flags) {
  Descriptor file{::open(path.c_str(), flags | O_CLOEXEC)};
  if (file.number < 0 || ::fsync(file.number) != 0) fail(path, errno);
}

}  // namespace

void write_bytes(const std::string& path, std::span<const std::byte> bytes) {
  Descriptor file{::open(path.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666)};
  if (file.number < 0) fail(path, errno);
  std::size_t done = 0;
  while (done < bytes.size()) {
    const ssize_t n = ::write(file.number, bytes.data() + done, bytes.size() - done);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) fail(path, errno);
    if (n == 0) fail(path, ENOSPC);
    done += std::size_t(n);
  }
  const int number = file.number;
  file.number = -1;
  if (::close(number) != 0) fail(path, errno);  // a network disk may say only now that it is full
}

void write_atomically(const std::string& path, const std::function<void(const std::string& temporary)>& write) {
  const std::string temporary = path + unfinished_suffix;
  try {
    write(temporary);
    sync(temporary, O_RDONLY);
    if (std::rename(temporary.c_str(), path.c_str()) != 0) fail(path, errno);
  } catch (...) {
    ::unlink(temporary.c_str());
    throw;
  }
  // The new name is safe only when the folder is on the disk too; a file system that cannot sync folders is left alone.
  const std::string folder = std::filesystem::path(path).parent_path().string();
  Descriptor directory{::open(folder.empty() ? "." : folder.c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC)};
  if (directory.number >= 0) ::fsync(directory.number);
}

void write_atomically(const std::string& path, std::span<const std::byte> bytes) {
  write_atomically(path, [&](const std::string& temporary) {
    try {
      write_bytes(temporary, bytes);
    } catch (const RunError& error) {
      // Name the file the user asked for.
      std::string text = error.what();
      if (const auto at = text.find(temporary); at != std::string::npos) text.replace(at, temporary.size(), path);
      throw RunError("{}", text);
    }
  });
}

void write_atomically(const std::string& path, const std::string& text) {
  write_atomically(path, std::as_bytes(std::span(text)));
}

std::string read_text(const std::string& path) {
  struct stat status;
  if (::stat(path.c_str(), &status) != 0) throw InputError("cannot read {}: {}", path, std::strerror(errno));
  if (S_ISDIR(status.st_mode)) throw InputError("cannot read {}: it is a folder. Name a file", path);
  Descriptor file{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
  if (file.number < 0) throw InputError("cannot read {}: {}", path, std::strerror(errno));
  std::string text;
  char buffer[1 << 16];
  while (true) {
    const ssize_t n = ::read(file.number, buffer, sizeof buffer);
    if (n < 0 && errno == EINTR) continue;
    if (n < 0) throw InputError("cannot read {}: {}", path, std::strerror(errno));
    if (n == 0) return text;
    text.append(buffer, std::size_t(n));
  }
}

}  // namespace voussoir
