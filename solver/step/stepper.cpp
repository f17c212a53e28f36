#include "solver/step/stepper.h"

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <map>
#include <numeric>

#include "solver/contact/search.h"
#include "solver/model/kernels.h"
#include "solver/step/drive.h"
#include "solver/step/energy.h"
#include "solver/step/look.h"
#include "solver/step/tile_order.h"

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
  kernels();  // settled here: a wish that cannot be met is refused before a step, in which nothing throws
  body_batches = make_body_batches(*model);
  sums.resize(wrench_width * model->sums.size());
  tile_energies.resize(model->tiles.size());
  fill_sums.assign(node_width * model->fill.sum_count(), 0.0);
  fill_volumes.assign(model->fill.sum_count(), 0.0);
  fill_energies.resize(model->fill.tiles.size());
  prepare_contacts();
}

void Stepper::prepare_contacts() {
  incidence = find_incidence(*model, *state);
  order = order_of_tiles(*model, *state);
  contact_wrenches.assign(wrench_width * (state->contacts.size() + state->interface.patches.size()), 0.0);
  interface_forces.assign(node_width * state->interface.sum_count(), 0.0);
  first_contact_batch.assign(model->tiles.size() + 1, 0);
  for (const ContactBatch& batch : state->contact_batches) ++first_contact_batch[std::size_t(batch.tile) + 1];
  std::partial_sum(first_contact_batch.begin(), first_contact_batch.end(), first_contact_batch.begin());
  contact_batches.resize(state->contact_batches.size());
  std::vector<std::int32_t> next(first_contact_batch.begin(), first_contact_batch.end() - 1);
  for (std::size_t k = 0; k < contact_batches.size(); ++k)
    contact_batches[std::size_t(next[std::size_t(state->contact_batches[k].tile)]++)] = std::int32_t(k);
}

BodyPass Stepper::body_pass() const {
  BodyPass pass;
  pass.model = model;
  pass.state = state;
  pass.first_sum = &model->first_sum;
  pass.sum_places = &model->sums;
  pass.sums = sums.data();
  pass.incidence = &incidence;
  pass.contact_wrenches = contact_wrenches.data();
  pass.batches = body_batches.data();
  pass.dt = dt;
  pass.mass_rate = damping.mass_rate;
  pass.local = damping.local;
  if (!loads.none()) pass.loads = &loads;
  pass.drive = &drive;
  pass.drive_velocity.assign(drives.size(), Vec3::Zero());
  pass.base_velocity_now = state->base_velocity();
  pass.base_displacement_next = state->base_displacement();
  return pass;
}

StillPlaces Stepper::still_places() const {
  StillPlaces places;
  for (const std::int32_t body : model->still) {
    const double* pose = &state->pose[pose_width * std::size_t(body)];
    const double* moves = &state->motion[motion_width * std::size_t(body)];
    places.pose.insert(places.pose.end(), pose, pose + pose_width);
    places.motion.insert(places.motion.end(), moves, moves + motion_width);
  }
  return places;
}

void Stepper::move_still(const BodyPass& pass, const StillPlaces& now, StillPlaces& next) const {
  next = now;
  for (std::size_t i = 0; i < model->still.size(); ++i) {
    const Vec3 velocity = pass.prescribed_velocity(std::size_t(model->still[i]));
    for (std::size_t c = 0; c < 3; ++c) {
      next.motion[motion_width * i + c] = velocity[Eigen::Index(c)];
      next.motion[motion_width * i + 3 + c] = 0.0;
      next.pose[pose_width * i + c] += dt * velocity[Eigen::Index(c)];
    }
  }
}

PatchPass Stepper::patch_pass() {
  PatchPass pass;
  pass.model = model;
  pass.state = state;
  pass.branches = damping.branches;
  pass.sums = sums.data();
  pass.contact_wrenches = contact_wrenches.data();
  pass.interface_wrenches = contact_wrenches.data() + wrench_width * state->contacts.size();
  pass.interface_forces = interface_forces.data();
  pass.shortcut = shortcut;
  return pass;
}

double Stepper::load_share(double time) const {
  if (loads_since >= 0.0) return std::clamp((time - loads_since) / loads_duration, 0.0, 1.0);
  return stage_duration > 0.0 ? eased(time - stage_start, stage_duration) : 1.0;
}

void Stepper::load_fill(FillPass& pass, double share) const {
  const bool nodes = !loads.nodes_to.empty();
  pass.loaded = nodes || loads.accelerates();
  pass.load_share = share;
  pass.load_acceleration = (1.0 - share) * loads.acceleration_from + share * loads.acceleration_to;
  if (nodes) pass.loads_from = loads.nodes_from.data(), pass.loads_to = loads.nodes_to.data();
}

FillPass Stepper::fill_pass() const {
  FillPass pass;
  pass.fill = &model->fill;
  pass.memory = &state->fill;
  pass.branches = damping.branches;
  pass.single = single;
  pass.sums = fill_sums.data();
  pass.volume_sums = fill_volumes.data();
  if (!state->interface.empty()) {
    pass.first_of_node = &state->interface.first_sum_of_node;
    pass.of_node = &state->interface.sum_of_node;
    pass.outside = interface_forces.data();
  }
  pass.gravity = model->gravity;
  pass.dt = dt;
  pass.mass_rate = damping.mass_rate;
  pass.local = damping.local;
  pass.search_distance = search_distance;
  load_fill(pass, 1.0);
  return pass;
}

PassReport Stepper::tile_patches(const PatchPass& pass, std::size_t tile) const {
  const Kernels& kernel = kernels();
  PassReport report = kernel.joints(pass, tile);
  const std::int32_t* batches = contact_batches.data();
  report.merge(
      kernel.contacts(pass, tile, batches + first_contact_batch[tile], batches + first_contact_batch[tile + 1]));
  if (!state->interface.empty()) report.reclip |= kernel.interface(pass, tile);
  return report;
}

namespace {

/// The base's next velocity and displacement, from the acceleration at the present time; the driven blocks' next
/// velocities, from where they have to be; the present share of the loads.
void move_base(const Stepper& s, double time, BodyPass& pass) {
  const double since = time - s.stage_start;
  const Vec3 a = base_acceleration(s.motion, since);
  pass.base_velocity_next = pass.base_velocity_now + s.dt * a;
  pass.base_displacement_next += s.dt * pass.base_velocity_next;
  if (pass.loads) pass.load_share = s.load_share(time);
  for (std::size_t i = 0; i < s.drives.size(); ++i) {
    const Drive& d = s.drives[i];
    const auto path = [&](double at) { return drive_path(d, s.ground, at, s.stage_duration); };
    pass.drive_velocity[i] = (path(since + s.dt) - path(since)) / s.dt;
  }
}

/// Runs `work` and adds its wall time (s) to `sum`.
template <class Work>
auto timed(double& sum, const Work& work) {
  const auto begin = std::chrono::steady_clock::now();
  const auto result = work();
  sum += std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count();
  return result;
}

/// What each tile found in a step.
struct Found {
  PassReport patches;
  BodyReport bodies;
  FillReport fill;
};

/// The fill's tiles are numbered after those of the bodies, which have nothing to do in the round before.
void add_fill_work(RoundWork& work, FillPass& fill, std::size_t body_tiles, std::vector<Found>& found,
                   std::vector<Energies>& energies, std::vector<TileCost>* costs) {
  const auto shared = [body_tiles](std::function<void(std::size_t)> of_bodies, auto of_fill) {
    return [body_tiles, of_bodies = std::move(of_bodies), of_fill](std::size_t tile) {
      if (tile >= body_tiles)
        of_fill(tile - body_tiles);
      else if (of_bodies)
        of_bodies(tile);
    };
  };
  work.before_first = shared(nullptr, [&](std::size_t tile) { kernels().volumes(fill, tile); });
  work.before_second = shared(nullptr, [&](std::size_t tile) { kernels().means(fill, tile); });
  const auto one_step = [](std::function<void(std::size_t, int)> of_bodies) {  // a fill has rounds of one step
    return [of_bodies = std::move(of_bodies)](std::size_t tile) { of_bodies(tile, 0); };
  };
  const auto any_step = [](std::function<void(std::size_t)> of_tile) {
    return [of_tile = std::move(of_tile)](std::size_t tile, int) { of_tile(tile); };
  };
  std::function<void(std::size_t)> first = shared(one_step(work.first), [&, body_tiles](std::size_t tile) {
    found[body_tiles + tile].fill = kernels().stresses(fill, tile);
  });
  std::function<void(std::size_t)> second = shared(one_step(work.second), [&, body_tiles](std::size_t tile) {
    found[body_tiles + tile].fill.merge(kernels().nodes(fill, tile));
  });
  if (costs) {
    const auto timed_tile = [&, body_tiles, costs](auto of_bodies, double TileCost::*sum) {
      return [=, &found](std::size_t tile) {
        if (tile < body_tiles) return of_bodies(tile);
        TileCost& cost = (*costs)[tile];
        timed(cost.*sum, [&] { return of_bodies(tile), 0; });
        if (sum == &TileCost::patches) cost.yielding += found[tile].fill.yielding;
      };
    };
    work.before_first = timed_tile(work.before_first, &TileCost::volumes);
    work.before_second = timed_tile(work.before_second, &TileCost::volumes);
    first = timed_tile(first, &TileCost::patches);
    second = timed_tile(second, &TileCost::bodies);
  }
  work.first = any_step(first), work.second = any_step(second);
  work.between = shared(
      work.between, [&, body_tiles](std::size_t tile) { energies[body_tiles + tile] = energies_of_fill(fill, tile); });
}

/// The bodies have moved: so do the scalars.
void finish_step(State& state, double dt, const BodyPass& bodies) {
  state.time() += dt;
  ++state.step();
  state.base_velocity() = bodies.base_velocity_next;
  state.base_displacement() = bodies.base_displacement_next;
}

/// Steps from `step` on until the next multiple of `every`.
std::int64_t until_multiple(std::int64_t step, std::int64_t every) {
  return every - step % every;
}

}  // namespace

PassReport Stepper::patches_only() {
  wrenches.resize(wrench_width * (model->joints.size() + state->contacts.size()));
  PatchPass pass = patch_pass();
  pass.wrenches = wrenches.data();
  pass.energies = tile_energies.data();
  PassReport report;
  FillPass tets = fill_pass();
  tets.energies = fill_energies.data();
  const std::size_t fill_tiles = model->fill.tiles.size();
  for (std::size_t tile = 0; tile < fill_tiles; ++tile) kernels().volumes(tets, tile);
  for (std::size_t tile = 0; tile < fill_tiles; ++tile) kernels().means(tets, tile);
  for (std::size_t tile = 0; tile < model->tiles.size(); ++tile) report.merge(tile_patches(pass, tile));
  for (std::size_t tile = 0; tile < fill_tiles; ++tile) kernels().stresses(tets, tile);
  std::copy(contact_wrenches.begin(), contact_wrenches.begin() + std::ptrdiff_t(wrench_width * state->contacts.size()),
            wrenches.begin() + std::ptrdiff_t(wrench_width * model->joints.size()));
  return report;
}

void Stepper::begin_branches() {
  const Branches at_work = damping.branches;
  for (int k = 0; k < at_work.count; ++k) damping.branches.e[k] = 1.0, damping.branches.g[k] = 0.0;
  patches_only();
  damping.branches = at_work;
}

Advance Stepper::advance(std::int64_t target, std::int64_t sample_every,
                         const std::function<void(const BodyPass&)>& sample, const std::atomic<bool>* stop) {
  Advance result;
  if (state->step() >= target) return result;
  const std::size_t body_tiles = model->tiles.size(), all_tiles = body_tiles + model->fill.tiles.size();
  std::vector<Found> found(all_tiles);
  std::vector<Energies> energies(sample ? all_tiles : 0);
  const auto most_steps = std::size_t(std::max(1, most_ahead));
  std::vector<PatchPass> patches(most_steps, patch_pass());  // of each step of a round
  FillPass fill = fill_pass();
  std::vector<BodyPass> bodies(most_steps, body_pass());
  std::vector<StillPlaces> still(most_steps + 1, still_places());
  for (std::size_t i = 0; i < bodies.size(); ++i) {
    bodies[i].energies = &energies;
    patches[i].still = still[i].pose.data();
    bodies[i].still_now = &still[i], bodies[i].still_next = &still[i + 1];
  }
  std::size_t steps = 1;
  RoundKind step_kind = RoundKind::both;
  /// How many steps until there is something to decide.
  const auto steps_of_round = [&](bool samples) {
    if (samples || !model->fill.empty()) return std::int64_t(1);
    const std::int64_t now = state->step();
    std::int64_t most = std::min({std::int64_t(most_steps), target - now, until_multiple(now, clip_interval)});
    if (sample) most = std::min(most, until_multiple(now, sample_every));
    return std::min(most, std::max<std::int64_t>(1, state->look_at() - now));
  };
  const auto next_round = [&] {
    const bool samples = sample && state->step() % sample_every == 0;
    steps = std::size_t(steps_of_round(samples));
    double time = state->time();
    for (std::size_t i = 0; i < steps; ++i, time += dt) {
      BodyPass& pass = bodies[i];
      pass.base_velocity_now = i > 0 ? bodies[i - 1].base_velocity_next : Vec3(state->base_velocity());
      pass.base_displacement_next = i > 0 ? bodies[i - 1].base_displacement_next : Vec3(state->base_displacement());
      pass.looks = i + 1 == steps && state->look_at() <= state->step() + std::int64_t(steps);
      move_base(*this, time, pass);
      move_still(pass, still[i], still[i + 1]);
    }
    fill.base_displacement = bodies.front().base_displacement_next;
    fill.base_velocity = 0.5 * (bodies.front().base_velocity_now + bodies.front().base_velocity_next);
    load_fill(fill, bodies.front().load_share);
    patches.front().energies = samples ? tile_energies.data() : nullptr;
    fill.energies = samples ? fill_energies.data() : nullptr;
    step_kind = samples ? RoundKind::first_only : RoundKind::both;
    return NextRound(model->fill.empty() ? step_kind : RoundKind::before, int(steps));
  };
  /// True when the team has to part.
  const auto decide = [&] {
    PassReport all_patches;
    BodyReport all_bodies;
    FillReport all_fill;
    for (const Found& f : found) all_patches.merge(f.patches), all_bodies.merge(f.bodies), all_fill.merge(f.fill);
    result.runaway_node = all_fill.runaway, result.inverted_tet = all_fill.inverted;
    const bool runs_away = all_bodies.runaway >= 0 || all_fill.runaway >= 0 || all_fill.inverted >= 0;
    bool searches = all_fill.search;
    if (bodies[steps - 1].looks) {
      const Look seen = look(all_bodies, state->step(), search_distance, dt);
      searches |= seen.search;
      state->look_at() = seen.next;
    }
    const bool stopped = stop && stop->load(std::memory_order_relaxed);
    const bool clip = all_patches.reclip && may_clip_at(state->step());
    result.intact = all_patches.intact;
    result.points = all_patches.points;
    result.past.clear();
    for (std::size_t tile = 0; clip && tile < body_tiles; ++tile)
      if (found[tile].patches.reclip) result.past.push_back(std::int32_t(tile));
    result.runaway_body = all_bodies.runaway;
    result.outcome = runs_away                            ? StepOutcome::runaway
                     : clip || searches                   ? StepOutcome::contacts
                     : stopped && state->step() != target ? StepOutcome::interrupted
                                                          : StepOutcome::reached;
    return result.outcome != StepOutcome::reached || state->step() == target;
  };
  const auto move_tile = [&](std::size_t tile, int step) {
    const Tile& t = model->tiles[tile];
    const BodyPass& pass = bodies[std::size_t(step)];
    state->support_work[tile] += pass.support_work(t);
    const BodyReport report = kernels().bodies(pass, std::size_t(t.first_body), std::size_t(t.end_body));
    if (step == 0) found[tile].bodies = {};
    found[tile].bodies.merge(report);
  };
  RoundWork work;
  work.first = [&](std::size_t tile, int step) {
    found[tile].patches = tile_patches(patches[std::size_t(step)], tile);
  };
  work.second = move_tile;
  work.between = [&](std::size_t tile) {
    energies[tile] = energies_of_tile(*this, bodies.front(), tile);
    if (before_sample) before_sample(tile);
  };
  if (costs) {
    costs->resize(all_tiles);
    work.first = [&](std::size_t tile, int step) {
      TileCost& cost = (*costs)[tile];
      const PassReport report = timed(cost.patches, [&] { return tile_patches(patches[std::size_t(step)], tile); });
      cost.intact += report.intact, cost.points += report.points, cost.contacts += report.contacts;
      if (!state->interface.empty())
        cost.interface +=
            lane_count * (state->interface.first_batch[tile + 1] - std::int64_t(state->interface.first_batch[tile]));
      found[tile].patches = report;
    };
    work.second = [&](std::size_t tile, int step) {
      timed((*costs)[tile].bodies, [&] { return move_tile(tile, step), 0; });
    };
  }
  if (!model->fill.empty()) add_fill_work(work, fill, body_tiles, found, energies, costs);
  work.next = [&](RoundKind done) -> NextRound {
    if (done == RoundKind::before) return step_kind;
    if (done == RoundKind::first_only) return RoundKind::between;
    if (done == RoundKind::between) {
      sample(bodies.front());
      return RoundKind::second_only;
    }
    for (std::size_t i = 0; i < steps; ++i) finish_step(*state, dt, bodies[i]);
    still.front() = still[steps];
    return decide() ? NextRound(RoundKind::end) : next_round();
  };
  run_rounds(threads, order, next_round(), work);
  return result;
}

void serial_step(Stepper& s) {
  State& state = *s.state;
  const Model& model = *s.model;
  BodyPass bodies = s.body_pass();
  move_base(s, state.time(), bodies);
  const StillPlaces now = s.still_places();
  StillPlaces next;
  s.move_still(bodies, now, next);
  bodies.still_now = &now, bodies.still_next = &next;
  s.patches_only();
  const auto add = [](double* sum, const double* wrench, double sign) {
    for (int c = 0; c < 6; ++c) sum[c] += sign * wrench[c];
  };
  std::vector<std::map<std::int32_t, std::array<double, 6>>> tile_sums(model.bodies.size());  // by tile, of each body
  for (std::size_t i = 0; i < model.joints.size(); ++i) {
    const Patch& p = model.joints[i];
    const std::int32_t tile = model.tile_of_joint(p.a, p.b);
    add(tile_sums[std::size_t(p.a)][tile].data(), &s.wrenches[wrench_width * i], 1.0);
    add(tile_sums[std::size_t(p.b)][tile].data(), &s.wrenches[wrench_width * i], -1.0);
  }
  Array<double> sums(wrench_width * model.bodies.size(), 0.0);
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    for (const auto& [tile, sum] : tile_sums[i]) add(&sums[wrench_width * i], sum.data(), 1.0);
  for (std::size_t i = 0; i < state.contacts.size(); ++i) {
    if (!state.has_contact(i)) continue;
    const double* wrench = &s.wrenches[wrench_width * (model.joints.size() + i)];
    add(&sums[wrench_width * std::size_t(state.contacts[i].a)], wrench, 1.0);
    add(&sums[wrench_width * std::size_t(state.contacts[i].b)], wrench, -1.0);
  }
  for (std::size_t i = 0; i < state.interface.patches.size(); ++i)
    if (state.interface.used(i))
      add(&sums[wrench_width * std::size_t(state.interface.patches[i].body)],
          &s.contact_wrenches[wrench_width * (state.contacts.size() + i)], 1.0);
  // One "sum" a body, and no contacts but of still bodies, which do not add up what joints put on them.
  std::vector<std::int32_t> first(model.bodies.size() + 1), places(model.bodies.size());
  std::iota(first.begin(), first.end(), 0);
  std::iota(places.begin(), places.end(), 0);
  Incidence of_still;
  of_still.first.push_back(0);
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const auto begin = s.incidence.contacts.begin();
    if (model.still_of[i] >= 0)
      of_still.contacts.insert(of_still.contacts.end(), begin + s.incidence.first[i], begin + s.incidence.first[i + 1]);
    of_still.first.push_back(std::int32_t(of_still.contacts.size()));
  }
  bodies.first_sum = &first;
  bodies.sum_places = &places;
  bodies.sums = sums.data();
  bodies.incidence = &of_still;
  std::vector<double> support_work(model.tiles.size(), 0.0);
  for (std::size_t i = 0; i < model.still.size(); ++i)
    for (const auto& [tile, sum] : tile_sums[std::size_t(model.still[i])])
      support_work[std::size_t(tile)] +=
          holding_work(sum.data(), &now.motion[motion_width * i], &next.motion[motion_width * i], s.dt);
  for (std::size_t tile = 0; tile < support_work.size(); ++tile) state.support_work[tile] += support_work[tile];
  bodies.looks = state.look_at() <= state.step() + 1;
  const BodyReport report = bodies.bodies(0, model.bodies.size());
  FillPass fill = s.fill_pass();
  fill.base_velocity = 0.5 * (bodies.base_velocity_now + bodies.base_velocity_next);
  s.load_fill(fill, bodies.load_share);
  for (std::size_t tile = 0; tile < model.fill.tiles.size(); ++tile) kernels().nodes(fill, tile);
  finish_step(state, s.dt, bodies);
  if (bodies.looks) state.look_at() = look(report, state.step(), s.search_distance, s.dt).next;
}

}  // namespace voussoir
