#include "solver/run/simulation.h"

#include <algorithm>

#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/parallel.h"
#include "solver/base/timed.h"
#include "solver/contact/grouping.h"
#include "solver/contact/search.h"
#include "solver/run/runaway.h"
#include "solver/run/step_report.h"
#include "solver/step/critical_step.h"
#include "solver/step/drive.h"
#include "solver/step/loads.h"
#include "solver/step/point_acceleration.h"
#include "solver/step/step_count.h"

namespace voussoir {

namespace {

constexpr std::size_t least_joints_per_thread = 500;  // below, the hand-over costs more than the share saves
constexpr int frequencies_compared = 6;               // of mass scaling, with and without
constexpr double runaway_balance = 10.0;  // the energy balance is off by ten times its largest term: give up

int useful_threads(int wanted, const Model& model) {
  constexpr std::size_t tets_of_a_joint = 2;  // that cost about as much
  const std::size_t joints = model.joints.size() + model.fill.tet_of_lane.size() / tets_of_a_joint;
  const int most = std::max<int>(1, int(joints / least_joints_per_thread));
  return std::clamp(wanted, 1, most);
}

}  // namespace

Simulation::Simulation(const Assembly& assembly, const SolverSettings& settings, int threads, Observers observers)
    : assembly_(&assembly),
      settings_(settings),
      observers_(std::move(observers)),
      model_(build_model(assembly, settings)),
      state_(initial_state(model_)),
      places_(assembly, model_),
      lost_bonds_(assembly, model_) {
  apply_guides(assembly, settings_.guides, model_);
  check_drives(assembly, settings_.stages, settings_.guides);
  check_placements(assembly, settings_.stages);
  for (const StageSettings& stage : settings_.stages) {
    places_.at_work({}, loads_at({}, stage, model_.gravity, 1.0));
    for (std::int64_t k = 0, n = parts_of_way(stage.moving, stage.duration); k <= n && !stage.moving.empty(); ++k)
      places_.at_work({}, with_moving({}, stage.moving, stage.duration * double(k) / double(n)));
  }
  held_groups_ = names_held(assembly);
  stepper_.model = &model_;
  stepper_.state = &state_;
  stepper_.shortcut = settings.step.intact_shortcut;
  stepper_.threads = useful_threads(threads, model_);
  stepper_.search_distance = search_distance(model_);
  stepper_.before_sample = [this](std::size_t tile) { lost_bonds_.count(model_, state_, tile); };
  stepper_.prepare();
}

double Simulation::end_time() const {
  double end = 0.0;
  for (const StageSettings& stage : settings_.stages) end += stage.duration;
  return end;
}

void Simulation::write_fields() {
  if (!observers_.fields) return;
  const Timed timed(costs_.fields);
  observers_.fields(*this);
}

void Simulation::write_checkpoint(bool stage_end) {
  if (!observers_.checkpoint) return;
  const Timed timed(costs_.checkpoints);
  observers_.checkpoint(*this, stage_end);
}

bool Simulation::stopped() const {
  return observers_.stop && observers_.stop->load();
}

void Simulation::log(const std::string& text) const {
  if (observers_.log) observers_.log(text);
}

void Simulation::report_progress(bool force, const std::string& note) {
  if (!observers_.progress || (!force && seconds_since(reported_) < 0.2)) return;
  reported_ = std::chrono::steady_clock::now();
  Progress p;
  p.stage =
      position_.stage < std::int64_t(settings_.stages.size()) ? settings_.stages[position_.stage].label : "complete";
  p.end = end_time();
  p.timed = p.end > 0.0 && (position_.stage >= std::int64_t(settings_.stages.size()) ||
                            settings_.stages[position_.stage].duration > 0.0);
  const bool steps = position_.stage < std::int64_t(settings_.stages.size()) &&
                     settings_.stages[position_.stage].kind == StageSettings::Kind::quasi_static;
  p.time = steps ? step_time_ : p.timed ? state_.time() : position_.stage_start;  // relaxation is no time
  p.share = p.end > 0.0 ? p.time / p.end : 1.0;
  const double wall = seconds_since(started_);
  p.speed = p.timed && wall > 0.0 ? (p.time - started_time_) / wall : 0.0;
  p.left = p.speed > 0.0 ? (p.end - p.time) / p.speed : 0.0;
  p.note = note;
  observers_.progress(p);
}

bool Simulation::scales_mass() const {
  return settings_.step.mass_scaling_limit > 0.0 || settings_.step.mass_scaling_step > 0.0;
}

/// From the reference placement, so that a resumed run has the same inertia. Before Stepper::prepare().
void Simulation::scale() {
  scaling_ =
      scale_mass(model_, initial_state(model_), settings_.step.mass_scaling_step, settings_.step.mass_scaling_limit);
}

void Simulation::restore(const RunPosition& position) {
  position_ = position;
  if (scales_mass() && position.dt > 0.0) scale();  // else it is still to come, with the choice of the step
  take_joint_order(model_, state_);
  stepper_.prepare();
  if (position.dt > 0.0) {
    stepper_.dt = position.dt;
    stepper_.damping = damping_at_work(settings_.damping, position.dt, position.highest);
  }
}

void Simulation::check() {
  if (settings_.step.time_step > 0.0 || scales_mass()) choose_step();
}

void Simulation::scale_and_say() {
  const State reference = initial_state(model_);
  const double before = critical_step(model_, reference).step;
  scale();
  stepper_.prepare();
  if (!observers_.log) return;
  if (!scaling_.at_work()) return log("mass scaling is not needed");
  log(
      fmt::format("mass scaling: the critical time step is {:.4g} s instead of {:.4g} s; the inertia of {} is "
                  "increased (at most × {:.3g}), and the mass of {} of them{} (at most × {:.3g}); the added mass is "
                  "{:.4f} %, and the weights are unchanged",
                  critical_step(model_, reference).step, before, counted(scaling_.bodies, "block"),
                  scaling_.largest_rotary, scaling_.heavier,
                  scaling_.nodes > 0 ? fmt::format(" and of {} of the fill", counted(scaling_.nodes, "node")) : "",
                  scaling_.largest, 100 * scaling_.share));
  const std::vector<double> shifts = frequency_shifts(model_, reference, scaling_, frequencies_compared);
  if (shifts.empty()) return;
  log(fmt::format("mass scaling: the first {} frequencies decrease by at most {:.3g} %, the lowest by at most {:.3g} %",
                  shifts.size(), 100 * *std::max_element(shifts.begin(), shifts.end()), 100 * shifts.front()));
}

void Simulation::choose_step() {
  if (scales_mass()) scale_and_say();
  const CriticalStep critical = critical_step(model_, state_);
  if (critical.highest <= 0.0 && settings_.step.time_step <= 0.0)
    throw InputError("no joint holds any block, so there is no critical time step. Set [analysis] time_step.");
  const double factor = damping_step_factor(settings_.damping, critical.highest);
  const double limit = critical.highest > 0.0 ? critical.step * factor : 1e300;
  if (settings_.step.time_step > limit)
    throw InputError(
        "[analysis] time_step = {:.4g} s is above the critical time step of {:.4g} s ({:.4g} s undamped, × {:.3f} for "
        "damping) of {}. Lower it, or leave it out: the program then uses {} × the critical time step.",
        settings_.step.time_step, limit, critical.step, factor, short_name(*assembly_, model_, critical),
        settings_.step.safety);
  const bool set_by_case = settings_.step.time_step > 0.0;
  position_.dt = set_by_case ? settings_.step.time_step : settings_.step.safety * limit;
  if (const std::string why = too_many_steps(end_time(), position_.dt); !why.empty())
    throw InputError("the time step, set by {}, {}. {}.",
                     set_by_case ? "[analysis] time_step" : short_name(*assembly_, model_, critical), why,
                     set_by_case ? "Give a longer time step or shorter stages"
                                 : "Lower the stiffness of its joints, or increase its mass");
  position_.highest = critical.highest;
  position_.stiffest = bound_.of_bodies(stepper_);
  position_.stiffest_node = bound_.of_nodes(stepper_);
  stepper_.dt = position_.dt;
  if (critical.body < 0) return;
  log(fmt::format("critical time step {:.4g} s undamped, set by {}; × {:.3f} with damping; time step used {:.4g} s",
                  critical.step, describe_fastest(*assembly_, model_, critical), factor, position_.dt));
}

/// Moves blocks before a stage begins and searches immediately for lost and new contacts.
void Simulation::place(const StageSettings& stage) {
  for (const Placement& p : stage.placements) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(p.angle, p.axis.normalized()));
    for (std::int64_t block : group_of(*assembly_, p.group, "stage '" + stage.label + "' places", false)) {
      const auto i = std::size_t(model_.body_of_block[std::size_t(block)]);
      double* pose = &state_.pose[pose_width * i];
      const Vec3 centre = model_.bodies[i].centroid + Vec3(pose[0], pose[1], pose[2]);
      const Vec3 u = p.through + turn * (centre - p.through) + p.move - model_.bodies[i].centroid;
      const Eigen::Quaterniond q = (turn * rotation_of(state_, i)).normalized();
      pose[0] = u.x(), pose[1] = u.y(), pose[2] = u.z();
      pose[3] = q.w(), pose[4] = q.x(), pose[5] = q.y(), pose[6] = q.z();
    }
  }
  if (stage.placements.empty() || !model_.contact.search) return;
  update_contacts(model_, state_, stepper_.damping.branches, true, stepper_.threads);
  stepper_.prepare_contacts();
}

/// At rest now, out of balance or not: half a step ago a body moved against its acceleration, v(−½) = −½ Δt a(0). With
/// v(−½) = 0 everything would run half a step early, an error of first order. After patches_only(), without damping.
void Simulation::start_from_rest() {
  BodyPass pass = stepper_.body_pass();
  pass.load_share = 0.0;  // as the stage begins
  for (std::size_t i = 0; i < model_.bodies.size(); ++i) {
    const Body& body = model_.bodies[i];
    if (body.still()) continue;
    const BodyUpdate next = pass.update(i);
    double* motion = &state_.motion[motion_width * i];
    for (int c = 0; c < 3; ++c) {
      if (!body.held(c)) motion[c] = -0.5 * next.velocity[c];
      if (!body.held(3 + c)) motion[3 + c] = -0.5 * next.momentum[c];
    }
  }
  FillPass fill = stepper_.fill_pass();
  stepper_.load_fill(fill, 0.0);
  for (std::size_t i = 0; i < model_.fill.nodes.size(); ++i) {
    const NodeUpdate next = fill.update(i);
    for (int c = 0; c < 3; ++c)
      if (!(model_.fill.held[i] >> c & 1))
        state_.fill.motion[node_width * i + std::size_t(c)] = -0.5 * next.velocity[c];
  }
}

/// Step, damping branches and the energy at the start; once a stage, before its first step.
void Simulation::begin_stage(const StageSettings& stage) {
  position_.stage_start = state_.time();
  step_row_ = {};
  step_time_ = state_.time();
  if (stage.kind == StageSettings::Kind::quasi_static) position_.stage_begun = 1.0;
  if (!stage.timed()) return stop_motion(state_);
  if (position_.dt <= 0.0) choose_step();
  const bool from_rest = position_.stage == 0 || !settings_.stages[std::size_t(position_.stage - 1)].timed();
  if (from_rest) {  // without branches a patch pass changes nothing but what it finds: safe to look at the energy
    set_branches(model_, state_, 0);
    stepper_.damping = DampingAtWork{};
    place(stage);
    stepper_.patches_only();
    start_from_rest();
    state_.starting_energy() = compute_energies(stepper_, stepper_.body_pass()).total();
    const DampingAtWork damping = damping_at_work(settings_.damping, position_.dt, position_.highest);
    set_branches(model_, state_, damping.branches.count);
    stepper_.damping = damping;
    if (!model_.fill.empty()) stepper_.begin_branches();
    log(damping.account);
    if (!stage.placements.empty()) write_fields();  // where they are let go
  }
  position_.stage_begun = 1.0;
}

void Simulation::change_contacts() {
  const Timed timed(costs_.searches);
  const ContactUpdate update = update_contacts(model_, state_, stepper_.damping.branches, last_.past, stepper_.threads);
  const bool groups = state_.step() - state_.grouped_at() >= grouping_interval;
  if (groups) group_patches(model_, state_, stepper_.threads);
  if (update.moved || groups) stepper_.prepare_contacts();
  if (update.made + update.clipped == 0) return;
  const double bound = bound_.of(stepper_, update.bodies), of_nodes = bound_.of(model_, state_, update.nodes);
  constexpr double rounding = 1.0 + 1e-9;
  if (bound <= position_.stiffest * rounding && of_nodes <= position_.stiffest_node * rounding) return;
  position_.stiffest = std::max(position_.stiffest, bound);
  position_.stiffest_node = std::max(position_.stiffest_node, of_nodes);
  if (settings_.step.time_step > 0.0) return;  // a time step of the case is not changed
  const CriticalStep critical = critical_step(model_, state_);
  const double step = settings_.step.safety * critical.step * damping_step_factor(settings_.damping, critical.highest);
  if (step >= position_.dt) return;
  const bool worth_saying = step < 0.999 * position_.dt;
  position_.dt = stepper_.dt = step;
  position_.highest = critical.highest;
  stepper_.damping = damping_at_work(settings_.damping, step, critical.highest);
  if (worth_saying)
    log(fmt::format("t = {:.4f} s: new contacts reduce the time step to {:.4g} s, set by {}", state_.time(), step,
                    short_name(*assembly_, model_, critical)));
}

/// Force that holds or drives a group, along the axes on which it is held, N.
Vec3 Simulation::reaction(const BodyPass& pass, const std::string& group) const {
  Vec3 sum = Vec3::Zero();
  for (std::int64_t block : assembly_->groups.at(group)) {
    const auto i = std::size_t(model_.body_of_block[std::size_t(block)]);
    const Triple<double> f = pass.update(i).force;
    for (int c = 0; c < 3; ++c)
      if (model_.bodies[i].held(c)) sum[c] -= f[c];
  }
  return sum;
}

Sample Simulation::take_sample(const BodyPass& pass) const {
  Sample s;
  s.time = state_.time();
  s.stage = position_.stage;
  s.energies = compute_energies(stepper_, pass);
  s.base_displacement = state_.base_displacement();
  s.contacts = state_.contact_count();
  s.broken_shares = lost_bonds_.shares();
  for (const std::string& group : held_groups_) s.reactions.push_back(reaction(pass, group));
  s.accelerations.assign(assembly_->sensors.size(), 0.0);
  s.step = step_row_;
  return s;
}

void Simulation::sample(const BodyPass& pass) {
  const Timed timed(costs_.history);
  Sample s = take_sample(pass);
  for (std::size_t i = 0; i < s.accelerations.size(); ++i) {
    const Sensor& sensor = assembly_->sensors[i];
    s.accelerations[i] = sensor.direction.dot(point_acceleration(pass, sensor.block, sensor.position));
  }
  const Energies& e = s.energies;
  for (double term : {std::abs(e.kinetic), std::abs(e.gravitational), e.elastic, e.friction, e.fracture, e.plastic,
                      e.joint_damping, e.body_damping, std::abs(e.external_work)})
    state_.largest_energy() = std::max(state_.largest_energy(), term);
  if (state_.largest_energy() > 0.0) s.balance_error = (e.total() - state_.starting_energy()) / state_.largest_energy();
  worst_balance_ = std::max(worst_balance_, std::abs(s.balance_error));
  if (exploded_.empty()) exploded_ = not_finite_text(*assembly_, stepper_, e);
  if (exploded_.empty() && !(std::abs(s.balance_error) < runaway_balance))
    exploded_ =
        fmt::format("the error of the energy balance is {:.3g} times its largest term", std::abs(s.balance_error));
  s.base_acceleration = base_acceleration(stepper_.motion, state_.time() - stepper_.stage_start);
  if (observers_.history) observers_.history(*this, s);
}

RunEnd Simulation::run(double until) {
  report_progress(true, "");
  const bool site = position_.stage == 0 && !model_.plan.empty();   // nothing is built yet
  if (state_.counters[1] == 0 && model_.contact.search && !site) {  // contact search before the first motion
    update_contacts(model_, state_, stepper_.damping.branches, true, stepper_.threads);
    stepper_.prepare_contacts();
  }
  // A checkpoint before the first stage, so that a restart is always possible.
  if (position_.stage == 0 && position_.stage_begun == 0.0) write_checkpoint(false);
  while (position_.stage < std::int64_t(settings_.stages.size())) {
    const StageSettings& stage = settings_.stages[position_.stage];
    log(fmt::format("stage {}: {}", position_.stage + 1, stage.label));
    impose(stage);
    if (position_.stage_begun == 0.0) begin_stage(stage);
    if (stage.kind == StageSettings::Kind::quasi_static) {
      const RunEnd end = step_by_step(stage, until);
      if (end == RunEnd::failed) write_fields();  // where it has gone
      if (end != RunEnd::finished) return end;
    } else if (!stage.timed()) {
      const bool done = stage.kind == StageSettings::Kind::gravity ? gravity(stage) : collapse(stage);
      if (!done && stopped()) return RunEnd::interrupted;
      sample_at_rest();
      if (!done) {
        write_fields();  // where it has gone
        return RunEnd::failed;
      }
    } else {
      const RunEnd end = timed(stage, until);
      if (end != RunEnd::finished) return end;
    }
    if (observers_.ended) {
      const Timed spent(costs_.reports);
      observers_.ended(*this, position_.stage);
    }
    ++position_.stage;
    position_.stage_begun = position_.stops = 0.0;
    write_fields();
    write_checkpoint(true);
    saved_ = std::chrono::steady_clock::now();
  }
  report_progress(true, "");
  return RunEnd::finished;
}

}  // namespace voussoir
