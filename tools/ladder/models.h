// Models, and a stepper that the caller advances, for the rungs of the ladder and the tests of the solver.
#pragma once
#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "geometry/generator.h"
#include "geometry/joints.h"
#include "solver/base/constants.h"
#include "solver/contact/make_contact.h"
#include "solver/contact/search.h"
#include "solver/modal/modes.h"
#include "solver/statics/equilibrium.h"
#include "solver/step/critical_step.h"
#include "solver/step/energy.h"
#include "solver/step/stepper.h"

namespace voussoir::ladder {

/// A joint without strength limits.
inline JointLaw elastic_law() {
  JointLaw law;
  law.kind = JointLaw::Kind::elastic;
  return law;
}

/// No bond, friction only.
inline JointLaw dry_law(double friction_coefficient) {
  JointLaw law;
  law.friction_angle = law.residual_friction_angle = std::atan(friction_coefficient);
  return law;
}

/// An empty assembly of one material, whose moduli are used by contacts found during a run.
inline Assembly stone(double density = 2000.0, double youngs = 1e9, double friction_coefficient = 0.6) {
  Assembly assembly;
  assembly.generator = "test";
  assembly.materials = {{"stone", density, youngs, 0.4 * youngs, 0.0, 0.0, std::atan(friction_coefficient)}};
  return assembly;
}

inline void add_block(Assembly& assembly, Polyhedron shape, bool fixed = false) {
  Block block;
  block.cells = {std::move(shape)};
  block.fixed = fixed;
  block.component = fixed ? Component::base : Component::block;
  assembly.blocks.push_back(std::move(block));
}

inline void add_box(Assembly& assembly, const Vec3& low, const Vec3& high, bool fixed = false) {
  add_block(assembly, make_box(low, high), fixed);
}

/// Finishes the blocks, finds the joints and gives all of them the same law.
inline Assembly joined(Assembly assembly, double kn, double ks, const JointLaw& law) {
  finish_blocks(assembly);
  find_joints(assembly);
  assembly.laws = {law};
  for (Joint& joint : assembly.joints) joint.kn = kn, joint.ks = ks, joint.law = 0;
  return assembly;
}

/// The assembly of a generator with some of its keys set.
inline Assembly generated(const std::string& name, const std::map<std::string, double>& values) {
  const Generator& generator = find_generator(name);
  GeneratorInput input = default_input(generator);
  for (const auto& [key, value] : values) input.values.at(key) = value;
  return generator.build(input);
}

inline void set_law(Assembly& assembly, const JointLaw& law) {
  assembly.laws = {law};
  for (Joint& joint : assembly.joints) joint.law = 0;
}

/// Bond and friction so weak that displacements of 0.1 mm break the bond at a stiffness of about 1e9 Pa/m.
inline JointLaw weak_bond() {
  JointLaw law;
  law.tension = 1e5, law.cohesion = 1.5e5;
  law.friction_angle = law.residual_friction_angle = radians(35.0);
  return law;
}

/// A wall that a strong motion destroys.
inline Assembly weak_wall(int length, int courses) {
  Assembly assembly = generated("wall", {{"length_blocks", length}, {"courses", courses}, {"kn", 4e9}, {"ks", 1.6e9}});
  JointLaw law = dry_law(0.6);
  law.tension = 2e4, law.cohesion = 3e4;
  set_law(assembly, law);
  return assembly;
}

/// The same wall with composite joints so soft that the motion crushes them too.
inline Assembly crushing_wall(int length, int courses) {
  Assembly assembly = weak_wall(length, courses);
  JointLaw law = assembly.laws[0];
  law.kind = JointLaw::Kind::composite;
  law.fracture_energy = {1.0, 5.0};
  law.residual_friction_angle = std::atan(0.5), law.dilation_angle = std::atan(0.2), law.dilation_length = 1e-3;
  law.compressive_strength = 3e5, law.compressive_energy = 100.0;
  set_law(assembly, law);
  return assembly;
}

/// Settings without damping.
inline SolverSettings undamped(const Vec3& gravity = Vec3::Zero()) {
  SolverSettings settings;
  settings.gravity = gravity;
  settings.damping.kind = DampingSettings::Kind::none;
  return settings;
}

/// Validation ladder: a chain of 10 (or more) blocks of 1 × 1 × 0.4 m for axial waves.
inline Assembly axial_chain_of(int blocks) {
  Assembly assembly = generated("column", {{"blocks", blocks}, {"block_height", 0.4}, {"kn", 4e9}, {"ks", 1.6e9}});
  set_law(assembly, elastic_law());
  return assembly;
}

/// Validation ladder: a column of 1 × 1 × 8 m in the given number of blocks, with kn h = 1.6e9 and ks h = 0.64e9 Pa.
inline Assembly bending_column_of(int blocks) {
  const double h = 8.0 / blocks;
  Assembly assembly =
      generated("column", {{"blocks", blocks}, {"block_height", h}, {"kn", 1.6e9 / h}, {"ks", 0.64e9 / h}});
  set_law(assembly, elastic_law());
  return assembly;
}

/// A block of three different sides; the second axis is the intermediate one.
inline Assembly asymmetric_block() {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, 0}, {0.5, 1.0, 2.0});
  return joined(std::move(assembly), 1e9, 1e9, elastic_law());
}

/// Corners of a random convex polygon in the plane z = 0, counter-clockwise: points of a circle, stretched and sheared.
inline Polygon random_polygon(int corners, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  Polygon polygon;
  for (int i = 0; i < corners; ++i) {
    const double angle = 2 * pi * (i + 0.8 * unit(random)) / corners;
    polygon.emplace_back(std::cos(angle), std::sin(angle), 0.0);
  }
  const double stretch = 0.4 + unit(random), shear = unit(random) - 0.5, x = 2 * unit(random), y = 2 * unit(random);
  for (Vec3& p : polygon) p = Vec3(stretch * p.x() + shear * p.y() + x, p.y() + y, 0.0);
  return polygon;
}

inline Eigen::Quaterniond random_rotation(std::mt19937& random) {
  std::normal_distribution<double> normal;
  return Eigen::Quaterniond(normal(random), normal(random), normal(random), normal(random)).normalized();
}

inline Vec3 random_vector(double scale, std::mt19937& random) {
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  return scale * Vec3(unit(random), unit(random), unit(random));
}

/// Model, state and stepper in one object. The caller advances them. Block numbers are those of the assembly.
class Bench {
 public:
  explicit Bench(Assembly a, const SolverSettings& s = undamped())
      : assembly(std::move(a)), settings(s), model(build_model(assembly, s)), state(initial_state(model)) {
    stepper.model = &model;
    stepper.state = &state;
    stepper.shortcut = s.step.intact_shortcut;
    stepper.prepare();
  }
  Bench(const Bench&) = delete;
  Bench& operator=(const Bench&) = delete;

  /// Chooses the time step and initialises the damping of the settings; dt = 0: 0.8 of the critical time step.
  void begin(double dt = 0.0) {
    const CriticalStep critical = critical_step(model, state);
    if (dt == 0.0) dt = 0.8 * critical.step * damping_step_factor(settings.damping, critical.highest);
    const DampingAtWork damping = damping_at_work(settings.damping, dt, critical.highest);
    set_branches(model, state, damping.branches.count);
    stepper.damping = damping;
    stepper.dt = dt;
    stepper.search_distance = search_distance(model);
  }

  /// Newton iteration under gravity, down to the given residual.
  Equilibrium balance(double tolerance = 1e-10) { return newton_equilibrium(stepper, tolerance, nullptr, nullptr); }

  /// Advances in time, with contact detection if asked for. Returns false if the motion grew without limit.
  bool run(std::int64_t steps, std::int64_t every = 1, const std::function<void(const BodyPass&)>& sample = nullptr) {
    const std::int64_t target = state.step() + steps;
    while (state.step() < target) {
      const Advance a = stepper.advance(target, every, sample, nullptr);
      if (a.outcome == StepOutcome::runaway) return false;
      if (a.outcome != StepOutcome::contacts) continue;
      update_contacts(model, state, stepper.damping.branches);
      stepper.prepare();
    }
    return true;
  }

  std::int32_t body(std::int64_t block) const { return model.body_of_block[std::size_t(block)]; }
  double* pose(std::int64_t block) { return &state.pose[pose_width * std::size_t(body(block))]; }
  double* motion(std::int64_t block) { return &state.motion[motion_width * std::size_t(body(block))]; }
  Vec3 displacement(std::int64_t block) { return Eigen::Map<Vec3>(pose(block)); }
  Vec3 velocity(std::int64_t block) { return Eigen::Map<Vec3>(motion(block)); }
  Vec3 momentum(std::int64_t block) { return Eigen::Map<Vec3>(motion(block) + 3); }
  Eigen::Quaterniond rotation(std::int64_t block) {
    const double* p = pose(block);
    return {p[3], p[4], p[5], p[6]};
  }
  void place(std::int64_t block, const Vec3& displacement, const Eigen::Quaterniond& rotation) {
    double* p = pose(block);
    for (int c = 0; c < 3; ++c) p[c] = displacement[c];
    p[3] = rotation.w(), p[4] = rotation.x(), p[5] = rotation.y(), p[6] = rotation.z();
  }
  /// Rotates the block about a point of the reference position.
  void turn_about(std::int64_t block, const Vec3& centre, const Eigen::Quaterniond& rotation) {
    const Vec3 arm = assembly.blocks[std::size_t(block)].centroid - centre;
    place(block, rotation * arm - arm, rotation);
  }
  void push(std::int64_t block, const Vec3& velocity, const Vec3& spin = Vec3::Zero()) {
    const Mat3 r = rotation(block).toRotationMatrix();
    const Vec3 l = r * model.bodies[std::size_t(body(block))].inertia * r.transpose() * spin;
    for (int c = 0; c < 3; ++c) motion(block)[c] = velocity[c], motion(block)[3 + c] = l[c];
  }

  /// Force and moment about a point that patch `index` exerts on the given block, after a patch pass.
  std::pair<Vec3, Vec3> wrench_on(std::int64_t block, std::size_t index, const Vec3& about) const {
    const Patch& patch =
        index < model.joints.size() ? model.joints[index] : state.contacts[index - model.joints.size()];
    const double* w = &stepper.wrenches[wrench_width * index];
    const double sign = patch.a == body(block) ? 1.0 : -1.0;
    const Vec3 force = sign * Vec3(w[0], w[1], w[2]), moment = sign * Vec3(w[3], w[4], w[5]);
    return {force, moment - about.cross(force)};
  }

  /// Largest overlap (m, positive) of the cells of two blocks at their present positions.
  double overlap(std::int64_t one, std::int64_t two) const {
    const Convex a = placed_cell(model, state, body(one), 0), b = placed_cell(model, state, body(two), 0);
    return std::max(0.0, -separation(a, b, 0.0));
  }

  Assembly assembly;
  SolverSettings settings;
  Model model;
  State state;
  Stepper stepper;
};

/// The modes of the intact assembly in its present position.
inline std::vector<Mode> modes_of(const Bench& bench, int count) {
  return find_modes(bench.assembly, bench.model, bench.state, count, PatchTangent::intact).modes;
}

/// Whether a mode has more than 99 % of its kinetic energy in displacements along an axis (0, 1, 2).
inline bool moves_along(const Bench& bench, const Mode& mode, int axis) {
  double along = 0.0;
  for (std::size_t i = 0; i < bench.assembly.blocks.size(); ++i)
    along += bench.assembly.blocks[i].mass * std::pow(mode.shape(Eigen::Index(i), axis), 2);
  return along > 0.99 * mode.modal_mass;
}

/// Displaces the blocks by a mode whose largest displacement is `largest` (m).
inline void displace(Bench& bench, const Mode& mode, double largest) {
  for (std::int64_t block = 0; block < mode.shape.rows(); ++block) {
    const Vec3 turn = 0.5 * largest * mode.shape.row(block).tail<3>();
    bench.place(block, largest * mode.shape.row(block).head<3>(), {1.0, turn.x(), turn.y(), turn.z()});
  }
}

}  // namespace voussoir::ladder
