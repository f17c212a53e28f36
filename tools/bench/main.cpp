// voussoir-bench: how long a block and a step take, beside what the machine's memory could do at best.
#include <fmt/format.h>

#include <algorithm>
#include <boost/program_options.hpp>
#include <chrono>
#include <cstring>
#include <fstream>
#include <functional>
#include <iostream>
#include <nlohmann/json.hpp>

#include "geometry/generator.h"
#include "solver/base/error.h"
#include "solver/base/parallel.h"
#include "solver/base/program.h"
#include "solver/contact/search.h"
#include "solver/modal/equilibrium.h"
#include "solver/step/critical_step.h"

namespace voussoir {
namespace {

using Clock = std::chrono::steady_clock;
double seconds_since(Clock::time_point t) {
  return std::chrono::duration<double>(Clock::now() - t).count();
}

struct Scene {
  std::string name, help;
  std::function<Assembly()> build;
  double step = 0.0;  // s; 0: 0.8 × critical
  bool maxwell = false;
  bool shaken = false;
};

Assembly wall(int size, bool bonded) {
  const Generator& generator = find_generator("wall");
  GeneratorInput in = default_input(generator);
  in.values["length_blocks"] = in.values["courses"] = size;
  in.values["kn"] = 8.89e9;
  in.values["ks"] = 3.556e9;
  if (bonded) in.materials["masonry"].tensile_strength = in.materials["masonry"].cohesion = 1e6;
  return generator.build(in);
}

Assembly bridge(double scale) {
  const Generator& generator = find_generator("cs1");
  GeneratorInput in = default_input(generator);
  in.values["block_scale"] = scale;
  return generator.build(in);
}

const std::vector<Scene>& scenes() {
  static const std::vector<Scene> list = {
      {"wall-105", "dry wall of 105 blocks at rest", [] { return wall(10, false); }, 2.5e-5},
      {"wall-1040", "dry wall of 1040 blocks at rest", [] { return wall(32, false); }, 2.5e-5},
      {"wall-1040-bonded", "the same, bonded: all joints intact", [] { return wall(32, true); }, 2.5e-5},
      {"wall-1040-shaken", "dry wall of 1040 blocks under base motion, Maxwell damping", [] { return wall(32, false); },
       2.5e-5, true, true},
      {"cs1", "CS1 at full size under base motion, Maxwell damping", [] { return bridge(1.0); }, 0.0, true, true},
      {"cs1-2", "CS1 at block_scale = 2 under base motion, Maxwell damping", [] { return bridge(2.0); }, 0.0, true,
       true}};
  return list;
}

/// Bytes a second that a plain copy moves (read + write), best of five, on `threads` threads.
double copy_bandwidth(int threads) {
  const std::size_t n = 16u << 20;
  Array<double> from(n, 1.0), to(n, 0.0);
  double best = 0.0;
  for (int i = 0; i < 5; ++i) {
    const auto start = Clock::now();
    run_team(threads, [&](int thread, int team, Barrier&) {
      const Range r = share(n, thread, team);
      std::memcpy(&to[r.begin], &from[r.begin], (r.end - r.begin) * sizeof(double));
    });
    best = std::max(best, 2.0 * double(n * sizeof(double)) / seconds_since(start));
  }
  return best;
}

/// What a step reads and writes at least once, every array counted in full: batches, slip, branches, wrenches, poses,
/// motions; point tables for the share of patches that go point by point.
double bytes_per_step(const Model& model, const State& state, double points_share) {
  const auto bytes = [](const auto& array) { return double(array.size() * sizeof(array[0])); };
  const double once = bytes(model.batches) + bytes(model.batch_corners) + bytes(state.joint.mode);
  const double intact = 2.0 * (bytes(state.slip) + bytes(state.branch)) * (1.0 - points_share);
  const double points = (bytes(model.points) + 2.0 * (bytes(state.joint.point) + bytes(state.joint.broken) +
                                                      bytes(state.joint.point_branch))) *
                        points_share;
  const double wrenches =
      3.0 * 8.0 * wrench_width * double(model.joints.size() + state.contacts.size());  // written once, read twice
  const double bodies = 8.0 * double(model.bodies.size()) * (3.0 * pose_width + 2.0 * motion_width) +
                        double(sizeof(Body) * model.bodies.size());
  return once + intact + points + wrenches + bodies;
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

void settle(Stepper& stepper, bool quiet) {
  const Equilibrium newton = newton_equilibrium(stepper, 1e-6, nullptr, nullptr);
  if (newton.converged) return;
  const Equilibrium relaxed = relax(stepper, 1e-4, {.steps = 60000}, nullptr, nullptr);
  if (!quiet) fmt::print(stderr, "  {}\n", relaxed.account);
}

nlohmann::json run_scene(const Scene& scene, int threads, double wall_seconds, double bandwidth, bool quiet) {
  const Assembly assembly = scene.build();
  SolverSettings settings;
  const Model model = build_model(assembly, settings);
  State state = initial_state(model);
  const CriticalStep critical = critical_step(model, state);
  DampingSettings damping;
  damping.kind = scene.maxwell ? DampingSettings::Kind::maxwell : DampingSettings::Kind::none;
  Stepper stepper;
  stepper.model = &model;
  stepper.state = &state;
  stepper.threads = threads;
  stepper.dt = scene.step > 0.0 ? scene.step : 0.8 * critical.step * damping_step_factor(damping, critical.highest);
  stepper.prepare();
  settle(stepper, quiet);
  stepper.damping = damping_at_work(damping, stepper.dt, critical.highest);
  set_branches(model, state, stepper.damping.branches.count);
  const GroundMotion motion = scene.shaken ? shaking() : GroundMotion{};
  if (scene.shaken) stepper.motion = &motion;
  const std::size_t movable =
      std::count_if(model.bodies.begin(), model.bodies.end(), [](const Body& b) { return !b.fixed; });
  const auto piece = std::max<std::int64_t>(20, 2000000 / std::int64_t(movable));
  stepper.advance(state.step() + piece / 4, 1, nullptr, nullptr);  // warm caches, settled threads
  std::vector<double> times;
  std::int64_t intact = 0, points = 0, steps = 0;
  const auto start = Clock::now();
  stepper.search_distance = search_distance(model);
  while (times.size() < 3 || (seconds_since(start) < wall_seconds && times.size() < 200)) {
    const auto begin = Clock::now();
    const std::int64_t target = state.step() + piece;
    while (state.step() < target) {  // searches for contacts are part of the time
      const Advance a = stepper.advance(target, 1, nullptr, nullptr);
      if (a.outcome == StepOutcome::runaway) throw RunError("{}: the run went wrong", scene.name);
      intact += a.intact, points += a.points;
      if (a.outcome != StepOutcome::contacts) continue;
      update_contacts(model, state, stepper.damping.branches);
      stepper.prepare();
    }
    times.push_back(seconds_since(begin) / double(piece));
    steps += piece;
  }
  std::sort(times.begin(), times.end());
  const double step = times[times.size() / 2];
  const double share = double(intact) / double(std::max<std::int64_t>(1, intact + points));
  const double bytes = bytes_per_step(model, state, 1.0 - share);
  return {{"blocks", movable},
          {"joints", model.joints.size()},
          {"steps", steps},
          {"threads", threads},
          {"us_per_block_step", 1e6 * step / double(movable)},
          {"ns_per_joint_step", 1e9 * step / double(model.joints.size())},
          {"intact_share", share},
          {"bytes_per_step", bytes},
          {"copy_bandwidth", bandwidth},
          {"contacts", state.contacts.size()},
          {"limit_share", bytes / bandwidth / step},
          {"sim_seconds_per_wall_second", stepper.dt / step},
          {"time_step", stepper.dt}};
}

int run(int argc, char** argv) {
  namespace po = boost::program_options;
  po::options_description described("voussoir-bench [SCENE…] [--threads N]: microseconds a block and step");
  described.add_options()("help,h", "this text")("list", "the scenes")(
      "threads,j", po::value<int>()->default_value(1), "threads")("seconds", po::value<double>()->default_value(5.0),
                                                                  "least wall time a scene")(
      "output,o", po::value<std::string>()->default_value("."), "folder of bench.json")(
      "scene", po::value<std::vector<std::string>>(), "scenes (default: all)")("quiet,q", "no table");
  po::positional_options_description places;
  places.add("scene", -1);
  po::variables_map values;
  try {
    po::store(po::command_line_parser(argc, argv).options(described).positional(places).run(), values);
    po::notify(values);
  } catch (const po::error& e) {
    throw InputError("{}; see voussoir-bench --help", e.what());
  }
  if (values.count("help")) return std::cout << described << "\n", 0;
  if (values.count("list")) {
    for (const Scene& scene : scenes()) fmt::print("{:<18} {}\n", scene.name, scene.help);
    return 0;
  }
  std::vector<std::string> wanted;
  for (const Scene& scene : scenes()) wanted.push_back(scene.name);
  if (values.count("scene")) wanted = values["scene"].as<std::vector<std::string>>();
  const int threads = values["threads"].as<int>();
  if (threads < 1) throw InputError("--threads is {}; it must be at least 1", threads);
  const bool quiet = values.count("quiet") > 0;
  const double bandwidth = copy_bandwidth(threads);
  if (!quiet)
    fmt::print(
        "copy bandwidth {:.1f} GB/s on {} thread(s)\n{:<18} {:>7} {:>7} {:>8} {:>12} {:>12} {:>8} {:>10} {:>8} "
        "{:>10}\n",
        bandwidth / 1e9, threads, "scene", "blocks", "joints", "steps", "µs/block-st.", "ns/joint-st.", "intact",
        "MB/step", "of limit", "sim s/s");
  nlohmann::json all = nlohmann::json::object();
  for (const std::string& name : wanted) {
    const auto found = std::find_if(scenes().begin(), scenes().end(), [&](const Scene& s) { return s.name == name; });
    if (found == scenes().end()) throw InputError("unknown scene '{}'; voussoir-bench --list names them", name);
    const nlohmann::json r = all[name] = run_scene(*found, threads, values["seconds"].as<double>(), bandwidth, quiet);
    if (!quiet)
      fmt::print("{:<18} {:>7} {:>7} {:>8} {:>12.3f} {:>12.1f} {:>7.1f}% {:>10.2f} {:>7.1f}% {:>10.4f}\n", name,
                 r["blocks"].get<int>(), r["joints"].get<int>(), r["steps"].get<long>(),
                 r["us_per_block_step"].get<double>(), r["ns_per_joint_step"].get<double>(),
                 100 * r["intact_share"].get<double>(), 1e-6 * r["bytes_per_step"].get<double>(),
                 100 * r["limit_share"].get<double>(), r["sim_seconds_per_wall_second"].get<double>());
  }
  std::ofstream(values["output"].as<std::string>() + "/bench.json") << all.dump(2) << "\n";
  return 0;
}

}  // namespace
}  // namespace voussoir

int main(int argc, char** argv) {
  return voussoir::run_program("voussoir-bench", voussoir::run, argc, argv);
}
