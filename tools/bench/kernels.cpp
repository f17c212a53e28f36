// voussoir-bench-kernels: measures the kernels of a time step one by one with Google Benchmark. Positions do not
// change, so joints that are computed point by point are closed and stick.
#include <benchmark/benchmark.h>

#include <cmath>
#include <map>

#include "solver/contact/search.h"
#include "solver/step/energy.h"
#include "tools/bench/machine.h"
#include "tools/bench/phases.h"
#include "tools/ladder/fill_rig.h"

namespace voussoir {
namespace {

Running& wall(const char* name) {
  static std::map<std::string, std::unique_ptr<Running>> made;
  std::unique_ptr<Running>& scene = made[name];
  if (!scene) scene = begin_scene(find_scene(name), 1);
  return *scene;
}

PatchPass pass_of(Running& r, int branches, bool shortcut) {
  set_branches(r.model, r.state, branches);
  PatchPass pass;
  pass.model = &r.model;
  pass.state = &r.state;
  pass.branches.count = branches;
  for (int k = 0; k < branches; ++k) pass.branches.e[k] = 0.99, pass.branches.g[k] = 0.02;
  pass.sums = r.stepper.sums.data();
  pass.contact_wrenches = r.stepper.contact_wrenches.data();
  pass.shortcut = shortcut;
  return pass;
}

/// Reports items, bytes and operations, and the share of the machine's limit that they reach: the limit of copies
/// within `memory` bytes or of multiply–adds, whichever takes longer.
void report(benchmark::State& timing, double items, const Work& work, double memory) {
  static const double peak = multiply_add_peak(1);
  static std::map<double, double> bandwidths;
  if (!bandwidths.count(memory)) bandwidths[memory] = copy_bandwidth(memory, 1);
  const double all = double(timing.iterations()) * items;
  timing.SetItemsProcessed(std::int64_t(all));
  timing.SetBytesProcessed(std::int64_t(all * work.bytes));
  timing.counters["op/s"] = benchmark::Counter(all * work.operations, benchmark::Counter::kIsRate);
  const double least = std::max(work.bytes / bandwidths[memory], work.operations / peak);
  timing.counters["of_limit"] = benchmark::Counter(all * least, benchmark::Counter::kIsRate);
}

void joints(benchmark::State& timing, const char* name, bool shortcut) {
  Running& r = wall(name);
  const int branches = int(timing.range(0));
  const PatchPass pass = pass_of(r, branches, shortcut);
  for ([[maybe_unused]] auto _ : timing)
    for (std::size_t tile = 0; tile < r.model.tiles.size(); ++tile) benchmark::DoNotOptimize(pass.joints(tile));
  const double items = double(r.model.joints.size());
  const Work work = shortcut ? intact_work(branches) : points_work(branches, 9.0, true);
  report(timing, items, work, items * work.bytes);
}

/// A box of soil under pressure in all directions and alternating shear: either so little that no tetrahedron yields,
/// or so much that all yield in every pass.
struct Soil {
  FillModel model;
  FillMemory memory;
  Array<double> sums, volume_sums;
  FillPass pass;
  Array<double> other;  // the positions of every second pass

  Soil(int cells, double shear, int branches) : model(box(cells)), memory(initial_fill(model)) {
    set_fill_branches(model, memory, branches);
    sums.resize(node_width * model.sum_count()), volume_sums.resize(model.sum_count());
    other = memory.pose;
    for (std::size_t i = 0; i < model.nodes.size(); ++i) {
      const Vec3& x = model.nodes[i];
      for (std::size_t c = 0; c < 3; ++c)
        memory.pose[node_width * i + c] = other[node_width * i + c] = -1e-4 * x[Eigen::Index(c)];
      memory.pose[node_width * i] += shear * x.z(), other[node_width * i] -= shear * x.z();
    }
    pass.fill = &model, pass.memory = &memory;
    pass.sums = sums.data(), pass.volume_sums = volume_sums.data();
    pass.branches.count = branches;
    for (int k = 0; k < branches; ++k) pass.branches.e[k] = 0.99, pass.branches.g[k] = 0.02;
  }

  static FillModel box(int cells) {
    Assembly assembly;
    Material soil;
    soil.name = "soil", soil.density = 1800.0, soil.youngs_modulus = 300e6, soil.shear_modulus = 120e6;
    soil.friction_angle = 0.6, soil.cohesion = 1e3, soil.tensile_strength = 1e3;
    assembly.materials = {soil};
    assembly.fill = ladder::box_mesh(Vec3::Zero(), 0.3 * Vec3(cells, cells, cells), cells, cells, cells);
    assembly.fill.material.assign(assembly.fill.tets.size(), 0);
    return build_fill(assembly);
  }

  std::int64_t step() {
    std::swap(memory.pose, other);
    for (std::size_t tile = 0; tile < model.tiles.size(); ++tile) pass.volumes(tile);
    for (std::size_t tile = 0; tile < model.tiles.size(); ++tile) pass.means(tile);
    std::int64_t yielding = 0;
    for (std::size_t tile = 0; tile < model.tiles.size(); ++tile) yielding += pass.stresses(tile).yielding;
    return yielding;
  }
};

void tetrahedra(benchmark::State& timing, double shear) {
  const int cells = int(timing.range(0)), branches = int(timing.range(1));
  Soil soil(cells, shear, branches);
  soil.step();
  std::int64_t yielding = 0;
  for ([[maybe_unused]] auto _ : timing) yielding += soil.step();
  const double items = double(soil.model.lane_of_tet.size()), nodes = double(soil.model.nodes.size());
  const double flowed = double(yielding) / double(timing.iterations()) / items;
  const Work first = volume_work(flowed), second = stress_work(branches, flowed),
             of_nodes = node_work(double(soil.model.sums.size()) / nodes);
  const Work work = {first.bytes + second.bytes + nodes / items * of_nodes.bytes,
                     first.operations + second.operations + nodes / items * of_nodes.operations};
  report(timing, items, work, items * work.bytes);
  timing.counters["flow"] = flowed;
}

void bodies(benchmark::State& timing) {
  Running& r = wall("wall-1040-bonded");
  const Array<double> pose = r.state.pose, motion = r.state.motion;
  const BodyPass pass = r.stepper.body_pass();
  for ([[maybe_unused]] auto _ : timing) benchmark::DoNotOptimize(pass.bodies(0, r.model.bodies.size()));
  r.state.pose = pose, r.state.motion = motion;
  const double items = double(r.model.bodies.size());
  const Work work = body_work(double(r.model.sums.size()) / items);
  report(timing, items, work, items * work.bytes);
}

void energies(benchmark::State& timing) {
  Running& r = wall("wall-1040-bonded");
  set_branches(r.model, r.state, 0);
  const BodyPass pass = r.stepper.body_pass();
  for ([[maybe_unused]] auto _ : timing) benchmark::DoNotOptimize(compute_energies(r.stepper, pass));
  timing.SetItemsProcessed(timing.iterations() * std::int64_t(r.model.joints.size()));
}

void search(benchmark::State& timing) {
  Running& r = wall("wall-1040-bonded");
  for ([[maybe_unused]] auto _ : timing) {
    timing.PauseTiming();
    State state = r.state;
    for (std::size_t i = 0; i < state.searched.size(); i += searched_width) state.searched[i] = 1e18f;
    timing.ResumeTiming();
    benchmark::DoNotOptimize(update_contacts(r.model, state, {}));
  }
  timing.SetItemsProcessed(timing.iterations() * std::int64_t(r.model.bodies.size()));
}

BENCHMARK_CAPTURE(joints, intact, "wall-1040-bonded", true)->Arg(0)->Arg(1)->Arg(3);
BENCHMARK_CAPTURE(joints, point_by_point, "wall-1040", false)->Arg(0)->Arg(1)->Arg(3);
BENCHMARK(bodies);
BENCHMARK_CAPTURE(tetrahedra, elastic, 0.0)->ArgsProduct({{12, 20, 30, 40}, {0, 1, 3}});
BENCHMARK_CAPTURE(tetrahedra, flowing, 1e-3)->ArgsProduct({{12, 40}, {0, 1, 3}});
BENCHMARK(energies);
BENCHMARK(search);

}  // namespace
}  // namespace voussoir

BENCHMARK_MAIN();
