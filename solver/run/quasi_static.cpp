// Quasi-static stages: from equilibrium to equilibrium along a path of loads and driven supports
// (docs/theory/steps.md).
#include <algorithm>
#include <cmath>

#include "solver/base/counted.h"
#include "solver/contact/search.h"
#include "solver/run/simulation.h"
#include "solver/statics/motion_watch.h"

namespace voussoir {

namespace {

/// Of the median block size: a motion that goes on beyond is judged, as in a collapse stage.
const double watched = CollapseSettings{}.displacement;

}  // namespace

bool Simulation::quasi_static() const {
  return std::ranges::any_of(settings_.stages,
                             [](const StageSettings& s) { return s.kind == StageSettings::Kind::quasi_static; });
}

/// What acts at a share of the way.
LoadsAtWork Simulation::step_loads(const StageSettings& stage, double share) const {
  if (stage.moving.empty()) return at_share(step_pattern_, share);
  const auto at = std::size_t(position_.stage);
  const Loads before = at > 0 ? loads_after(settings_.stages, at - 1) : Loads{};
  return places_.at_work({}, with_moving(before, stage.moving, share * stage.duration));
}

/// Takes driven blocks from one share of their way to another.
void Simulation::drive_to(const StageSettings& stage, double from, double to) {
  for (const Drive& drive : stage.drives)
    for (const std::int64_t block : assembly_->groups.at(drive.group)) {
      double* pose = &state_.pose[pose_width * std::size_t(model_.body_of_block[std::size_t(block)])];
      for (int c = 0; c < 3; ++c) pose[c] += (to - from) * drive.displacement[c];
    }
}

/// A machine that pushes where the stage has one; otherwise it has no pattern.
Machine Simulation::machine_at(const StageSettings& stage, double share) const {
  Machine machine;
  machine.multiplier = step_row_.multiplier;
  if (stage.quasi_static.push)
    machine.pattern = step_pattern_, machine.head = position_.along + share * *stage.quasi_static.push;
  return machine;
}

/// By Newton's method, in which everything takes its new value at once; the outcome is equilibrium_.
void Simulation::step_by_newton(const StageSettings& stage, double share) {
  drive_to(stage, step_row_.share, share);
  if (model_.contact.search) update_contacts(model_, state_, stepper_.damping.branches, true, stepper_.threads);
  stepper_.loads = step_loads(stage, share);
  stepper_.prepare();
  Machine machine = machine_at(stage, share);
  equilibrium_ = newton_step(
      stepper_, settings_.step.equilibrium_tolerance, stage.quasi_static.push ? &machine : nullptr, observers_.stop,
      [&](int i, double r) {
        report_progress(true,
                        fmt::format("share {:.4g}, Newton iteration {}: out-of-balance force {:.1e}", share, i, r));
      });
  if (equilibrium_.converged) take_multiplier(machine);
}

/// Uses relaxation with gradual loading, because a sudden settlement of a support would open joints that a slow one
/// does not.
void Simulation::step_by_relaxation(const StageSettings& stage, double share) {
  constexpr int rounds = 25;
  const double from = step_row_.share;
  double driven = from;
  Machine machine = machine_at(stage, from);
  const std::vector<char> loaded = bodies_loaded(model_, step_pattern_);
  std::optional<MotionWatch> watch;  // from the end of the loading: until then the motion is imposed
  RelaxationLimits limits;
  limits.steps = 200000;
  limits.from_unloaded = false;
  limits.gently = true;
  limits.hopeless = [&](const State& state, double work) { return watch && watch->hopeless(state, work); };
  limits.ramp_rounds = share == from ? 1 : rounds;
  limits.ramp = [&](double part) {
    const double now = part < 1.0 ? from + part * (share - from) : share;
    drive_to(stage, std::exchange(driven, now), now);
    machine.head = machine_at(stage, now).head;
    stepper_.loads = step_loads(stage, now);
    if (part >= 1.0) watch.emplace(model_, loaded, state_, watched * model_.typical_size);
  };
  stepper_.prepare();
  equilibrium_ = relax(
      stepper_, settings_.step.equilibrium_tolerance, limits, observers_.stop,
      [&](std::int64_t step, double r) {
        report_progress(
            false, fmt::format("share {:.4g}, iteration {} of dynamic relaxation: out-of-balance force {:.1e}", share,
                               step, r));
      },
      stage.quasi_static.push ? &machine : nullptr);
  if (equilibrium_.converged) take_multiplier(machine);
}

/// What a machine has found; one without a pattern pushes nothing.
void Simulation::take_multiplier(const Machine& machine) {
  if (machine.pattern.none()) return;
  stepper_.loads = at_share(step_pattern_, machine.multiplier);
  stepper_.prepare();
  step_row_.multiplier = machine.multiplier;
}

/// The row of the equilibrium that has just been found.
void Simulation::note_step(const StageSettings& stage, double share) {
  step_row_.share = share;
  if (!stage.quasi_static.push) step_row_.multiplier = stage.loads ? share : 0.0;
  if (!stage.drives.empty()) {
    const Drive& first = stage.drives.front();
    step_row_.displacement = share * first.displacement.norm();
    look_at_rest(stepper_, [&] {
      step_row_.force = reaction(stepper_.body_pass(), first.group).dot(first.displacement.normalized());
    });
  } else if (!stage.moving.empty()) {
    step_row_.displacement = std::abs(stage.moving.front().speed) * share * stage.duration;
    step_row_.force = pattern_force(model_, stepper_.loads);
  } else {
    step_row_.displacement = pattern_displacement(model_, state_, step_pattern_) - position_.along;
    step_row_.force = step_row_.multiplier * pattern_force(model_, step_pattern_);
  }
  sample_at_rest();
}

/// Goes to a share from where the state is, in one step; false, and nothing has changed, when there is no equilibrium.
bool Simulation::equilibrium_at(const StageSettings& stage, const Stop& stop, bool relaxes) {
  const State good = state_;
  const StepRow row = step_row_;
  const LoadsAtWork loads = stepper_.loads;
  const auto put_back = [&] {
    state_ = good, step_row_ = row, stepper_.loads = loads;
    stepper_.prepare();
  };
  equilibrium_ = {};
  if (by_newton(stage)) step_by_newton(stage, stop.share);
  if (!equilibrium_.converged && relaxes && !stopped()) {
    put_back();
    step_by_relaxation(stage, stop.share);
  }
  if (!equilibrium_.converged) {
    put_back();
    return false;
  }
  step_time_ = state_.time() = position_.stage_start + stop.way * stage.duration;
  note_step(stage, stop.share);
  return true;
}

/// Relaxation of large systems with a fill, whose elements flow, is faster.
bool Simulation::by_newton(const StageSettings& stage) const {
  return stage.method == StageSettings::Method::newton ||
         (stage.method == StageSettings::Method::automatic && model_.fill.empty());
}

/// Goes from one stop to the next, in smaller steps where the whole one finds no equilibrium. Returns where it has come
/// to: the next stop, or the last equilibrium before it.
Stop Simulation::approach(const StageSettings& stage, Stop from, const Stop& to) {
  // Where Newton's method does not converge shorter steps come first: a relaxation goes a little too far where joints
  // slide, the less the shorter its step.
  const int first_relaxed = by_newton(stage) ? std::min(2, stage.quasi_static.halvings) : 0;
  const bool relaxes = stage.method != StageSettings::Method::newton;
  for (int halved = 0; halved <= stage.quasi_static.halvings && !stopped();) {
    const double part = std::ldexp(1.0, -halved);
    const Stop wanted =
        halved == 0 ? to : Stop{from.way + part * (to.way - from.way), from.share + part * (to.share - from.share)};
    if (!equilibrium_at(stage, wanted, relaxes && halved >= first_relaxed)) {
      ++halved;
      continue;
    }
    log(fmt::format("share {:.5g}: {:.5g} kN at {:.5g} mm ({})", wanted.share, 1e-3 * step_row_.force,
                    1e3 * step_row_.displacement,
                    equilibrium_.relaxed ? counted(equilibrium_.steps, "iteration") + " of dynamic relaxation"
                                         : counted(equilibrium_.iterations, "Newton iteration")));
    if (halved == 0) return to;
    from = wanted;
    --halved;
  }
  return from;
}

/// Sets the loads and drives of the stage and finds its first equilibrium. Returns false and sets the failure text if
/// there is none.
bool Simulation::begin_steps(const StageSettings& stage) {
  stepper_.damping = DampingAtWork{};
  set_branches(model_, state_, 0);
  const auto at = std::size_t(position_.stage);
  const Loads before = at > 0 ? loads_after(settings_.stages, at - 1) : Loads{};
  const Loads after = stage.quasi_static.push ? loads_at(before, stage, model_.gravity, 1.0)  // beside what acts
                                              : stage.loads.value_or(before);
  step_pattern_ = stage.moving.empty() ? one_a_point(places_.at_work(before, after)) : LoadsAtWork{};
  step_row_ = {};
  step_time_ = state_.time();
  if (position_.stops > 0.0) {
    step_row_.multiplier = position_.multiplier;
    step_row_.force = step_row_.displacement = NAN;  // of a resumed run: not known until the next equilibrium
    return true;
  }
  position_.along = pattern_displacement(model_, state_, step_pattern_);
  if (equilibrium_at(stage, {}, stage.method != StageSettings::Method::newton)) return true;
  failure_ = fmt::format(
      "there is no equilibrium at the beginning of the stage '{}': {}. Begin with a gravity stage, and check the "
      "positions of the stones at its end",
      stage.label, equilibrium_.account);
  return false;
}

/// A path that ends before its last stop is a valid result in the last stage and a failure in earlier stages.
RunEnd Simulation::lose(const StageSettings& stage, const Stop& from, const Stop& to) {
  const std::string reached =
      std::isnan(step_row_.force)
          ? ""
          : fmt::format(", after {:.5g} kN at {:.5g} mm", 1e-3 * step_row_.force, 1e3 * step_row_.displacement);
  const std::string text = fmt::format(
      "stage '{}': equilibrium is lost between the shares {:.5g} and {:.5g}{}. The run keeps the last equilibrium",
      stage.label, from.share, to.share, reached);
  log(text);
  if (std::size_t(position_.stage) + 1 == settings_.stages.size()) return RunEnd::finished;
  failure_ =
      text + ". The later stages are not started. Reduce the load or displacement of this stage, or make it the last";
  return RunEnd::failed;
}

RunEnd Simulation::step_by_step(const StageSettings& stage, double until) {
  const std::vector<Stop> stops = stops_of(stage.quasi_static);
  const auto done = [&] { return std::size_t(position_.stops); };
  const auto here = [&] { return done() > 0 ? stops[done() - 1] : Stop{}; };
  if (!begin_steps(stage)) return stopped() ? RunEnd::interrupted : RunEnd::failed;
  step_row_.share = here().share;
  while (done() < stops.size()) {
    const Stop& next = stops[done()];
    const Stop come = approach(stage, here(), next);
    const bool there = come.way == next.way;
    if (there) position_.stops += 1.0, position_.multiplier = step_row_.multiplier;
    const bool ends = stopped() || (until >= 0.0 && state_.time() >= until * (1.0 - 1e-12));
    if (there && done() == stops.size()) break;  // its frame and checkpoint are those of the stage's end
    if (there) write_fields();
    if (there) write_checkpoint(false);  // a step takes as long as many checkpoints
    if (ends) return RunEnd::interrupted;
    if (!there) return lose(stage, come, next);
  }
  return RunEnd::finished;
}

}  // namespace voussoir
