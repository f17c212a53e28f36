// Dynamic relaxation: explicit time steps in a fictitious time (iterations), so that inertia and damping can be chosen
// for fast convergence.
//
// Inertia: with M_i at least the body's own block of K, λ(M⁻¹ K) ≤ 2 for any assembly, because the stiffness of a pair
// is at most twice its two blocks; the critical step is then at least √2 and a stiff sliver does not slow down the
// rest. Damping: viscous, 1.2 ω with ω the circular frequency that the last iterations show, ω² = −Δx·ΔF / Δx·M Δx
// (after Underwood 1983). That lies above the lowest frequency, so that the slowest motion is damped at 0.6 of critical
// or more: it hardly overshoots, so that few joints slip or open that would not do so at rest. A gentle relaxation is
// damped at 3 ω, and in its first iterations with the largest stable damping.
#include <fmt/format.h>

#include <Eigen/Dense>
#include <utility>

#include "solver/base/counted.h"
#include "solver/contact/search.h"
#include "solver/linear/dense_eigen.h"
#include "solver/linear/stiffness.h"
#include "solver/statics/equilibrium.h"

namespace voussoir {

namespace {

constexpr std::int64_t round_steps = 40;  // between looks at residual and frequency
constexpr int easing_rounds = 10;         // over which weight comes on where there is a fill

/// Smallest inertia (one mass, one tensor) that is at least the block of K: m 1 and J about as stiff as K's own parts.
void least_inertia(const Matrix6& k, double size, double& mass, Mat3& inertia) {
  mass = largest_eigenvalue(k.topLeftCorner<3, 3>());
  inertia =
      k.bottomRightCorner<3, 3>() + 1e-3 * mass * size * size * Mat3::Identity();  // a body on one point turns freely
  if (!(mass > 0.0)) return;
  Matrix6 m = Matrix6::Zero();
  m.topLeftCorner<3, 3>() = mass * Mat3::Identity();
  m.bottomRightCorner<3, 3>() = inertia;
  const double most = largest_eigenvalue(k, m);
  mass *= most, inertia *= most;
}

/// A body that nothing touches falls by a small share of a block's size in the first step.
void hang_freely(const Model& model, Body& body) {
  const double factor = std::max(model.gravity.norm(), 1.0) / (1e-4 * model.typical_size);
  body.inertial_mass *= factor, body.inertia *= factor, body.inverse_inertia /= factor;
}

/// A node of the fill weighs half of the row of K's blocks about it: no eigenvalue of M⁻¹ K is then more than 2 among
/// nodes (Gershgorin), and 4 where a stone and the three nodes of a patch move together.
void choose_node_inertia(const BlockMatrix& k, std::size_t bodies, FillModel& fill) {
  if (fill.empty()) return;
  std::vector<double> rows(k.sites(), 0.0);
  k.for_each([&](std::int32_t row, std::int32_t column, const Matrix6& block) {
    const double size = block.norm();
    rows[std::size_t(row)] += size;
    if (row != column) rows[std::size_t(column)] += size;
  });
  for (std::size_t i = 0; i < fill.nodes.size(); ++i) fill.inertial[i] = 0.5 * rows[bodies + i];
}

/// By how much a rotary stiffness may exceed the inertia that was chosen for it: λ(M⁻¹ K) then stays below 2.3, and a
/// step of 1.3 below the critical one of 2/√2.3 = 1.319. Each time an inertia changes, its body is stopped.
constexpr double spare = 1.15;

/// Whether `times` an inertia is at least another about every axis.
bool covers(const Mat3& inertia, const Mat3& other, double times) {
  return largest_eigenvalue(other, inertia) <= times;
}

/// An inertia that is at least both about every axis: one of them where it is enough, else their sum.
Mat3 larger(const Mat3& a, const Mat3& b) {
  if (covers(a, b, 1.0)) return a;
  return covers(b, a, 1.0) ? b : Mat3(a + b);
}

/// Gives the bodies the inertia that relaxes fastest; after new contacts (`again`) it only ever raises it. A body whose
/// inertia changes is stopped, for its momentum no longer means its velocity.
void choose_inertia(bool again, State& state, Model& model) {
  const BlockMatrix k = stiffness_blocks(model, state, PatchTangent::intact);
  if (!again) choose_node_inertia(k, model.bodies.size(), model.fill);
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    Body& body = model.bodies[i];
    if (body.still()) continue;
    double mass = 0.0;
    Mat3 inertia;
    least_inertia(k.diagonal(std::int32_t(i)), model.typical_size, mass, inertia);
    if (!again && mass <= 0.0) hang_freely(model, body);
    if (mass <= 0.0) continue;
    const Mat3 r = rotation_of(state, i).toRotationMatrix();
    inertia = r.transpose() * inertia * r;
    if (again) {
      if (mass < 1.0001 * body.inertial_mass && covers(body.inertia, inertia, spare)) continue;
      mass = std::max(mass, body.inertial_mass);
      inertia = larger(body.inertia, inertia);
    }
    body.inertial_mass = mass;
    body.inertia = inertia;
    body.inverse_inertia = body.inertia.inverse();
    for (int c = 0; c < 6; ++c) state.motion[motion_width * i + std::size_t(c)] = 0.0;
  }
}

/// Where the free bodies are and what pulls them, to see how stiff the motion since then was.
struct Look {
  Array<double> pose, nodes;
  Eigen::VectorXd force;
};

/// What the motion between two looks shows.
struct Seen {
  double frequency2 = 0.0;  // square of its circular frequency; not positive where it slid without resistance
  double work = 0.0;        // J, of the out-of-balance forces
};

Seen look_back(const Model& model, const State& state, const Unknowns& unknowns, const Look& before,
               const Eigen::VectorXd& force) {
  double relieved = 0.0, mass = 0.0;
  Seen seen;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    if (!unknowns.any(i)) continue;
    const Vector6 first = part_of(before.force, unknowns, i), last = part_of(force, unknowns, i);
    const Vector6 change = last - first, mean = 0.5 * (last + first);
    const double *p = &state.pose[pose_width * i], *o = &before.pose[pose_width * i];
    const Vec3 u(p[0] - o[0], p[1] - o[1], p[2] - o[2]);
    const Eigen::Quaterniond now = rotation_of(state, i);
    const Vec3 turn = 2.0 * (now * Eigen::Quaterniond(o[3], o[4], o[5], o[6]).conjugate()).vec();
    const Vec3 turn_own = now.conjugate() * turn;
    relieved -= u.dot(change.head<3>()) + turn.dot(change.tail<3>());
    seen.work += u.dot(mean.head<3>()) + turn.dot(mean.tail<3>());
    mass += model.bodies[i].inertial_mass * u.squaredNorm() + turn_own.dot(model.bodies[i].inertia * turn_own);
  }
  for (std::size_t i = 0; i < model.fill.nodes.size(); ++i) {
    const std::size_t site = model.bodies.size() + i;
    const Vector6 first = part_of(before.force, unknowns, site), last = part_of(force, unknowns, site);
    const Vec3 u = Vec3(&state.fill.pose[node_width * i]) - Vec3(&before.nodes[node_width * i]);
    relieved -= u.dot((last - first).head<3>());
    seen.work += 0.5 * u.dot((last + first).head<3>());
    mass += model.fill.inertial[i] * u.squaredNorm();
  }
  if (mass > 0.0) seen.frequency2 = relieved / mass;
  return seen;
}

/// A round of steps. The loads of the machine are updated before each step.
Advance pushed(Stepper& stepper, Machine& machine, const std::atomic<bool>* stop) {
  Advance last;
  for (std::int64_t i = 0; i < round_steps; ++i) {
    machine.push(*stepper.model, *stepper.state, stepper.loads);
    last = stepper.advance(stepper.state->step() + 1, 1, nullptr, stop);
    if (last.outcome != StepOutcome::reached) break;
  }
  return last;
}

}  // namespace

double body_displacement(const Model& model, const Array<double>& from, const Array<double>& to, std::size_t body) {
  const double *p = &from[pose_width * body], *q = &to[pose_width * body];
  const double u = Vec3(q[0] - p[0], q[1] - p[1], q[2] - p[2]).norm();
  const Vec3 turn =
      2.0 * (Eigen::Quaterniond(q[3], q[4], q[5], q[6]) * Eigen::Quaterniond(p[3], p[4], p[5], p[6]).conjugate()).vec();
  return u + turn.norm() * model.bodies[body].radius;
}

double largest_displacement(const Model& model, const Array<double>& from, const Array<double>& to) {
  double largest = 0.0;
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    largest = std::max(largest, body_displacement(model, from, to, i));
  return largest;
}

Equilibrium relax(Stepper& stepper, double tolerance, const RelaxationLimits& limits, const std::atomic<bool>* stop,
                  const std::function<void(std::int64_t, double)>& progress, Machine* machine) {
  State& state = *stepper.state;
  Model model = *stepper.model;  // as heavy as before, but with inertia of its own
  choose_inertia(false, state, model);
  if (machine) machine->brace(model);
  const Unknowns unknowns = number_unknowns(model);

  Stepper relaxing = stepper;
  relaxing.model = &model;
  relaxing.motion = nullptr;
  relaxing.damping = DampingAtWork{};
  relaxing.dt = model.fill.empty() ? 1.3 : 0.95;  // s of no meaning
  const double most_damped = 1.9 / relaxing.dt;
  if (limits.gently) relaxing.damping.mass_rate = most_damped;
  if (machine) relaxing.loads = at_share(machine->pattern, 0.0);
  relaxing.prepare();
  const std::int64_t first = state.step();
  const Array<double> start = state.pose;
  const double time = state.time();
  Array<double> latest = start;
  std::int64_t kept_at = round_steps;

  Equilibrium result;
  result.relaxed = true;
  const auto balance = [&] {
    if (machine) machine->push(model, state, relaxing.loads);
    return out_of_balance(relaxing, unknowns);
  };
  OutOfBalance now = balance();
  result.first_residual = now.largest;
  result.residual = limits.ramp_rounds > 0 ? std::max(now.largest, tolerance) : now.largest;
  result.earlier = start;
  // Soil that is overshot flows and tears its joints open: with a fill the weight comes on little by little.
  const Vec3 gravity = model.gravity;
  int round = model.fill.empty() || !limits.from_unloaded ? easing_rounds : 0, ramped = 0;
  const auto hopeless = [&](const Look& before) {
    return limits.hopeless && limits.hopeless(state, look_back(model, state, unknowns, before, now.force).work);
  };
  while (state.step() - first < limits.steps && !(stop && stop->load()) && result.residual >= tolerance) {
    const bool eases = round < easing_rounds;
    if (eases) {
      model.gravity = double(++round) / easing_rounds * gravity;
      now = balance();
    }
    const bool ramps = ramped < limits.ramp_rounds;
    if (ramps) {
      limits.ramp(double(++ramped) / limits.ramp_rounds);
      relaxing.loads = stepper.loads;
      now = balance();
    }
    const Look before = {state.pose, state.fill.pose, now.force};
    const Advance a =
        machine ? pushed(relaxing, *machine, stop) : relaxing.advance(state.step() + round_steps, 1, nullptr, stop);
    result.lost =
        a.outcome == StepOutcome::runaway || largest_displacement(model, start, state.pose) > limits.displacement;
    if (result.lost) break;
    if (state.step() - first >= 2 * kept_at) {  // every time the number of steps has doubled
      kept_at = state.step() - first;
      result.earlier = std::exchange(latest, state.pose);
    }
    if (a.outcome == StepOutcome::contacts) {
      const ContactUpdate update = update_contacts(model, state, relaxing.damping.branches, a.past, relaxing.threads);
      if (update.made + update.clipped > 0) choose_inertia(true, state, model);
      relaxing.prepare();
      now = balance();
      if ((result.lost = hopeless(before))) break;
      continue;
    }
    now = balance();
    result.residual = eases || ramps ? std::max(now.largest, tolerance) : now.largest;
    const Seen seen = look_back(model, state, unknowns, before, now.force);
    const double frequency = std::sqrt(std::clamp(seen.frequency2, 1e-8, 1.0));
    relaxing.damping.mass_rate = limits.gently ? std::min(3.0 * frequency, most_damped) : 1.2 * frequency;
    if ((result.lost = result.residual >= tolerance && hopeless(before))) break;
    if (progress) progress(state.step() - first, result.residual);
  }
  result.converged = result.residual < tolerance && !result.lost;
  result.steps = state.step() - first;
  state.step() = first;  // relaxation is no time
  state.time() = time;
  state.look_at() = state.grouped_at() = first;  // nor are its looks: who has moved is asked at the next step
  stop_motion(state);
  stepper.prepare();
  result.account = fmt::format(
      "dynamic relaxation {} after {}: out-of-balance force {:.2e} of an average block's weight",
      result.converged ? "converged" : "did not converge", counted(result.steps, "iteration"), result.residual);
  return result;
}

}  // namespace voussoir
