// voussoir: one program, one verb a job. Exit status 0 done, 1 the work failed, 2 the input is wrong.
#include <fmt/format.h>

#include <algorithm>
#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <filesystem>
#include <new>

#include "solver/base/error.h"
#include "solver/base/parallel.h"
#include "solver/base/suggestion.h"
#include "tools/voussoir/verb.h"

namespace {

void print_help() {
  fmt::print(
      "voussoir {}: masonry arch bridges, stone by stone\n\nUsage: voussoir VERB …   (voussoir VERB --help says "
      "more)\n\n",
      VOUSSOIR_VERSION);
  for (const voussoir::Verb& verb : voussoir::verbs()) fmt::print("  {:<10} {}\n", verb.name, verb.summary);
  fmt::print("\nExit status: 0 done, 1 the work failed, 2 the input is wrong.\n");
}

int run(int argc, char** argv) {
  const std::string name = argc > 1 ? argv[1] : "--help";
  if (name == "--help" || name == "-h" || name == "help") {
    print_help();
    return argc > 1 ? 0 : 2;
  }
  if (name == "--version") {
    fmt::print("voussoir {}\n", VOUSSOIR_VERSION);
    return 0;
  }
  for (const voussoir::Verb& verb : voussoir::verbs())
    if (verb.name == name) return verb.run({argv + 2, argv + argc});
  std::vector<std::string> names;
  for (const voussoir::Verb& verb : voussoir::verbs()) names.push_back(verb.name);
  throw voussoir::InputError("unknown verb '{}'{}; voussoir --help says more", name, voussoir::suggestion(name, names));
}

/// Output that did not arrive (a full disk behind a pipe or a redirection) is not done.
int flushed(int status) {
  if (std::fflush(stdout) == 0 && !std::ferror(stdout)) return status;
  throw voussoir::RunError("cannot write to standard output: {}", std::strerror(errno));
}

}  // namespace

int main(int argc, char** argv) {
  voussoir::ensure_passive_waiting(argv);
  std::signal(SIGPIPE, SIG_IGN);  // a reader that goes away is no reason to lose a run
  std::signal(SIGXFSZ, SIG_IGN);  // a file-size limit is reported like a full disk
  try {
    return flushed(run(argc, argv));
  } catch (const voussoir::InputError& e) {
    fmt::print(stderr, "voussoir: error: {}\n", e.what());
    return 2;
  } catch (const voussoir::RunError& e) {
    fmt::print(stderr, "voussoir: failed: {}\n", e.what());
    return 1;
  } catch (const std::bad_alloc&) {
    fmt::print(stderr, "voussoir: failed: out of memory; use a larger block_scale\n");
    return 1;
  } catch (const std::filesystem::filesystem_error& e) {
    fmt::print(stderr, "voussoir: failed: {}: {}\n", e.path1().string(), e.code().message());
    return 1;
  } catch (const std::exception& e) {
    fmt::print(stderr, "voussoir: failed: {} (this is a fault of the program: please report it)\n", e.what());
    return 1;
  }
}
