#include "solver/step/body_pass.h"

#include <algorithm>
#include <cmath>

#include "solver/contact/search.h"

namespace voussoir {

Incidence find_incidence(const Model& model, const State& state) {
  Incidence incidence;
  struct Bodies {
    std::size_t a, b;
  };
  const auto bodies_of = [&](std::size_t slot) {  // from the batches, which hold them closer together
    const JointBatch& batch = state.contact_batches[slot / lane_count].patch;
    return Bodies{std::size_t(batch.body_a(slot % lane_count)), std::size_t(batch.body_b(slot % lane_count))};
  };
  incidence.first.assign(model.bodies.size() + 1, 0);
  const Interface& interface = state.interface;
  const auto each_of_fill = [&](const auto& visit) {  // from the batches, too
    for (std::size_t i = 0; i < interface.patches.size(); ++i) {
      const PatchBatch& batch = interface.batches[i / lane_count].patch;
      if (std::int32_t(i % lane_count) < batch.count && batch.area[i % lane_count] > 0.0)
        visit(i, std::size_t(batch.body_a(i % lane_count)));
    }
  };
  each_of_fill([&](std::size_t, std::size_t body) { ++incidence.first[body + 1]; });
  for (std::size_t i = 0; i < state.contacts.size(); ++i)
    if (state.has_contact(i)) ++incidence.first[bodies_of(i).a + 1], ++incidence.first[bodies_of(i).b + 1];
  for (std::size_t i = 1; i < incidence.first.size(); ++i) incidence.first[i] += incidence.first[i - 1];
  incidence.contacts.resize(incidence.first.back());
  std::vector<std::int32_t> next(incidence.first.begin(), incidence.first.end() - 1);
  for (std::size_t i = 0; i < state.contacts.size(); ++i) {
    if (!state.has_contact(i)) continue;
    incidence.contacts[next[bodies_of(i).a]++] = std::int32_t(2 * i);
    incidence.contacts[next[bodies_of(i).b]++] = std::int32_t(2 * i + 1);
  }
  each_of_fill([&](std::size_t i, std::size_t body) {
    incidence.contacts[next[body]++] = std::int32_t(2 * (state.contacts.size() + i));
  });
  return incidence;
}

Array<BodyBatch> make_body_batches(const Model& model) {
  const std::size_t n = model.bodies.size();
  Array<BodyBatch> batches((n + lane_count - 1) / lane_count);
  for (std::size_t i = 0; i < lane_count * batches.size(); ++i) {
    const Body& body = model.bodies[std::min(i, n - 1)];
    BodyBatch& batch = batches[i / lane_count];
    const std::size_t lane = i % lane_count;
    for (int c = 0; c < 3; ++c) batch.centroid[c][lane] = body.centroid[c];
    batch.mass[lane] = body.mass;
    batch.inertial_mass[lane] = body.inertial_mass;
    batch.radius[lane] = body.radius;
    const Mat3& m = body.inverse_inertia;
    const double entries[6] = {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)};
    for (int c = 0; c < 6; ++c) batch.inverse_inertia[c][lane] = entries[c];
    batch.free[lane] = i < n && !body.fixed ? 1.0 : 0.0;
  }
  return batches;
}

namespace {

/// Symmetric, by xx, yy, zz, xy, xz, yz.
template <class T>
[[gnu::always_inline]] inline Triple<T> times(const T* m, const Triple<T>& x) {
  return {m[0] * x.x + m[3] * x.y + m[4] * x.z, m[3] * x.x + m[1] * x.y + m[5] * x.z,
          m[4] * x.x + m[5] * x.y + m[2] * x.z};
}

template <class T>
[[gnu::always_inline]] inline Triple<T> spin(const T* inverse_inertia, const Quat<T>& q, const Triple<T>& momentum) {
  return turn(q, times(inverse_inertia, turn_back(q, momentum)));
}

Triple<double> spin(const Body& body, const Quat<double>& q, const Triple<double>& momentum) {
  const Mat3& m = body.inverse_inertia;
  const double entries[6] = {m(0, 0), m(1, 1), m(2, 2), m(0, 1), m(0, 2), m(1, 2)};
  return spin(entries, q, momentum);
}

constexpr double most_speed2 = 1e6;    // (m/s)²
constexpr double series_limit = 0.06;  // of |h|², below which the series of rotate() keep full precision

/// exp(h) by the series of cos |h| and sin |h| / |h|, x = |h|².
template <class T>
[[gnu::always_inline]] inline Quat<T> exponential(const Triple<T>& h, const T& x) {
  constexpr double c2 = 1.0 / 12, c3 = 1.0 / 30, c4 = 1.0 / 56, c5 = 1.0 / 90;
  constexpr double s1 = 1.0 / 6, s2 = 1.0 / 20, s3 = 1.0 / 42, s4 = 1.0 / 72, s5 = 1.0 / 110;
  const T c = 1.0 - 0.5 * x * (1.0 - c2 * x * (1.0 - c3 * x * (1.0 - c4 * x * (1.0 - c5 * x))));
  const T s = 1.0 - s1 * x * (1.0 - s2 * x * (1.0 - s3 * x * (1.0 - s4 * x * (1.0 - s5 * x))));
  return {c, s * h};
}

/// The same of eight; where all turn little the terms left out are below rounding.
[[gnu::always_inline]] inline Quat<Lanes> short_exponential(const Triple<Lanes>& h, Lanes x) {
  constexpr double little = 1e-5;  // x³/720 < 2e-18
  if (!all(less(x, splat(little)))) return exponential(h, x);
  const Lanes c = 1.0 - 0.5 * x * (1.0 - 1.0 / 12 * x), s = 1.0 - 1.0 / 6 * x * (1.0 - 1.0 / 20 * x);
  return {c, s * h};
}

/// exp(½ dt ω) q; series below a quarter turn a step, which do not depend on the mathematics library.
Quat<double> rotate(const Quat<double>& q, const Triple<double>& omega, double dt) {
  const Triple<double> h = 0.5 * dt * omega;
  const double x = dot(h, h);
  if (x < series_limit) return exponential(h, x) * q;
  const double a = std::sqrt(x);
  return Quat<double>{std::cos(a), std::sin(a) / a * h} * q;
}

Quat<double> normalised(const Quat<double>& q) {
  const double norm = 1.0 / std::sqrt(q.w * q.w + dot(q.v, q.v));
  return {norm * q.w, norm * q.v};
}

double sign(double x) {
  return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0;
}

/// Cundall's local damping: each component of the out-of-balance force is cut where it speeds the body up and raised
/// where it slows it down. Returns what is cut, which acts at the mean velocity of the two half steps.
Triple<double> damp_locally(double share, Triple<double>& force, const Triple<double>& velocity) {
  const auto cut = [&](double f, double v) { return share * std::abs(f) * sign(v); };
  const Triple<double> all = {cut(force.x, velocity.x), cut(force.y, velocity.y), cut(force.z, velocity.z)};
  force = force - all;
  return all;
}

}  // namespace

double load_work(const BodyPass& pass, std::size_t i, const BodyUpdate& next, const Triple<double>& velocity,
                 const Triple<double>& momentum) {
  const Triple<double> omega = spin(pass.model->bodies[i], pose_rotation(&pass.state->pose[pose_width * i]), momentum);
  return 0.5 * pass.dt * (dot(next.load, velocity) + dot(next.load_moment, omega));
}

/// The rotational half of a step under a moment, which damping changes.
void BodyPass::turn(std::size_t i, Triple<double> m, BodyUpdate& r) const {
  const Body& body = model->bodies[i];
  const double* pose = &state->pose[pose_width * i];
  const Triple<double> l = triple(&state->motion[motion_width * i + 3]);
  Triple<double> cut = {0, 0, 0};
  if (local > 0.0) cut = damp_locally(local, m, spin(body, pose_rotation(pose), l));
  const double h = 0.5 * dt * mass_rate;  // centred: the mean of both half steps is damped
  if (h == 0.0) {
    r.momentum = l + dt * m;
    if (local > 0.0) r.loss += dt * dot(cut, spin(body, pose_rotation(pose), 0.5 * (l + r.momentum)));
    return;
  }
  r.momentum = (1.0 / (1.0 + h)) * ((1.0 - h) * l + dt * m);
  const Triple<double> mean = 0.5 * (l + r.momentum);
  r.loss += mass_rate * dt * dot(mean, spin(body, pose_rotation(pose), mean));
}

/// A fixed body goes where it is told to; along the axes that a guide leaves free, and turning where it may, as
/// patches, gravity and loads take it.
BodyUpdate BodyPass::held_update(std::size_t i, const Triple<double>& patches, const Triple<double>& moment) const {
  const Body& body = model->bodies[i];
  BodyUpdate r;
  r.force = patches;
  r.moment = moment;
  r.momentum = {0, 0, 0};
  const Vec3 prescribed = prescribed_velocity(i);
  r.velocity = {prescribed.x(), prescribed.y(), prescribed.z()};
  if (body.still()) return r;
  Triple<double> load = {0, 0, 0}, load_moment = {0, 0, 0};
  if (loads) loads->act(*model, *state, i, load_share, load, load_moment);
  const double* motion = &state->motion[motion_width * i];
  const double h = 0.5 * dt * mass_rate;
  for (int c = 0; c < 3; ++c) {
    if (body.held(c)) continue;
    const double v = motion[c], base = 0.5 * (base_velocity_now[c] + base_velocity_next[c]);
    r.load[c] = load[c];
    double& f = r.force[c];
    f += body.mass * model->gravity[c] + load[c];
    const double cut = local * std::abs(f) * sign(v);
    const double next = ((1.0 - h) * v + dt / body.inertial_mass * (f - cut) + 2.0 * h * base) / (1.0 + h);
    const double mean = 0.5 * (v + next);
    r.loss += dt * cut * mean + mass_rate * dt * body.inertial_mass * (mean - base) * mean;
    r.velocity[c] = next;
  }
  if (body.turns) {
    r.load_moment = load_moment;
    r.moment = r.moment + load_moment;
    turn(i, r.moment, r);
  }
  return r;
}

/// Force and moment about the world's origin.
[[gnu::always_inline]] inline Lanes BodyPass::wrench_sum(std::size_t i) const {
  const auto* rows = reinterpret_cast<const Lanes*>(sums);
  const std::int32_t* place = &(*sum_places)[std::size_t((*first_sum)[i])];
  const std::int32_t* const end = place + ((*first_sum)[i + 1] - (*first_sum)[i]);
  Lanes sum = rows[*place];
  while (++place != end) sum += rows[*place];
  return contact_sum(i, sum);
}

/// A sum and the wrenches of a body's contacts.
[[gnu::always_inline]] inline Lanes BodyPass::contact_sum(std::size_t i, Lanes sum) const {
  const auto* contacts = reinterpret_cast<const Lanes*>(contact_wrenches);
  for (std::int32_t k = incidence->first[i]; k < incidence->first[i + 1]; ++k) {
    const std::int32_t entry = incidence->contacts[std::size_t(k)];
    const Lanes w = contacts[entry >> 1];
    sum = entry & 1 ? sum - w : sum + w;
  }
  return sum;
}

BodyUpdate BodyPass::update(std::size_t i) const {
  const Body& body = model->bodies[i];
  const double* pose = &state->pose[pose_width * i];
  const double* motion = &state->motion[motion_width * i];
  BodyUpdate r;
  const Lanes sum = wrench_sum(i);
  Triple<double> f = {sum[0], sum[1], sum[2]}, m = {sum[3], sum[4], sum[5]};
  const Triple<double> x = {body.centroid.x() + pose[0], body.centroid.y() + pose[1], body.centroid.z() + pose[2]};
  m = m - cross(x, f);
  if (body.fixed) return held_update(i, f, m);
  const Vec3& g = model->gravity;
  f = f + body.mass * Triple<double>{g.x(), g.y(), g.z()};
  if (loads) {
    loads->act(*model, *state, i, load_share, r.load, r.load_moment);
    f = f + r.load;
    m = m + r.load_moment;
  }
  r.force = f;
  r.moment = m;
  const Triple<double> v = triple(motion);
  Triple<double> cut = {0, 0, 0};
  if (local > 0.0) cut = damp_locally(local, f, v);
  if (mass_rate > 0.0) {  // centred: the mean of both half-step velocities is damped, relative to the ground's
    const double h = 0.5 * dt * mass_rate;
    const Vec3 ground = 0.5 * (base_velocity_now + base_velocity_next);
    const Triple<double> base = {ground.x(), ground.y(), ground.z()};
    r.velocity = (1.0 / (1.0 + h)) * ((1.0 - h) * v + (dt / body.inertial_mass) * f + (2.0 * h) * base);
    const Triple<double> mean = 0.5 * (v + r.velocity);
    // What the body gives up: lost in the dampers, or handed to the ground they stand on.
    r.loss += mass_rate * dt * body.inertial_mass * dot(mean - base, mean);
  } else {
    r.velocity = v + (dt / body.inertial_mass) * f;
    if (local > 0.0) r.loss += dt * dot(cut, 0.5 * (v + r.velocity));
  }
  turn(i, m, r);
  return r;
}

/// Permanently falling bodies may have any speed.
bool BodyPass::runs_away(std::size_t body, double speed2) const {
  return !(speed2 < most_speed2) && !(state->lost(body) && std::isfinite(speed2));
}

// Not inlined: each caller might round otherwise.
[[gnu::noinline]] double holding_work(const double* force, const double* velocity_now, const double* velocity_next,
                                      double dt) {
  double work = 0.0;
  for (int c = 0; c < 3; ++c) work -= 0.5 * dt * force[c] * (velocity_now[c] + velocity_next[c]);
  return work;
}

double BodyPass::support_work(const Tile& tile) const {
  double work = 0.0;
  for (const Tile::StillSum& one : tile.still_sums) {
    const std::size_t row = motion_width * std::size_t(one.which);
    work +=
        holding_work(sums + wrench_width * std::size_t(one.sum), &still_now->motion[row], &still_next->motion[row], dt);
  }
  return work;
}

/// As move_body(), but that what its joints put on it is not added up: tiles are at other steps than this one's.
void BodyPass::move_still(std::size_t i, BodyReport& report) const {
  const auto which = std::size_t(model->still_of[i]);
  double* motion = &state->motion[motion_width * i];
  const double *next = &still_next->motion[motion_width * which], *pose = &still_next->pose[pose_width * which];
  const Lanes contacts = contact_sum(i, splat(0.0));
  for (int c = 0; c < 3; ++c) motion[6] -= 0.5 * dt * contacts[c] * (motion[c] + next[c]);
  std::copy_n(next, 6, motion);
  std::copy_n(pose, pose_width, &state->pose[pose_width * i]);
  BodyUpdate update;
  update.velocity = triple(next);
  if (looks) look_at(i, update, report);
}

/// One that is lost does not count.
void BodyPass::look_at(std::size_t i, const BodyUpdate& next, BodyReport& report) const {
  if (state->lost(i)) return;
  const Body& body = model->bodies[i];
  const Vec3 relative = Vec3(next.velocity.x, next.velocity.y, next.velocity.z) - base_velocity_next;
  double step = dt * relative.norm();
  if (!body.held(3)) {
    const Triple<double> omega = spin(body, pose_rotation(&state->pose[pose_width * i]), next.momentum);
    step += quaternion_reach * 0.5 * dt * std::sqrt(dot(omega, omega)) * body.radius;
  }
  report.fastest = std::max(report.fastest, step);
  report.farthest = std::max(report.farthest, moved_since(*model, *state, state->searched, i, base_displacement_next));
}

void BodyPass::move_body(std::size_t i, BodyReport& report) const {
  const Body& body = model->bodies[i];
  double* pose = &state->pose[pose_width * i];
  double* motion = &state->motion[motion_width * i];
  const BodyUpdate next = update(i);
  // The ground does the work of the patches on held bodies, with the mean of both half steps. The same holds for the
  // loads.
  for (int c = 0; c < 3; ++c)
    if (body.held(c)) motion[6] -= 0.5 * dt * next.force[c] * (motion[c] + next.velocity[c]);
  if (loads && !body.still())
    motion[6] += load_work(*this, i, next, triple(motion) + next.velocity, triple(motion + 3) + next.momentum);
  motion[0] = next.velocity.x, motion[1] = next.velocity.y, motion[2] = next.velocity.z;
  motion[3] = next.momentum.x, motion[4] = next.momentum.y, motion[5] = next.momentum.z;
  motion[7] += next.loss;
  for (int c = 0; c < 3; ++c) pose[c] += dt * motion[c];
  if (!body.held(3)) {
    const Quat<double> q = pose_rotation(pose);
    const Quat<double> half = rotate(q, spin(body, q, next.momentum), 0.5 * dt);
    const Quat<double> turned = normalised(rotate(q, spin(body, half, next.momentum), dt));
    pose[3] = turned.w, pose[4] = turned.v.x, pose[5] = turned.v.y, pose[6] = turned.v.z;
  }
  if (looks) look_at(i, next, report);
  if (body.held(3)) return;
  const double speed2 = dot(next.velocity, next.velocity);
  if (runs_away(i, speed2) && report.runaway < 0) report.runaway = std::int32_t(i);
}

namespace {

struct LaneRows {
  Lanes r[lane_count];
};

/// Rows of eight numbers, those of lanes past the last repeated, as columns.
[[gnu::always_inline]] inline LaneRows load_rows(const double* rows, int count) {
  LaneRows l;
  for (int lane = 0; lane < lane_count; ++lane)
    l.r[lane] = reinterpret_cast<const Lanes*>(rows)[std::min(lane, count - 1)];
  transpose(l.r);
  return l;
}

[[gnu::always_inline]] inline void store_rows(LaneRows l, LaneMask which, double* rows) {
  transpose(l.r);
  for (int lane = 0; lane < lane_count; ++lane)
    if (which[lane]) reinterpret_cast<Lanes*>(rows)[lane] = l.r[lane];
}

double largest(Lanes x) {
  double most = x[0];
  for (int lane = 1; lane < lane_count; ++lane) most = std::max(most, x[lane]);
  return most;
}

LaneRows load_searched(const float* rows, int count) {
  LaneRows l;
  for (int lane = 0; lane < lane_count; ++lane)
    l.r[lane] = widen(reinterpret_cast<const Singles*>(rows)[std::min(lane, count - 1)]);
  transpose(l.r);
  return l;
}

/// As moved_since().
Lanes lanes_moved(const LaneRows& pose, const LaneRows& from, const Vec3& base, Lanes radius) {
  Lanes d2 = splat(0.0), r2 = splat(0.0);
  for (int c = 0; c < 3; ++c) {
    const Lanes d = pose.r[c] - base[c] - from.r[c];
    d2 += d * d;
  }
  for (int c = 3; c < 7; ++c) r2 += (pose.r[c] - from.r[c]) * (pose.r[c] - from.r[c]);
  return square_root(d2) + quaternion_reach * square_root(r2) * radius;
}

/// As BodyPass::look_at(), of those that move side by side.
void look_at_lanes(const BodyPass& pass, std::size_t first, int count, const Triple<Lanes>& velocity,
                   const Lanes& half_turn2, const LaneRows& pose, BodyReport& report) {
  const BodyBatch& batch = pass.batches[first / lane_count];
  const LaneRows from = load_searched(&pass.state->searched[searched_width * first], count);
  const LaneMask counts = without(batch.are_free(), less(splat(0.0), from.r[7]));
  const Vec3& ground = pass.base_velocity_next;
  const Triple<Lanes> relative = {velocity.x - ground.x(), velocity.y - ground.y(), velocity.z - ground.z()};
  const Lanes step =
      pass.dt * square_root(dot(relative, relative)) + quaternion_reach * square_root(half_turn2) * batch.radius;
  const Lanes distance = lanes_moved(pose, from, pass.base_displacement_next, batch.radius);
  report.fastest = std::max(report.fastest, largest(select(counts, step, splat(0.0))));
  report.farthest = std::max(report.farthest, largest(select(counts, distance, splat(0.0))));
}

}  // namespace

/// Free bodies of the batch that begins at `first`, which has one; returns which it has moved: none where one turns too
/// fast for the series of rotate().
LaneMask BodyPass::move_lanes(std::size_t first, std::size_t end, BodyReport& report) const {
  const int count = int(std::min<std::size_t>(lane_count, end - first));
  const BodyBatch& batch = batches[first / lane_count];
  const LaneMask free = batch.are_free();
  LaneRows sum, motion = load_rows(&state->motion[motion_width * first], count),
                pose = load_rows(&state->pose[pose_width * first], count);
  int any_free = 0;
  while (batch.free[any_free] <= 0.0) ++any_free;
  // The sums of a held body are not read: tiles that write them may be at another time step.
  for (int lane = 0; lane < lane_count; ++lane)
    sum.r[lane] = wrench_sum(first + std::size_t(batch.free[lane] > 0.0 ? lane : any_free));
  transpose(sum.r);
  fetch_motion(first + 2 * lane_count);
  const Triple<Lanes> x = {batch.centroid[0] + pose.r[0], batch.centroid[1] + pose.r[1], batch.centroid[2] + pose.r[2]};
  Triple<Lanes> f = {sum.r[0], sum.r[1], sum.r[2]};
  const Triple<Lanes> m = Triple<Lanes>{sum.r[3], sum.r[4], sum.r[5]} - cross(x, f);
  const Vec3& g = model->gravity;
  f = f + batch.mass * Triple<Lanes>{splat(g.x()), splat(g.y()), splat(g.z())};
  const Triple<Lanes> v = {motion.r[0], motion.r[1], motion.r[2]}, l = {motion.r[3], motion.r[4], motion.r[5]};
  const Quat<Lanes> q = {pose.r[3], {pose.r[4], pose.r[5], pose.r[6]}};
  Triple<Lanes> velocity = v + (dt / batch.inertial_mass) * f, momentum = l + splat(dt) * m;
  if (mass_rate > 0.0) {  // as update() and turn()
    const double h = 0.5 * dt * mass_rate;
    const Vec3 ground = 0.5 * (base_velocity_now + base_velocity_next);
    const Triple<Lanes> base = {splat(ground.x()), splat(ground.y()), splat(ground.z())};
    const Lanes shrink = splat(1.0 / (1.0 + h)), rest = splat(1.0 - h), pull = splat(2.0 * h);
    velocity = shrink * (rest * v + (dt / batch.inertial_mass) * f + pull * base);
    momentum = shrink * (rest * l + splat(dt) * m);
    const Triple<Lanes> mean = splat(0.5) * (v + velocity), turning = splat(0.5) * (l + momentum);
    motion.r[7] +=
        mass_rate * dt *
        (batch.inertial_mass * dot(mean - base, mean) + dot(turning, spin(batch.inverse_inertia, q, turning)));
  }
  // As move_body(), in the axes of each body as they are before the step: exp(R h) q = q exp(h).
  const Triple<Lanes> own = turn_back(q, momentum);
  const Triple<Lanes> first_turn = splat(0.25 * dt) * times(batch.inverse_inertia, own);
  const Lanes first_angle2 = dot(first_turn, first_turn);
  const Quat<Lanes> half = short_exponential(first_turn, first_angle2);
  const Triple<Lanes> whole_turn =
      splat(0.5 * dt) * voussoir::turn(half, times(batch.inverse_inertia, turn_back(half, own)));
  const Lanes angle2 = dot(whole_turn, whole_turn);
  if (any(without(free, less(larger(angle2, first_angle2), splat(series_limit))))) return {};
  const Quat<Lanes> turned = q * short_exponential(whole_turn, angle2);
  const Lanes norm = 1.5 - 0.5 * (turned.w * turned.w + dot(turned.v, turned.v));  // a unit but for rounding
  const Lanes moved[6] = {velocity.x, velocity.y, velocity.z, momentum.x, momentum.y, momentum.z};
  std::copy(moved, moved + 6, motion.r);
  for (int c = 0; c < 3; ++c) pose.r[c] += dt * moved[c];
  pose.r[3] = norm * turned.w;
  pose.r[4] = norm * turned.v.x, pose.r[5] = norm * turned.v.y, pose.r[6] = norm * turned.v.z;
  if (looks) look_at_lanes(*this, first, count, velocity, angle2, pose, report);
  const Lanes speed2 = dot(velocity, velocity);
  const LaneMask runs = without(free, less(speed2, splat(most_speed2)));
  if (any(runs) && report.runaway < 0)
    for (int lane = count; lane-- > 0;)
      if (runs[lane] && runs_away(first + std::size_t(lane), speed2[lane])) report.runaway = std::int32_t(first) + lane;
  store_rows(motion, free, &state->motion[motion_width * first]);
  store_rows(pose, free, &state->pose[pose_width * first]);
  return free;
}

/// What a batch to come reads of its own, if there is one; in two parts (see fetch()).
void BodyPass::fetch_constants(std::size_t first) const {
  if (first + lane_count <= model->bodies.size()) fetch(&batches[first / lane_count], sizeof(BodyBatch));
}
void BodyPass::fetch_motion(std::size_t first) const {
  if (first + lane_count > model->bodies.size()) return;
  fetch(&state->motion[motion_width * first], lane_count * motion_width * sizeof(double));
}

BodyReport BodyPass::bodies(std::size_t begin, std::size_t end) const {
  BodyReport report;
  const bool side_by_side = local == 0.0 && !loads;  // these two act on bodies one by one
  for (std::size_t first = begin; first < end; first += lane_count) {
    const std::size_t next = std::min(end, first + lane_count);
    fetch_constants(first + 2 * lane_count);
    const LaneMask moved =
        side_by_side && any(batches[first / lane_count].are_free()) ? move_lanes(first, next, report) : LaneMask{};
    for (std::size_t i = first; i < next; ++i)
      if (!moved[int(i - first)]) still_next && model->still_of[i] >= 0 ? move_still(i, report) : move_body(i, report);
  }
  return report;
}

}  // namespace voussoir
