#include "solver/step/stepper.h"

#include <algorithm>

#include "solver/base/parallel.h"
#include "solver/contact/search.h"
#include "solver/step/drive.h"

namespace voussoir {

Vec3 base_acceleration(const GroundMotion* motion, double time) {
  if (!motion || motion->acceleration.empty() || time < 0.0) return Vec3::Zero();
  const double at = time / motion->dt;
  const auto i = std::size_t(at);
  if (i + 1 >= motion->acceleration.size()) {
    const bool last = i + 1 == motion->acceleration.size() && at - double(i) < 1e-9;
    return last ? motion->acceleration.back() : Vec3(Vec3::Zero());
  }
  const double share = at - double(i);
  return (1.0 - share) * motion->acceleration[i] + share * motion->acceleration[i + 1];
}

void Stepper::prepare() {
  incidence = find_incidence(*model, *state);
  wrenches.assign(wrench_width * (model->joints.size() + state->contacts.size()), 0.0);
}

BodyPass Stepper::body_pass() const {
  BodyPass pass;
  pass.model = model;
  pass.state = state;
  pass.incidence = &incidence;
  pass.wrenches = wrenches.data();
  pass.dt = dt;
  pass.mass_rate = damping.mass_rate;
  pass.local = damping.local;
  pass.search_distance = search_distance;
  if (!loads.none()) pass.loads = &loads;
  pass.drive = &drive;
  pass.drive_velocity.assign(drives.size(), Vec3::Zero());
  pass.base_velocity_now = state->base_velocity();
  pass.base_displacement_next = state->base_displacement();
  return pass;
}

namespace {

PatchPass patch_pass(Stepper& s) {
  return {s.model, s.state, s.damping.branches, s.wrenches.data(), s.shortcut};
}

/// The base's next velocity and displacement, from the acceleration at the present time; the driven blocks' next
/// velocities, from where they have to be; the present share of the loads.
void move_base(const Stepper& s, double time, BodyPass& pass) {
  const double since = time - s.stage_start;
  const Vec3 a = base_acceleration(s.motion, since);
  pass.base_velocity_next = pass.base_velocity_now + s.dt * a;
  pass.base_displacement_next += s.dt * pass.base_velocity_next;
  if (pass.loads && s.stage_duration > 0.0) pass.load_share = eased(since, s.stage_duration);
  for (std::size_t i = 0; i < s.drives.size(); ++i) {
    const Drive& d = s.drives[i];
    const auto path = [&](double at) { return drive_path(d, s.ground, at, s.stage_duration); };
    pass.drive_velocity[i] = (path(since + s.dt) - path(since)) / s.dt;
  }
}

PassReport patch_share(const PatchPass& pass, int thread, int threads) {
  const Range b = share(pass.model->batches.size(), thread, threads);
  PassReport report = pass.batches(b.begin, b.end);
  const Range c = share(pass.state->contacts.size(), thread, threads);
  report.merge(pass.contacts(c.begin, c.end));
  return report;
}

/// What each thread found in a step; on its own cache lines.
struct alignas(64) Found {
  PassReport patches;
  BodyReport bodies;
  bool stop = false;
};

}  // namespace

PassReport Stepper::patches_only() {
  return patch_share(patch_pass(*this), 0, 1);
}

Advance Stepper::advance(std::int64_t target, std::int64_t sample_every,
                         const std::function<void(const BodyPass&)>& sample, const std::atomic<bool>* stop) {
  Advance result;
  if (state->step() >= target) return result;
  std::vector<Found> found(std::size_t(threads), Found{});
  const PatchPass patches = patch_pass(*this);
  const double start = state->time();
  run_team(threads, [&](int thread, int team, Barrier& barrier) {
    BodyPass bodies = body_pass();
    const Range mine = share(model->bodies.size(), thread, team);
    std::int64_t step = state->step();
    double time = start;
    barrier.wait();  // nobody moves the state's scalars before all have read them
    for (;;) {
      move_base(*this, time, bodies);
      const PassReport patch_report = patch_share(patches, thread, team);
      barrier.wait();
      if (sample && step % sample_every == 0) {
        if (thread == 0) sample(bodies);
        barrier.wait();
      }
      found[thread].patches = patch_report;
      found[thread].bodies = bodies.bodies(mine.begin, mine.end);
      if (thread == 0) found[0].stop = stop && stop->load(std::memory_order_relaxed);
      ++step;
      time += dt;
      if (thread == 0) {
        state->time() = time;
        state->step() = step;
        state->base_velocity() = bodies.base_velocity_next;
        state->base_displacement() = bodies.base_displacement_next;
      }
      barrier.wait();
      bodies.base_velocity_now = bodies.base_velocity_next;
      // Every thread reads the same findings and comes to the same decision.
      PassReport all_patches;
      BodyReport all_bodies;
      for (const Found& f : found) all_patches.merge(f.patches), all_bodies.merge(f.bodies);
      all_patches.reclip &= may_clip_at(step);
      const bool decide =
          all_patches.reclip || all_bodies.search || all_bodies.runaway >= 0 || found[0].stop || step == target;
      if (!decide) continue;
      if (thread == 0) {
        result.intact = all_patches.intact;
        result.points = all_patches.points;
        result.reclip = all_patches.reclip;
        result.runaway_body = all_bodies.runaway;
        result.outcome = all_bodies.runaway >= 0                   ? StepOutcome::runaway
                         : all_patches.reclip || all_bodies.search ? StepOutcome::contacts
                         : found[0].stop && step != target         ? StepOutcome::interrupted
                                                                   : StepOutcome::reached;
      }
      break;
    }
  });
  return result;
}

void serial_step(Stepper& s) {
  State& state = *s.state;
  BodyPass bodies = s.body_pass();
  move_base(s, state.time(), bodies);
  s.patches_only();
  // Scatter instead of gather: patch by patch into one sum a body.
  std::vector<double> sums(8 * s.model->bodies.size(), 0.0);
  const std::size_t joints = s.model->joints.size();
  for (std::size_t i = 0; i < joints + state.contacts.size(); ++i) {
    const Patch& patch = i < joints ? s.model->joints[i] : state.contacts[i - joints];
    for (int c = 0; c < 6; ++c) {
      sums[8 * std::size_t(patch.a) + c] += s.wrenches[wrench_width * i + c];
      sums[8 * std::size_t(patch.b) + c] -= s.wrenches[wrench_width * i + c];
    }
  }
  // One "patch" a body, whose wrench is the sum.
  Incidence single;
  for (std::size_t i = 0; i <= s.model->bodies.size(); ++i) single.first.push_back(std::int32_t(i));
  for (std::size_t i = 0; i < s.model->bodies.size(); ++i) single.patches.push_back(std::int32_t(2 * i));
  bodies.incidence = &single;
  bodies.wrenches = sums.data();
  bodies.bodies(0, s.model->bodies.size());
  state.time() += s.dt;
  ++state.step();
  state.base_velocity() = bodies.base_velocity_next;
  state.base_displacement() = bodies.base_displacement_next;
}

}  // namespace voussoir
