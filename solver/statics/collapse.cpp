#include "solver/statics/collapse.h"

#include <fmt/format.h>

#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/statics/motion_watch.h"

namespace voussoir {

namespace {

/// What a patch's corners do between two placements, from its geometry alone.
struct Movement {
  double opening = 0.0, slip = 0.0;  // m: widest against closest corner; at the closest
  double s = 0.0, t = 0.0;           // m: middle of the corners that stay closest
};

Movement movement_of(const Array<double>& corners, const Patch& patch, const State& before, const State& after) {
  const auto at = [&](const State& state) {
    return patch_jump(patch, &state.pose[pose_width * std::size_t(patch.a)],
                      &state.pose[pose_width * std::size_t(patch.b)]);
  };
  const Jump<double> x = at(before), y = at(after);
  double least = 1e300, most = -1e300;
  std::vector<double> normal;
  for (int i = 0; i < patch.corner_count; ++i) {
    const PatchPoint c = patch_corner(patch, corners, i);
    normal.push_back(y.n - x.n + (y.rs - x.rs) * c.t - (y.rt - x.rt) * c.s);
    least = std::min(least, normal.back());
    most = std::max(most, normal.back());
  }
  Movement m;
  m.opening = most - least;
  int closed = 0;
  for (int i = 0; i < patch.corner_count; ++i) {
    if (normal[std::size_t(i)] > least + 0.1 * m.opening) continue;
    const PatchPoint c = patch_corner(patch, corners, i);
    m.s += c.s, m.t += c.t;
    ++closed;
  }
  m.s /= closed, m.t /= closed;
  m.slip = std::hypot(y.s - x.s - (y.rn - x.rn) * m.t, y.t - x.t + (y.rn - x.rn) * m.s);
  return m;
}

Vec3 place_on(const Patch& patch, double s, double t) {
  const Eigen::Quaterniond frame(patch.e_a[0], patch.e_a[1], patch.e_a[2], patch.e_a[3]);
  return Vec3(patch.place[0], patch.place[1], patch.place[2]) + frame * Vec3(0.0, s, t);
}

}  // namespace

std::vector<MechanismJoint> find_mechanism(const Model& model, const State& before, const State& after) {
  struct Found {
    const Patch* patch;
    Movement movement;
  };
  std::vector<Found> all;
  double largest = 0.0;
  const auto look = [&](const Patch& patch, const Array<double>& corners) {
    all.push_back({&patch, movement_of(corners, patch, before, after)});
    largest = std::max({largest, all.back().movement.opening, all.back().movement.slip});
  };
  for (std::size_t i = 0; i < model.joints.size(); ++i)
    if (!(before.joint.mode[i] & mode_gone) && model.joints[i].length == 0.0) look(model.joints[i], model.corners);
  for (std::size_t i = 0; i < before.contacts.size(); ++i)
    if (before.has_contact(i)) look(before.contacts[i], before.contact_corners);
  const double moved = largest_displacement(model, before.pose, after.pose);
  std::vector<MechanismJoint> mechanism;
  for (const Found& f : all) {
    const Movement& m = f.movement;
    if (std::max(m.opening, m.slip) < 0.1 * largest) continue;
    MechanismJoint joint;
    joint.a = model.block_of_body[std::size_t(f.patch->a)];
    joint.b = model.block_of_body[std::size_t(f.patch->b)];
    joint.slides = m.slip > m.opening;
    joint.place = place_on(*f.patch, m.s, m.t);
    joint.centre = place_on(*f.patch, 0.0, 0.0);
    joint.opening = m.opening / moved;
    joint.slip = m.slip / moved;
    mechanism.push_back(joint);
  }
  std::sort(mechanism.begin(), mechanism.end(),
            [](const MechanismJoint& x, const MechanismJoint& y) { return std::pair(x.a, x.b) < std::pair(y.a, y.b); });
  return mechanism;
}

namespace {

constexpr double takes_part = 0.1;    // of the largest displacement: less does not move
constexpr double local_share = 0.05;  // of the mass that can move: less is a local loss

CollapseLoss find_loss(const Model& model, const std::vector<char>& loaded, const State& before, const State& after) {
  double largest = largest_displacement(model, before.pose, after.pose), fill = 0.0;
  for (std::size_t i = 0; i < before.fill.pose.size(); i += node_width)
    fill = std::max(fill, (Vec3(&after.fill.pose[i]) - Vec3(&before.fill.pose[i])).norm());
  largest = std::max(largest, fill);
  CollapseLoss loss;
  loss.fill = fill > takes_part * largest;
  loss.loaded_only = !loaded.empty();
  double moving = 0.0, all = 0.0;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const Body& body = model.bodies[i];
    if (body.still()) continue;
    const double mass = body.fixed ? 0.0 : body.mass;  // a guided beam is no part of the masonry
    all += mass;
    if (body_displacement(model, before.pose, after.pose, i) < takes_part * largest) continue;
    moving += mass;
    loss.blocks.push_back(model.block_of_body[i]);
    loss.loaded_only = loss.loaded_only && loaded[i];
  }
  loss.share = all > 0.0 ? moving / all : 0.0;
  loss.local = loss.share < local_share || (loss.loaded_only && loss.share < 1.0);
  return loss;
}

/// Whether the rest stands when the moving part is held at its original position and its loads are removed.
bool rest_stands(Stepper stepper, State state, const CollapseLoss& loss, double tolerance,
                 const RelaxationLimits& limits, double distance, const std::atomic<bool>* stop) {
  Model held = *stepper.model;
  for (std::int64_t block : loss.blocks) {
    held.bodies[std::size_t(held.body_of_block[std::size_t(block)])].hold();
  }
  for (PointLoad& p : stepper.loads.points)
    if (held.bodies[std::size_t(p.body)].still()) p.from = p.to = Vec3::Zero();
  if (loss.fill) stepper.loads.nodes_from.clear(), stepper.loads.nodes_to.clear();
  stepper.model = &held;
  stepper.state = &state;
  stepper.prepare();
  const std::vector<char> none_loaded;
  MotionWatch watch(held, none_loaded, state, distance);
  RelaxationLimits own = limits;
  own.hopeless = [&](const State& now, double work) { return watch.hopeless(now, work); };
  return relax(stepper, tolerance, own, stop, nullptr).converged;
}

}  // namespace

Collapse find_collapse(Stepper& stepper, const CollapseSettings& settings, double tolerance,
                       const std::function<LoadsAtWork(double)>& loads, const std::atomic<bool>* stop,
                       const std::function<void(const CollapseTry&, double residual)>& progress) {
  Collapse result;
  const Model& model = *stepper.model;
  const double distance = settings.displacement * model.typical_size;
  const LoadsAtWork pattern = pattern_between(loads(0.0), loads(settings.to));
  const std::vector<char> loaded = bodies_loaded(model, pattern);
  State start = *stepper.state;
  RelaxationLimits limits;
  limits.steps = 200000;
  limits.from_unloaded = false;
  const auto stands = [&](double multiplier) {
    stepper.loads = loads(multiplier);
    stepper.prepare();
    CollapseTry one = {multiplier, false, 0};
    const State from = *stepper.state;
    MotionWatch watch(model, loaded, from, distance);
    limits.hopeless = [&](const State& state, double work) { return watch.hopeless(state, work); };
    const Equilibrium e = relax(stepper, tolerance, limits, stop, [&](std::int64_t step, double residual) {
      one.steps = step;
      if (progress) progress(one, residual);
    });
    one.stands = e.converged;
    one.steps = e.steps;
    result.tries.push_back(one);
    if (!e.converged) return false;
    if (result.curve.empty()) start = *stepper.state;
    result.curve.push_back(
        {multiplier, pattern_displacement(model, *stepper.state, pattern) - pattern_displacement(model, start, pattern),
         largest_displacement(model, start.pose, stepper.state->pose),
         largest_displacement(model, from.pose, stepper.state->pose) > distance});
    return true;
  };
  const auto stopped = [&] { return stop && stop->load(); };

  if (!stands(0.0) && !stopped())
    throw RunError(
        "there is no equilibrium even without the load pattern of the collapse stage. Begin with a gravity stage.");
  State good = *stepper.state, lost = good;
  double increment = settings.to / 16.0;
  while (!stopped() && result.multiplier < settings.to) {
    const double multiplier = std::min(result.multiplier + increment, settings.to);
    *stepper.state = good;
    if (stands(multiplier)) {
      good = *stepper.state;
      result.multiplier = multiplier;
      continue;
    }
    if (stopped()) break;
    lost = *stepper.state;
    result.above = multiplier;
    result.found = increment <= settings.tolerance;
    if (result.found) break;
    increment *= 0.5;
  }
  if (!stopped()) result.last = forces_at_rest(model, good);
  *stepper.state = result.found ? lost : good;
  stepper.prepare();
  if (result.found) {
    result.mechanism = find_mechanism(model, good, lost);
    result.loss = find_loss(model, loaded, good, lost);
    if (result.loss.local)
      result.loss.rest_stands = rest_stands(stepper, good, result.loss, tolerance, limits, distance, stop);
  }
  result.account = result.found
                       ? fmt::format("equilibrium is lost between multipliers {:.5g} and {:.5g}, after {}",
                                     result.multiplier, result.above, counted(result.tries.size(), "try", "tries"))
                       : fmt::format("the assembly still stands at a multiplier of {:.5g}", result.multiplier);
  return result;
}

}  // namespace voussoir
