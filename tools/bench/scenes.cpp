#include "tools/bench/scenes.h"

#include <fmt/format.h>

#include <chrono>
#include <cmath>
#include <filesystem>

#include "geometry/generator.h"
#include "io/hdf5/checkpoint_file.h"
#include "solver/base/error.h"
#include "solver/base/timed.h"
#include "solver/contact/grouping.h"
#include "solver/contact/search.h"
#include "solver/statics/equilibrium.h"
#include "solver/step/critical_step.h"
#include "tools/bench/machine.h"

namespace voussoir {

namespace {

using Clock = std::chrono::steady_clock;

Assembly wall(int length, int courses, double strength, double friction) {
  const Generator& generator = find_generator("wall");
  GeneratorInput in = default_input(generator);
  in.values["length_blocks"] = length;
  in.values["courses"] = courses;
  in.values["kn"] = 8.89e9;
  in.values["ks"] = 3.556e9;
  Material& masonry = in.materials["masonry"];
  masonry.tensile_strength = masonry.cohesion = strength;
  if (friction > 0.0) masonry.friction_angle = friction;
  return generator.build(in);
}

Assembly dry(int size) {
  return wall(size, size, 0.0, 0.0);
}

Assembly bridge(const char* name, double scale, const char* backfill = "") {
  const Generator& generator = find_generator(name);
  GeneratorInput in = default_input(generator);
  in.values["block_scale"] = scale;
  in.values["abutment_leaf_length"] = 1.5;  // the value of cs1 when the scenes were made; it keeps results comparable
  if (*backfill) in.choices["backfill"] = backfill;
  return generator.build(in);
}

std::vector<Scene> make_scenes() {
  std::vector<Scene> list;
  const auto add = [&](const char* name, const char* help, std::function<Assembly(double)> build) -> Scene& {
    Scene scene;
    scene.name = name, scene.help = help, scene.build = std::move(build);
    list.push_back(std::move(scene));
    return list.back();
  };
  const auto thin = [](Scene& s) -> Scene& { return s.step = 2.5e-5, s; };
  const auto shake = [](Scene& s) -> Scene& { return s.maxwell = s.shaken = true, s; };
  thin(add("wall-105", "dry wall of 105 blocks at rest", [](double) { return dry(10); }));
  thin(add("wall-1040", "dry wall of 1040 blocks at rest", [](double) { return dry(32); }));
  thin(add("wall-1040-bonded", "wall of 1040 blocks with bonded joints: all joints intact",
           [](double) { return wall(32, 32, 1e6, 0.0); }));
  thin(add("wall-1040-damped", "wall of 1040 blocks with bonded joints, Maxwell damping", [](double) {
    return wall(32, 32, 1e6, 0.0);
  })).maxwell = true;
  Scene& sliding =
      thin(add("wall-1040-sliding", "wall with almost no friction under base motion: all joints slide or open",
               [](double) { return wall(32, 32, 0.0, 0.002); }));
  sliding.shaken = true, sliding.settled = false, sliding.before = 0.01;
  shake(thin(add("wall-1040-shaken", "dry wall of 1040 blocks under base motion, Maxwell damping",
                 [](double) { return dry(32); })));
  add("wall-10k", "bonded wall of 10 000 blocks", [](double) { return wall(100, 100, 1e6, 0.0); });
  add("wall-100k", "bonded wall of 100 000 blocks", [](double) { return wall(316, 316, 1e6, 0.0); });
  add("wall-500k", "bonded wall of 500 000 blocks", [](double) { return wall(707, 707, 1e6, 0.0); });
  const auto cs1 = [](double scale) { return bridge("cs1", scale); };
  shake(add("cs1", "CS1 under a base motion that damages it, with Maxwell damping (cs1@0.5: block_scale = 0.5)", cs1))
      .before = 1.0;
  const auto filled = [](double scale) { return bridge("cs1", scale, "deformable"); };
  shake(add("cs1-fill", "CS1 with its fill as a continuum, under a base motion that damages it, with Maxwell damping",
            filled))
      .before = 1.0;
  add("cs1-fill-rest", "CS1 with its fill as a continuum, unloaded, without damping or equilibrium", filled).settled =
      false;
  add("cs1-rest", "CS1 unloaded, without damping or equilibrium, for measurements of size (cs1-rest@0.33)", cs1)
      .settled = false;
  Scene& coarse =
      shake(add("cs1-2", "CS1 with block_scale = 2 under a base motion that damages it, with Maxwell damping", cs1));
  coarse.scale = 2.0, coarse.before = 1.0;
  return list;
}

GroundMotion shaking() {
  GroundMotion motion;
  motion.dt = 0.005;
  for (int i = 0; i <= 4000; ++i) {
    const double t = 0.005 * i;
    motion.acceleration.push_back(
        {2.5 * std::sin(9.0 * t) * std::sin(2.1 * t), 2.5 * std::sin(11.0 * t) * std::cos(1.7 * t), 0.0});
  }
  return motion;
}

std::string settle(Stepper& stepper) {
  if (stepper.model->fill.empty()) {
    const Equilibrium newton = newton_equilibrium(stepper, 1e-6, nullptr, nullptr);
    if (newton.converged) return newton.account;
  }
  return relax(stepper, 1e-4, {.steps = 60000}, nullptr, nullptr).account;
}

}  // namespace

const std::vector<Scene>& scenes() {
  static const std::vector<Scene> list = make_scenes();
  return list;
}

Scene find_scene(const std::string& name) {
  const std::size_t at = name.find('@');
  for (Scene scene : scenes()) {
    if (scene.name != name.substr(0, at)) continue;
    if (at == std::string::npos) return scene;
    char* end = nullptr;
    scene.scale = std::strtod(name.c_str() + at + 1, &end);
    if (*end != '\0' || !(scene.scale > 0.0))
      throw InputError("scene '{}': the block_scale is '{}'. It must be a positive number, as in cs1@0.5", name,
                       name.substr(at + 1));
    scene.name = name;
    return scene;
  }
  throw InputError("unknown scene '{}'. voussoir-bench --list names all scenes", name);
}

namespace {

/// Restores the state of a scene that the same program has stored.
void recall(const std::string& path, Running& r) {
  CheckpointHeader header;
  const std::size_t bodies = r.state.pose.size(), joints = r.state.joint.mode.size();
  read_checkpoint(path, header, r.state.arrays());
  if (r.state.pose.size() != bodies || r.state.joint.mode.size() != joints)
    throw InputError("{} belongs to another assembly than the scene. Remove the file", path);
  r.state.unpack(r.model);
  take_joint_order(r.model, r.state);
  r.stepper.prepare();
  r.account = "started from " + path;
}

}  // namespace

std::unique_ptr<Running> begin_scene(const Scene& scene, int threads, const std::string& keep) {
  if (!keep.empty()) std::filesystem::create_directories(keep);  // first, because the scene may take minutes
  auto running = std::make_unique<Running>();
  Running& r = *running;
  auto begin = Clock::now();
  r.assembly = scene.build(scene.scale);
  r.generation = seconds_since(begin);
  begin = Clock::now();
  r.model = build_model(r.assembly, SolverSettings{});
  r.state = initial_state(r.model);
  r.modelling = seconds_since(begin);
  begin = Clock::now();
  const CriticalStep critical = critical_step(r.model, r.state);
  r.choosing = seconds_since(begin);
  DampingSettings damping;
  damping.kind = scene.maxwell ? DampingSettings::Kind::maxwell : DampingSettings::Kind::none;
  r.stepper.model = &r.model;
  r.stepper.state = &r.state;
  r.stepper.threads = threads;
  r.stepper.dt = scene.step > 0.0 ? scene.step : 0.8 * critical.step * damping_step_factor(damping, critical.highest);
  begin = Clock::now();
  update_contacts(r.model, r.state, {}, true, threads);
  r.stepper.prepare();
  r.search = seconds_since(begin);
  const DampingAtWork at_work = damping_at_work(damping, r.stepper.dt, critical.highest);
  r.motion = shaking();
  const std::string path = keep.empty() ? "" : fmt::format("{}/{}.h5", keep, scene.name);
  const bool kept = !path.empty() && std::filesystem::exists(path);
  begin = Clock::now();
  if (scene.settled && !kept) r.account = settle(r.stepper);
  r.equilibrium = seconds_since(begin);
  set_branches(r.model, r.state, at_work.branches.count);
  if (kept) recall(path, r);
  r.stepper.damping = at_work;
  r.stepper.search_distance = search_distance(r.model);
  if (scene.shaken) r.stepper.motion = &r.motion;
  if (!kept) advance_scene(r, std::int64_t(std::ceil(scene.before / r.stepper.dt)));
  if (!kept && !path.empty()) write_checkpoint(path, {}, r.state.arrays());
  return running;
}

Progressed advance_scene(Running& r, std::int64_t steps) {
  Progressed p;
  const double processor = processor_time();
  const auto begin = Clock::now();
  const std::int64_t from = r.state.step(), target = from + steps;
  while (r.state.step() < target) {
    const Advance a = r.stepper.advance(target, 1, nullptr, nullptr);
    if (a.outcome == StepOutcome::runaway) throw RunError("the run failed at time step {}", r.state.step());
    p.intact += a.intact, p.points += a.points;
    if (a.outcome != StepOutcome::contacts) continue;
    const auto searching = Clock::now();
    const ContactUpdate update =
        update_contacts(r.model, r.state, r.stepper.damping.branches, a.past, r.stepper.threads);
    const bool groups = r.state.step() - r.state.grouped_at() >= grouping_interval;
    if (groups) group_patches(r.model, r.state, r.stepper.threads);
    if (update.changed() || groups) r.stepper.prepare_contacts();
    p.examined += update.examined, p.changed += update.changed(), p.listed += update.listed;
    p.search_seconds += seconds_since(searching);
    ++p.searches;
  }
  p.steps = r.state.step() - from;
  p.seconds = seconds_since(begin);
  p.processor_seconds = processor_time() - processor;
  return p;
}

}  // namespace voussoir
