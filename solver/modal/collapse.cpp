#include "solver/modal/collapse.h"

#include <fmt/format.h>

#include "solver/base/error.h"

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

std::string edge_name(const Assembly& assembly, const MechanismJoint& joint) {
  const Block &a = assembly.blocks[std::size_t(joint.a)], &b = assembly.blocks[std::size_t(joint.b)];
  if (joint.slides || (a.component != Component::arch && b.component != Component::arch)) return {};
  const std::int32_t part = a.component == Component::arch ? a.part : b.part;
  Vec3 low = Vec3::Constant(1e300), high = Vec3::Constant(-1e300);
  for (const Block& block : assembly.blocks)
    if (block.component == Component::arch && block.part == part)
      low = low.cwiseMin(block.centroid), high = high.cwiseMax(block.centroid);
  const Vec3 feet(0.5 * (low.x() + high.x()), 0.5 * (low.y() + high.y()), low.z());
  const Vec3 out = Vec3(1, 0, 1).cwiseProduct(joint.centre - feet);
  return (joint.place - joint.centre).dot(out) > 0.0 ? "extrados" : "intrados";
}

/// To the millimetre, and never −0.
double rounded(double x) {
  return std::round(1e3 * x) / 1e3 + 0.0;
}

std::string mechanism_text(const Assembly& assembly, const std::vector<MechanismJoint>& mechanism) {
  if (mechanism.empty()) return "no mechanism: no joint moves";
  std::size_t slides = 0;
  for (const MechanismJoint& joint : mechanism) slides += joint.slides;
  std::string text = fmt::format("mechanism: {} joints hinge, {} slide", mechanism.size() - slides, slides);
  if (mechanism.size() > 12) return text;
  for (const MechanismJoint& joint : mechanism) {
    const std::string edge = edge_name(assembly, joint);
    text += fmt::format("\n  blocks {} and {} {} at ({:.3f}, {:.3f}, {:.3f}) m{}", joint.a, joint.b,
                        joint.slides ? "slide" : "hinge", rounded(joint.place.x()), rounded(joint.place.y()),
                        rounded(joint.place.z()), edge.empty() ? "" : ", " + edge);
  }
  return text;
}

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

Collapse find_collapse(Stepper& stepper, const CollapseSettings& settings, double tolerance,
                       const std::function<LoadsAtWork(double)>& loads, const std::atomic<bool>* stop,
                       const std::function<void(const CollapseTry&, double residual)>& progress) {
  Collapse result;
  const RelaxationLimits limits = {200000, settings.displacement * stepper.model->typical_size};
  const auto stands = [&](double multiplier) {
    stepper.loads = loads(multiplier);
    stepper.prepare();
    CollapseTry one = {multiplier, false, 0};
    const Equilibrium e = relax(stepper, tolerance, limits, stop, [&](std::int64_t step, double residual) {
      one.steps = step;
      if (progress) progress(one, residual);
    });
    one.stands = e.converged;
    one.steps = e.steps;
    result.tries.push_back(one);
    return e.converged;
  };
  const auto stopped = [&] { return stop && stop->load(); };

  if (!stands(0.0) && !stopped())
    throw RunError(
        "there is no equilibrium even without the pattern of the collapse stage: begin with a gravity stage");
  State good = *stepper.state, lost = good;
  double increment = 0.25 * settings.to;
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
  *stepper.state = result.found ? lost : good;
  stepper.prepare();
  if (result.found) result.mechanism = find_mechanism(*stepper.model, good, lost);
  result.account = result.found
                       ? fmt::format("equilibrium is lost between multipliers {:.5g} and {:.5g}, after {} tries",
                                     result.multiplier, result.above, result.tries.size())
                       : fmt::format("the assembly still stands at a multiplier of {:.5g}", result.multiplier);
  return result;
}

}  // namespace voussoir
