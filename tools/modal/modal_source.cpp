#include "tools/modal/modal_source.h"

#include <fmt/format.h>

#include <filesystem>

#include "io/hdf5/h5.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/contact/grouping.h"
#include "solver/contact/search.h"
#include "solver/run/simulation.h"
#include "solver/statics/settle.h"
#include "solver/step/loads.h"
#include "tools/run/stored_state.h"
#include "tools/run/terminal.h"

namespace voussoir {

namespace fs = std::filesystem;

namespace {

/// Computes the gravity stage alone, in the same way as a run.
void rest_under_gravity(ModalSource& source, int threads, bool quiet) {
  SolverSettings settings = source.c.settings;
  const auto stage = std::find_if(settings.stages.begin(), settings.stages.end(),
                                  [](const StageSettings& s) { return s.kind == StageSettings::Kind::gravity; });
  settings.stages = {stage == settings.stages.end() ? StageSettings{} : *stage};
  source.loads = loads_after(settings.stages, 0);
  ProgressLine progress(quiet);
  Observers observers;
  observers.progress = [&](const Progress& p) { progress.show(p); };
  Simulation run(source.assembly, settings, threads, observers);
  const RunEnd end = run.run();
  progress.end();
  if (end != RunEnd::finished) throw RunError("no equilibrium under gravity was found: {}", run.failure());
  source.state = run.state();
  take_joint_order(source.model, source.state);  // and the positions of joints that construction steps have made
}

/// Brings the state of a run to rest.
void settle_down(ModalSource& source, Stepper& stepper, bool quiet) {
  // Share of the mean weight of a block. At this residual the joint forces are accurate enough, and contacts do not
  // change any more.
  constexpr double tolerance = 1e-4;
  ProgressLine line(quiet);
  const Settled settled = settle(stepper, tolerance, nullptr, [&](std::int64_t step, double residual) {
    Progress progress;
    progress.stage = "coming to rest";
    progress.timed = false;
    progress.note = fmt::format("iteration {} of dynamic relaxation: out-of-balance force {:.1e}", step, residual);
    line.show(progress);
  });
  line.end();
  if (!settled.equilibrium.converged)
    throw RunError(
        "the state does not come to rest under gravity, because the bridge is still collapsing ({}). Give --as-stored "
        "to take the state as it is",
        settled.equilibrium.account);
  source.about +=
      fmt::format(", at rest after {} of dynamic relaxation", counted(settled.equilibrium.steps, "iteration"));
  if (const std::size_t n = settled.falling.size())
    source.about += fmt::format(" ({} in the air)", counted(n, "block"));
}

void load_checkpoint(ModalSource& source, const std::string& file) {
  StoredState stored = read_stored_state(file);
  source.c = std::move(stored.c), source.assembly = std::move(stored.assembly);
  source.model = std::move(stored.model), source.state = std::move(stored.state);
  source.tangent = PatchTangent::present;
  source.damaged = true;
  source.name = fs::path(stored.run).filename().string();
  source.about = fmt::format("{} at t = {:.3f} s, joints as they are", source.name, stored.header.time);
  // Between two stages the loads are those of the earlier stage.
  const std::int64_t at = stored.header.numbers["stage_begun"] > 0.0 ? stored.header.stage : stored.header.stage - 1;
  const auto stages = std::int64_t(source.c.settings.stages.size());
  if (at >= 0) source.loads = loads_after(source.c.settings.stages, std::size_t(std::min(at, stages - 1)));
}

void load_case(ModalSource& source, const Case& c) {
  source.c = c;
  source.assembly = make_assembly(source.c);
  source.model = build_model(source.assembly, source.c.settings);
  source.state = initial_state(source.model);
  source.name = fs::path(c.path).stem().string();
}

/// Brings the source to rest if the settings ask for it, and chooses the tangent of its state.
ModalSource prepared(ModalSource source, const std::function<void(ModalSettings&)>& modal, bool as_stored, int threads,
                     bool quiet) {
  ModalSettings& asked = source.c.settings.modal;
  modal(asked);
  const bool gravity = asked.state == ModalSettings::State::gravity;
  if (!source.damaged) {
    if (as_stored)
      throw InputError("--as-stored applies to the state of a run, but {} is a case. Leave the option out",
                       source.c.path);
    if (asked.geometric && !gravity)
      throw InputError("the geometric stiffness needs the forces of a state. Add --state gravity");
    if (gravity) rest_under_gravity(source, threads, quiet);
    source.tangent = gravity ? PatchTangent::present : PatchTangent::intact;
    source.about =
        fmt::format("{}, {}", source.c.path, gravity ? "joints as they rest under gravity" : "all joints intact");
  }
  for (const std::string& effect : source.assembly.effects) source.about += fmt::format(", effect {}", effect);
  if (source.tangent == PatchTangent::intact) return source;
  set_branches(source.model, source.state, 0);
  Stepper stepper;
  stepper.model = &source.model;
  stepper.state = &source.state;
  stepper.threads = threads;
  stepper.search_distance = search_distance(source.model);
  stepper.loads = LoadPlaces(source.assembly, source.model).at_work(source.loads, source.loads);
  stepper.prepare();
  if (source.damaged && !as_stored) settle_down(source, stepper, quiet);
  stepper.patches_only();  // the tangent is that of the last pass
  if (asked.geometric) {
    source.wrenches = stepper.wrenches;
    source.about += ", with geometric stiffness";
  }
  return source;
}

}  // namespace

ModalSource modal_source(const Case& c, const std::function<void(ModalSettings&)>& modal, int threads, bool quiet) {
  ModalSource source;
  load_case(source, c);
  return prepared(std::move(source), modal, false, threads, quiet);
}

ModalSource modal_source(const std::string& from, const std::function<void(ModalSettings&)>& modal, bool as_stored,
                         int threads, bool quiet) {
  ModalSource source;
  std::error_code ignored;
  if (!fs::exists(from, ignored)) throw InputError("there is no file or folder {}", from);
  if (fs::is_directory(from, ignored))
    load_checkpoint(source, newest_checkpoint(from, "Run the case first, or give its case.toml for the intact bridge"));
  else if (h5::File::is_hdf5(from))
    load_checkpoint(source, from);
  else
    load_case(source, read_case(from, CaseUse::geometry));
  return prepared(std::move(source), modal, as_stored, threads, quiet);
}

}  // namespace voussoir
