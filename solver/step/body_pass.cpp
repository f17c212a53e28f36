#include "solver/step/body_pass.h"

#include <cmath>

#include "solver/contact/search.h"

namespace voussoir {

Incidence find_incidence(const Model& model, const State& state) {
  Incidence incidence;
  const std::size_t joints = model.joints.size(), all = joints + state.contacts.size();
  const auto patch = [&](std::size_t i) -> const Patch& {
    return i < joints ? model.joints[i] : state.contacts[i - joints];
  };
  incidence.first.assign(model.bodies.size() + 1, 0);
  for (std::size_t i = 0; i < all; ++i) ++incidence.first[patch(i).a + 1], ++incidence.first[patch(i).b + 1];
  for (std::size_t i = 1; i < incidence.first.size(); ++i) incidence.first[i] += incidence.first[i - 1];
  incidence.patches.resize(incidence.first.back());
  std::vector<std::int32_t> next(incidence.first.begin(), incidence.first.end() - 1);
  for (std::size_t i = 0; i < all; ++i) {
    incidence.patches[next[patch(i).a]++] = std::int32_t(2 * i);
    incidence.patches[next[patch(i).b]++] = std::int32_t(2 * i + 1);
  }
  return incidence;
}

namespace {

Triple<double> times(const Mat3& m, const Triple<double>& x) {
  return {m(0, 0) * x.x + m(0, 1) * x.y + m(0, 2) * x.z, m(1, 0) * x.x + m(1, 1) * x.y + m(1, 2) * x.z,
          m(2, 0) * x.x + m(2, 1) * x.y + m(2, 2) * x.z};
}

Triple<double> spin(const Body& body, const Quat<double>& q, const Triple<double>& momentum) {
  return turn(q, times(body.inverse_inertia, turn_back(q, momentum)));
}

/// exp(½ dt ω) q; series of sin and cos below a quarter turn a step, which keep full precision and are the
/// same on every machine.
Quat<double> rotate(const Quat<double>& q, const Triple<double>& omega, double dt) {
  const Triple<double> h = 0.5 * dt * omega;
  const double x = dot(h, h);
  double c, s;  // cos |h|, sin |h| / |h|
  if (x < 0.06) {
    constexpr double c2 = 1.0 / 12, c3 = 1.0 / 30, c4 = 1.0 / 56, c5 = 1.0 / 90;
    constexpr double s1 = 1.0 / 6, s2 = 1.0 / 20, s3 = 1.0 / 42, s4 = 1.0 / 72, s5 = 1.0 / 110;
    c = 1.0 - 0.5 * x * (1.0 - c2 * x * (1.0 - c3 * x * (1.0 - c4 * x * (1.0 - c5 * x))));
    s = 1.0 - s1 * x * (1.0 - s2 * x * (1.0 - s3 * x * (1.0 - s4 * x * (1.0 - s5 * x))));
  } else {
    const double a = std::sqrt(x);
    c = std::cos(a);
    s = std::sin(a) / a;
  }
  return Quat<double>{c, s * h} * q;
}

Quat<double> normalised(const Quat<double>& q) {
  const double norm = 1.0 / std::sqrt(q.w * q.w + dot(q.v, q.v));
  return {norm * q.w, norm * q.v};
}

double sign(double x) {
  return x > 0.0 ? 1.0 : x < 0.0 ? -1.0 : 0.0;
}

/// Cundall's local damping: each component of the out-of-balance force is cut where it speeds the body up and raised
/// where it slows it down. Returns the loss over the step.
double damp_locally(double share, double dt, Triple<double>& force, const Triple<double>& velocity) {
  double loss = 0.0;
  double* f = &force.x;
  const double* v = &velocity.x;
  for (int c = 0; c < 3; ++c) {
    const double cut = share * std::abs(f[c]) * sign(v[c]);
    loss += dt * cut * v[c];
    f[c] -= cut;
  }
  return loss;
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
  if (local > 0.0) r.loss += damp_locally(local, dt, m, spin(body, pose_rotation(pose), l));
  const double h = 0.5 * dt * mass_rate;  // centred: the mean of both half steps is damped
  if (h == 0.0) {
    r.momentum = l + dt * m;
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
    (&r.load.x)[c] = (&load.x)[c];
    double& f = (&r.force.x)[c];
    f += body.mass * model->gravity[c] + (&load.x)[c];
    const double cut = local * std::abs(f) * sign(v);
    const double next = ((1.0 - h) * v + dt / body.inertial_mass * (f - cut) + 2.0 * h * base) / (1.0 + h);
    const double mean = 0.5 * (v + next);
    r.loss += dt * cut * v + mass_rate * dt * body.inertial_mass * (mean - base) * mean;
    (&r.velocity.x)[c] = next;
  }
  if (body.turns) {
    r.load_moment = load_moment;
    r.moment = r.moment + load_moment;
    turn(i, r.moment, r);
  }
  return r;
}

BodyUpdate BodyPass::update(std::size_t i) const {
  const Body& body = model->bodies[i];
  const double* pose = &state->pose[pose_width * i];
  const double* motion = &state->motion[motion_width * i];
  BodyUpdate r;
  Triple<double> f = {0, 0, 0}, m = {0, 0, 0};
  for (std::int32_t k = incidence->first[i]; k < incidence->first[i + 1]; ++k) {
    const std::int32_t entry = incidence->patches[k];
    const double* w = wrenches + wrench_width * std::size_t(entry >> 1);
    if (entry & 1) {
      f.x -= w[0], f.y -= w[1], f.z -= w[2];
      m.x -= w[3], m.y -= w[4], m.z -= w[5];
    } else {
      f.x += w[0], f.y += w[1], f.z += w[2];
      m.x += w[3], m.y += w[4], m.z += w[5];
    }
  }
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
  if (local > 0.0) r.loss += damp_locally(local, dt, f, v);
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
  }
  turn(i, m, r);
  return r;
}

BodyReport BodyPass::bodies(std::size_t begin, std::size_t end) const {
  BodyReport report;
  for (std::size_t i = begin; i < end; ++i) {
    const Body& body = model->bodies[i];
    double* pose = &state->pose[pose_width * i];
    double* motion = &state->motion[motion_width * i];
    const BodyUpdate next = update(i);
    // The ground supplies what the patches take of a body where it is held, over the mean of both half steps; likewise
    // the loads.
    for (int c = 0; c < 3; ++c)
      if (body.held(c)) motion[6] -= 0.5 * dt * (&next.force.x)[c] * (motion[c] + (&next.velocity.x)[c]);
    if (loads && !body.still())
      motion[6] += load_work(*this, i, next, triple(motion) + next.velocity, triple(motion + 3) + next.momentum);
    motion[0] = next.velocity.x, motion[1] = next.velocity.y, motion[2] = next.velocity.z;
    motion[3] = next.momentum.x, motion[4] = next.momentum.y, motion[5] = next.momentum.z;
    motion[7] += next.loss;
    for (int c = 0; c < 3; ++c) pose[c] += dt * motion[c];
    if (body.held(3)) {
      report.search |= moved_since_search(*model, *state, i, base_displacement_next.data()) > search_distance;
      continue;
    }
    const Quat<double> q = pose_rotation(pose);
    const Quat<double> half = rotate(q, spin(body, q, next.momentum), 0.5 * dt);
    const Quat<double> turned = normalised(rotate(q, spin(body, half, next.momentum), dt));
    pose[3] = turned.w, pose[4] = turned.v.x, pose[5] = turned.v.y, pose[6] = turned.v.z;
    report.search |= moved_since_search(*model, *state, i, base_displacement_next.data()) > search_distance;
    const double speed2 = dot(next.velocity, next.velocity);
    if (!(speed2 < 1e6) && report.runaway < 0) report.runaway = std::int32_t(i);
  }
  return report;
}

}  // namespace voussoir
