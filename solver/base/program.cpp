#include "solver/base/program.h"

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <iostream>
#include <new>

#include "solver/base/error.h"
#include "solver/base/output.h"
#include "solver/base/process.h"
#include "solver/base/shown.h"

namespace voussoir {

namespace {

/// Output that did not arrive (a full disk behind a redirection) is not done. A reader that went away wanted no more.
int flushed(int status) {
  errno = 0;
  std::cout.flush();
  const int by_stream = std::cout || errno == EPIPE ? 0 : errno;
  std::fflush(stdout);
  const int error = output_error() != 0 ? output_error() : by_stream;
  if (error == 0) return status;
  throw RunError("cannot write to standard output: {}", std::strerror(error));
}

}  // namespace

int run_program(const char* name, int (*run)(int argc, char** argv), int argc, char** argv) {
  begin_process(argv);
  survive_closed_pipes();
  std::signal(SIGXFSZ, SIG_IGN);  // a file-size limit is reported like a full disk
  const auto failed = [&](const std::string& why) {
    fmt::print(stderr, "{}: failed: {}\n", name, without_long_words(with_full_stop(why)));
    return 1;
  };
  try {
    return flushed(run(argc, argv));
  } catch (const InputError& e) {
    fmt::print(stderr, "{}: error: {}\n", name, without_long_words(e.what()));
    return 2;
  } catch (const RunError& e) {
    return failed(e.what());
  } catch (const std::bad_alloc&) {
    return failed(
        "out of memory: this task needs more memory than the machine has. A larger block_scale gives a generated "
        "bridge fewer blocks.");
  } catch (const std::filesystem::filesystem_error& e) {
    return failed(fmt::format("{}: {}", e.path1().string(), e.code().message()));
  } catch (const std::exception& e) {
    if (output_error() != 0)
      return failed(fmt::format("cannot write to standard output: {}", std::strerror(output_error())));
    return failed(fmt::format("{} (this is a fault of the program: please report it)", e.what()));
  }
}

}  // namespace voussoir
