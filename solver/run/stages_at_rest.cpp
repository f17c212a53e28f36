// The stages of a run that take no time: equilibrium and collapse.
#include <algorithm>

#include "solver/base/counted.h"
#include "solver/base/process.h"
#include "solver/base/timed.h"
#include "solver/contact/search.h"
#include "solver/run/confirm.h"
#include "solver/run/moved.h"
#include "solver/run/simulation.h"
#include "solver/statics/construction.h"
#include "solver/step/make_snapshot.h"

namespace voussoir {

namespace {

constexpr double confirm_margin = 0.02;  // of the multiplier: dynamic runs confirm it from below and from above

/// Diagonal of the box about all bodies, m.
double extent(const Model& model) {
  Vec3 low = Vec3::Constant(1e300), high = -low;
  for (const Body& body : model.bodies) {
    low = low.cwiseMin(body.centroid - Vec3::Constant(body.radius));
    high = high.cwiseMax(body.centroid + Vec3::Constant(body.radius));
  }
  return (high - low).norm();
}

}  // namespace

bool Simulation::gravity(const StageSettings& stage) {
  const Timed timed(costs_.equilibrium);
  Standing before = standing_of(state_);
  before.drawn = !stage.construction;
  stepper_.damping = DampingAtWork{};
  set_branches(model_, state_, 0);
  if (stage.construction)
    construct(stage);
  else
    find_equilibrium(stage, position_.stage == 0);
  give_memory_back();  // stiffness and its inverse take several times what the steps to come need
  if (stopped()) return false;
  if (!stayed(stage, before)) return false;
  set_baseline(state_);
  return true;
}

/// An equilibrium of what the stepper's model has, from where it stands.
void Simulation::find_equilibrium(const StageSettings& stage, bool from_unloaded) {
  equilibrium_ = {};  // whatever was found before
  const double tolerance = settings_.step.equilibrium_tolerance;
  // A fill is a large system whose elements tear and flow on the way: relaxation is there first.
  const bool by_itself = stage.method == StageSettings::Method::automatic;
  const bool stones_alone = stepper_.model->fill.empty();
  if (stage.method == StageSettings::Method::newton || (by_itself && stones_alone)) {
    equilibrium_ = newton_equilibrium(stepper_, tolerance, observers_.stop, [&](int i, double r) {
      report_progress(true, fmt::format("Newton iteration {}: out-of-balance force {:.1e}", i, r));
    });
    log(equilibrium_.account);
  }
  if (!equilibrium_.converged && !stopped() && stage.method != StageSettings::Method::newton) {
    if (by_itself && stones_alone)
      log("the solver continues with dynamic relaxation (there is a mechanism, or joints slide)");
    RelaxationLimits limits;
    limits.displacement = extent(model_);  // parts that have moved this far fall without end
    limits.from_unloaded = from_unloaded;
    equilibrium_ = relax(stepper_, tolerance, limits, observers_.stop, [&](std::int64_t step, double r) {
      report_progress(false, fmt::format("iteration {} of dynamic relaxation: out-of-balance force {:.1e}", step, r));
    });
    log(equilibrium_.account);
  }
}

/// Builds step by step and finds the equilibrium of each step before the next. The loads of the stage are applied at
/// the end.
void Simulation::construct(const StageSettings& stage) {
  const LoadsAtWork loads = std::exchange(stepper_.loads, LoadsAtWork{});
  const ConstructionPlan& plan = model_.plan;
  clear_site(model_, state_);
  int iterations = 0;
  std::int64_t relaxed = 0;  // of all steps
  for (std::int32_t step = 0; step < plan.steps() && !stopped(); ++step) {
    log(fmt::format("construction, step {} of {}: {}", step + 1, plan.steps(), plan.labels[std::size_t(step)]));
    add_step(step, model_, state_);
    const bool last = step + 1 == plan.steps();
    const Model standing = last ? Model{} : during_step(model_, step);
    if (last) {
      stepper_.loads = loads;
      if (model_.contact.search) update_contacts(model_, state_, stepper_.damping.branches, true, stepper_.threads);
    } else {
      stepper_.model = &standing;
      stepper_.search_distance = search_distance(standing);
    }
    stepper_.prepare();
    find_equilibrium(stage, step == 0);
    stepper_.model = &model_;
    stepper_.search_distance = search_distance(model_);
    equilibrium_.iterations = iterations += equilibrium_.iterations;
    equilibrium_.steps = relaxed += equilibrium_.steps;
    if (!equilibrium_.converged) {
      construction_failed_ =
          fmt::format(" in step {} of its construction ({})", step + 1, plan.labels[std::size_t(step)]);
      break;
    }
  }
  stepper_.loads = loads;
  stepper_.prepare();
}

/// Whether there is an equilibrium in which the joints hold the stones in place; else the failure text names the moving
/// stones.
bool Simulation::stayed(const StageSettings& stage, const Standing& before) {
  constexpr std::size_t named = 3;
  if (!equilibrium_.converged) {
    const Array<double>& from = equilibrium_.earlier.empty() ? before.pose : equilibrium_.earlier;
    moving_ = farthest_moved(model_, from, state_, named);
    failure_ =
        fmt::format("no equilibrium under gravity{}: {}{}{}", construction_failed_, equilibrium_.account,
                    moving_.empty() ? "" : "\nThese stones still moved in the last iterations of the relaxation:",
                    moved_text(*assembly_, model_, moving_, before, from, state_));
    return false;
  }
  std::vector<std::int32_t> moved = moved_away(*assembly_, model_, before, state_);
  if (moved.empty()) return true;
  const std::size_t count = moved.size();
  moved.resize(std::min(count, named));
  const std::string words =
      fmt::format("{} moved away from where {} joints held {} ({}):{}", counted(count, "stone"),
                  count == 1 ? "its" : "their", count == 1 ? "it" : "them",
                  "against a neighbour by more than 5 % of the smaller one's size, or turned by more than 3°",
                  moved_text(*assembly_, model_, moved, before, before.pose, state_));
  if (stage.allow_motion) {
    log(words);
    return true;
  }
  moving_ = moved;
  failure_ = "the assembly does not stay where it was built. It came to rest, but " + words +
             "\nSet allow_motion = true in this [[stage]] to continue from this position, or correct the supports of "
             "these stones";
  return false;
}

/// True unless stopped: an assembly that carries the whole load is also a valid result.
bool Simulation::collapse(const StageSettings& stage) {
  stepper_.damping = DampingAtWork{};
  set_branches(model_, state_, 0);
  const Loads base = loads_after(settings_.stages, std::size_t(position_.stage));
  const auto loads = [&](double multiplier) { return loads_at(base, stage, model_.gravity, multiplier); };
  collapse_ = find_collapse(
      stepper_, stage.collapse, settings_.step.equilibrium_tolerance,
      [&](double multiplier) { return places_.at_work({}, loads(multiplier)); }, observers_.stop,
      [&](const CollapseTry& one, double residual) {
        report_progress(
            false, fmt::format("multiplier {:.5g}, iteration {} of dynamic relaxation: out-of-balance force {:.1e}",
                               one.multiplier, one.steps, residual));
      });
  if (stopped()) return false;
  log(collapse_.account);
  log(mechanism_text(*assembly_, collapse_.mechanism));
  if (!collapse_.found || stage.collapse.confirm <= 0.0) {
    log(collapse_headline(*assembly_, collapse_));
    return true;
  }
  for (const bool above : {false, true}) {
    const double multiplier = (above ? 1.0 + confirm_margin : 1.0 - confirm_margin) * collapse_.multiplier;
    SolverSettings settings = settings_;
    settings.stages.resize(std::size_t(position_.stage));
    const bool moves = moves_away(*assembly_, settings, loads(multiplier), stage.collapse.confirm,
                                  stage.collapse.displacement * model_.typical_size, stepper_.threads, observers_.stop);
    if (stopped()) return false;
    (above ? collapse_.falls_above : collapse_.stands_below) = moves == above;
    log(fmt::format("dynamic run at the multiplier {:.5g}: {}{}", multiplier, moves ? "it moves away" : "it stands",
                    moves == above ? "" : " (this contradicts the static solver)"));
  }
  log(collapse_headline(*assembly_, collapse_));
  return true;
}

/// The history row of a stage without simulated time: the final equilibrium. It has no energy balance, because the
/// energy dissipated by the damping of a relaxation is not recorded.
void Simulation::sample_at_rest() {
  const Timed timed(costs_.history);
  if (!observers_.history) return;
  look_at_rest(stepper_, [this] {
    for (std::size_t tile = 0; tile < model_.tiles.size(); ++tile) lost_bonds_.count(model_, state_, tile);
    observers_.history(*this, take_sample(stepper_.body_pass()));
  });
}

}  // namespace voussoir
