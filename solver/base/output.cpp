#include "solver/base/output.h"

#include <unistd.h>

#include <cerrno>
#include <csignal>
#include <cstdio>

namespace voussoir {

namespace {

int first_error = 0;

/// Called by the C library with what it has gathered. Returns how much of it counts as written.
ssize_t write_on(void* cookie, const char* bytes, std::size_t size) {
  const int file = *static_cast<const int*>(cookie);
  std::size_t done = 0;
  while (done < size) {
    const ssize_t n = ::write(file, bytes + done, size - done);
    if (n > 0) {
      done += std::size_t(n);
    } else if (n < 0 && errno == EPIPE) {
      return ssize_t(size);
    } else if (n == 0 || errno != EINTR) {
      if (file == STDOUT_FILENO && first_error == 0) first_error = n == 0 ? ENOSPC : errno;
      return ssize_t(done);
    }
  }
  return ssize_t(size);
}

/// A stream onto a file descriptor, buffered as the C library would; the old one where that fails.
FILE* stream_onto(const int* file, FILE* old, int buffering) {
  cookie_io_functions_t functions = {};
  functions.write = write_on;
  FILE* stream = fopencookie(const_cast<int*>(file), "w", functions);
  if (!stream) return old;
  std::setvbuf(stream, nullptr, buffering, BUFSIZ);
  return stream;
}

}  // namespace

void survive_closed_pipes() {
  static const int out = STDOUT_FILENO, err = STDERR_FILENO;
  std::signal(SIGPIPE, SIG_IGN);
  stdout = stream_onto(&out, stdout, isatty(out) ? _IOLBF : _IOFBF);
  stderr = stream_onto(&err, stderr, _IONBF);
}

int output_error() {
  return first_error;
}

}  // namespace voussoir
