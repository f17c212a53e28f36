// Stages in which time passes: what acts in them, and the time steps between samples, frames and checkpoints.
#include <algorithm>
#include <cmath>

#include "solver/base/error.h"
#include "solver/base/timed.h"
#include "solver/run/runaway.h"
#include "solver/run/simulation.h"
#include "solver/step/drive.h"
#include "solver/step/loads.h"

namespace voussoir {

namespace {

/// The next multiple of `every` after `time` (s); never when `every` is zero.
double next_multiple(double time, double every) {
  return every > 0.0 ? (std::floor(time / every + 1e-9) + 1.0) * every : 1e300;
}

}  // namespace

/// Of a quasi-static stage: each of its steps sees to its own.
void Simulation::impose_nothing() {
  load({});
  stepper_.loads_since = -1.0;
  stepper_.stage_duration = 0.0;  // loads act as a whole
  stepper_.drives.clear();
  stepper_.drive.clear();
  stepper_.single = false;
  stepper_.ground = {};
}

/// What a stage does to the assembly: drives and loads.
void Simulation::impose(const StageSettings& stage) {
  if (stage.kind == StageSettings::Kind::quasi_static) return impose_nothing();
  const auto at = std::size_t(position_.stage);
  const Loads before = at > 0 ? loads_after(settings_.stages, at - 1) : Loads{};
  part_of_way_ = -1;
  if (stage.moving.empty()) {
    load(places_.at_work(before, loads_after(settings_.stages, at)));
    stepper_.loads_since = -1.0;
  } else {
    follow_loads(stage);
  }
  stepper_.stage_duration = stage.duration;
  stepper_.drives = stage.drives;
  const bool departs =
      std::any_of(stage.drives.begin(), stage.drives.end(), [](const Drive& d) { return !d.with_ground(); });
  const bool shaken = stage.kind == StageSettings::Kind::motion;
  stepper_.single = shaken || stage.kind == StageSettings::Kind::free;
  stepper_.ground = departs && shaken ? ground_path(stage.motion) : GroundPath{};
  stepper_.drive.assign(stage.drives.empty() ? 0 : model_.bodies.size(), -1);
  for (std::size_t i = 0; i < stage.drives.size(); ++i)
    for (std::int64_t block : assembly_->groups.at(stage.drives[i].group))
      stepper_.drive[std::size_t(model_.body_of_block[block])] = std::int32_t(i);
}

/// Loads that move: those of the part of their way in which the present time lies. Returns the time (s) of its end.
double Simulation::follow_loads(const StageSettings& stage) {
  if (stage.moving.empty()) return 1e300;
  const double begun = position_.stage_begun == 0.0 ? state_.time() : position_.stage_start;
  const std::int64_t parts = parts_of_way(stage.moving, stage.duration);
  const double duration = stage.duration / double(parts);
  const double since = state_.time() - begun + 1e-6 * stepper_.dt;
  const std::int64_t part = std::clamp<std::int64_t>(std::int64_t(since / duration), 0, parts - 1);
  if (part != part_of_way_) {
    const auto at = std::size_t(position_.stage);
    const Loads before = at > 0 ? loads_after(settings_.stages, at - 1) : Loads{};
    const auto moved = [&](std::int64_t k) { return with_moving(before, stage.moving, duration * double(k)); };
    load(places_.at_work(moved(part), moved(part + 1)));
    stepper_.loads_since = begun + duration * double(part), stepper_.loads_duration = duration;
    part_of_way_ = part;
  }
  return begun + duration * double(part + 1);
}

/// The loads of the present stage; what is pushed acts beside them while time passes.
void Simulation::load(LoadsAtWork loads) {
  stage_loads_ = std::move(loads);
  stepper_.loads = stage_loads_;
  const auto at = std::size_t(position_.stage);
  const bool time_passes = at < settings_.stages.size() && settings_.stages[at].timed();
  if (time_passes && !pushed_.empty()) stepper_.loads.add(pushed_, model_.bodies.size());
}

void Simulation::push(std::vector<PointLoad> forces) {
  for (const PointLoad& force : forces) {
    const auto body = std::size_t(force.body);
    if (model_.bodies[body].still())
      throw InputError("a force is to act on {}, which is fixed: only blocks that can move can be pushed",
                       block_label(*assembly_, model_.block_of_body[body]));
  }
  pushed_ = std::move(forces);
  load(std::move(stage_loads_));
}

/// Asks for what acts from now on where it is due; the time (s) at which it is due next.
double Simulation::control(const StageSettings& stage) {
  if (!observers_.control) return 1e300;
  const double every = std::max(observers_.control_every, stepper_.dt), slack = 1e-6 * stepper_.dt;
  const double begun = position_.stage_start;
  const auto number = [&](double time) { return std::floor((time - begun + slack) / every); };
  if (controlled_ < begun || controlled_ > begun + stage.duration || number(state_.time()) > number(controlled_)) {
    controlled_ = state_.time();
    observers_.control(*this);
  }
  return begun + (number(state_.time()) + 1.0) * every;
}

RunEnd Simulation::timed(const StageSettings& stage, double until) {
  started_ = std::chrono::steady_clock::now();
  started_time_ = state_.time();
  const OutputSettings& output = settings_.output;
  stepper_.motion = stage.kind == StageSettings::Kind::motion ? &stage.motion : nullptr;
  stepper_.stage_start = position_.stage_start;
  const double end = position_.stage_start + stage.duration;
  const double stop_at = until >= 0.0 ? std::min(until, end) : end;
  while (state_.time() < stop_at - 1e-9 * stepper_.dt) {
    // Anew each time: new contacts may have changed the step, and a resumed run must sample at the same steps.
    const auto every = std::max<std::int64_t>(1, std::llround(output.history_every / stepper_.dt));
    const double fields_at = next_multiple(state_.time(), output.fields_every);
    const double save_at = next_multiple(state_.time(), output.checkpoint_every);
    const double next = std::min({stop_at, fields_at, save_at, follow_loads(stage), control(stage)});
    // In pieces short enough for the progress line and the checkpoint by wall time.
    const auto left = std::max<std::int64_t>(1, std::int64_t(std::ceil((next - state_.time()) / stepper_.dt - 1e-6)));
    const std::int64_t piece =
        std::min<std::int64_t>(left, std::max<std::int64_t>(50, 4000000 / std::int64_t(model_.joints.size() + 1)));
    const double sampled = costs_.history;
    const std::chrono::steady_clock::time_point begun = std::chrono::steady_clock::now();
    last_ = stepper_.advance(
        state_.step() + piece, every, [&](const BodyPass& pass) { sample(pass); }, observers_.stop);
    costs_.steps += seconds_since(begun) - (costs_.history - sampled);
    if (last_.outcome == StepOutcome::runaway || !exploded_.empty()) {
      failure_ =
          fmt::format("at t = {:.4f} s: {}", state_.time(),
                      last_.outcome == StepOutcome::runaway ? runaway_text(*assembly_, model_, state_, last_)
                                                            : exploded_ + ". Lower [analysis] safety or time_step");
      return RunEnd::failed;
    }
    if (last_.outcome == StepOutcome::contacts) change_contacts();
    if (last_.outcome == StepOutcome::interrupted || stopped()) {
      write_checkpoint(false);
      return RunEnd::interrupted;
    }
    const double slack = 1e-6 * stepper_.dt, near_end = std::max(2.0 * stepper_.dt, 0.01 * output.fields_every);
    if (state_.time() >= fields_at - slack && state_.time() < end - near_end) write_fields();  // the end has its own
    const bool wall = seconds_since(saved_) > output.checkpoint_wall;
    if ((state_.time() >= save_at - slack || wall) && state_.time() < end - slack && observers_.checkpoint) {
      write_checkpoint(false);
      saved_ = std::chrono::steady_clock::now();
    }
    report_progress(false, fmt::format("{:.1f} % of the patches evaluated point by point",
                                       100.0 * double(last_.points) /
                                           double(std::max<std::int64_t>(1, last_.points + last_.intact))));
  }
  return state_.time() >= end - 1e-9 * stepper_.dt ? RunEnd::finished : RunEnd::interrupted;
}

}  // namespace voussoir
