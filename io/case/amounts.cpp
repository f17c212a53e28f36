// Checks the numbers of time steps and files of a case before anything is built.
#include <fmt/format.h>

#include <algorithm>

#include "io/case/sections.h"
#include "solver/step/step_count.h"

namespace voussoir {

namespace {

constexpr double most_files = 100'000;  // of one kind in a run directory

void check_files(const TableReader& output, const char* key, double every, double time, const char* what) {
  if (every > 0.0 && time / every > most_files)
    output.fail(
        key,
        fmt::format(
            "is {} s. In {:g} s of simulated time this gives {:.3g} {}; at most {:g} are allowed. Give a larger value.",
            every, time, time / every, what, most_files));
}

}  // namespace

void check_amounts(TableReader& root, const Case& c) {
  double time = 0.0;
  for (const StageSettings& stage : c.settings.stages) time += stage.duration;
  if (auto analysis = root.table("analysis", "[analysis]"))
    if (const std::string why = too_many_steps(time, c.settings.step.time_step); !why.empty())
      analysis->fail("time_step", why + ". Give a longer time step or shorter stages.");
  if (auto output = root.table("output", "[output]")) {
    check_files(*output, "checkpoint_every", c.settings.output.checkpoint_every, time, "checkpoints");
    check_files(*output, "fields_every", c.settings.output.fields_every, time, "stored frames");
  }
}

}  // namespace voussoir
