#include "solver/base/program.h"

#include <fmt/format.h>

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>

#include "solver/base/error.h"
#include "solver/base/process.h"

namespace voussoir {

namespace {

/// Output that did not arrive (a full disk behind a pipe or a redirection) is not done.
int flushed(int status) {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return status;
  throw RunError("cannot write to standard output: {}", std::strerror(errno));
}

}  // namespace

int run_program(const char* name, int (*run)(int argc, char** argv), int argc, char** argv) {
  begin_process(argv);
  std::signal(SIGPIPE, SIG_IGN);  // a reader that goes away is no reason to lose a run
  std::signal(SIGXFSZ, SIG_IGN);  // a file-size limit is reported like a full disk
  const auto failed = [&](const std::string& why) {
    fmt::print(stderr, "{}: failed: {}\n", name, why);
    return 1;
  };
  try {
    return flushed(run(argc, argv));
  } catch (const InputError& e) {
    fmt::print(stderr, "{}: error: {}\n", name, e.what());
    return 2;
  } catch (const RunError& e) {
    return failed(e.what());
  } catch (const std::bad_alloc&) {
    return failed("out of memory; use a larger block_scale");
  } catch (const std::filesystem::filesystem_error& e) {
    return failed(fmt::format("{}: {}", e.path1().string(), e.code().message()));
  } catch (const std::exception& e) {
    return failed(fmt::format("{} (this is a fault of the program: please report it)", e.what()));
  }
}

}  // namespace voussoir
