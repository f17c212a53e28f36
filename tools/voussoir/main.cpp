// The program voussoir: it calls the verb that its first argument names. Exit status: 0 the work is done, 1 the work
// failed, 2 the input is wrong.
#include <fmt/format.h>

#include "solver/base/build_info.h"
#include "solver/base/error.h"
#include "solver/base/program.h"
#include "solver/base/suggestion.h"
#include "solver/model/kernels.h"
#include "tools/voussoir/verb.h"

namespace {

void print_help() {
  fmt::print(
      "voussoir {}: masonry arch bridges, stone by stone\n\nUsage: voussoir VERB …   (voussoir VERB --help lists its "
      "options)\n\n",
      voussoir::program_version());
  for (const voussoir::Verb& verb : voussoir::verbs())
    if (!verb.summary.empty()) fmt::print("  {:<10} {}\n", verb.name, verb.summary);
  fmt::print(
      "\nvoussoir --version prints the version, the kernels and the libraries.\nExit status: 0 the work is done, 1 the "
      "work failed, 2 the input is wrong.\n");
}

int run(int argc, char** argv) {
  voussoir::kernels();  // reports an unusable VOUSSOIR_KERNELS before any work
  const std::string name = argc > 1 ? argv[1] : "--help";
  if (name == "--help" || name == "-h" || name == "help") {
    print_help();
    return argc > 1 ? 0 : 2;
  }
  if (name == "--version") {
    fmt::print("voussoir {}, commit {}, kernels for {}, compiled by {}\nbuilt with {}\n", voussoir::program_version(),
               voussoir::build_commit(), voussoir::kernels().instructions, voussoir::build_compiler(),
               voussoir::build_libraries());
    return 0;
  }
  for (const voussoir::Verb& verb : voussoir::verbs())
    if (verb.name == name) return verb.run({argv + 2, argv + argc});
  std::vector<std::string> names;
  for (const voussoir::Verb& verb : voussoir::verbs())
    if (!verb.summary.empty()) names.push_back(verb.name);
  throw voussoir::InputError("unknown verb '{}'{}. voussoir --help lists all verbs", name,
                             voussoir::suggestion(name, names));
}

}  // namespace

int main(int argc, char** argv) {
  return voussoir::run_program("voussoir", run, argc, argv);
}
