// voussoir-bench-kernels: the kernels of a step one by one, by Google Benchmark. Placements do not change, so that
// joints that go point by point are closed and stick.
#include <benchmark/benchmark.h>

#include <map>

#include "solver/contact/search.h"
#include "solver/step/energy.h"
#include "tools/bench/phases.h"

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

void joints(benchmark::State& timing, const char* name, bool shortcut) {
  Running& r = wall(name);
  const int branches = int(timing.range(0));
  const PatchPass pass = pass_of(r, branches, shortcut);
  for (auto _ : timing)
    for (std::size_t tile = 0; tile < r.model.tiles.size(); ++tile) benchmark::DoNotOptimize(pass.joints(tile));
  const double items = double(timing.iterations()) * double(r.model.joints.size());
  const Work work = shortcut ? intact_work(branches) : points_work(branches, 9.0, true);
  timing.SetItemsProcessed(std::int64_t(items));
  timing.SetBytesProcessed(std::int64_t(items * work.bytes));
  timing.counters["op/s"] = benchmark::Counter(items * work.operations, benchmark::Counter::kIsRate);
}

void bodies(benchmark::State& timing) {
  Running& r = wall("wall-1040-bonded");
  const Array<double> pose = r.state.pose, motion = r.state.motion;
  const BodyPass pass = r.stepper.body_pass();
  for (auto _ : timing) benchmark::DoNotOptimize(pass.bodies(0, r.model.bodies.size()));
  r.state.pose = pose, r.state.motion = motion;
  const double items = double(timing.iterations()) * double(r.model.bodies.size());
  const Work work = body_work(double(r.model.sums.size()) / double(r.model.bodies.size()));
  timing.SetItemsProcessed(std::int64_t(items));
  timing.SetBytesProcessed(std::int64_t(items * work.bytes));
  timing.counters["op/s"] = benchmark::Counter(items * work.operations, benchmark::Counter::kIsRate);
}

void energies(benchmark::State& timing) {
  Running& r = wall("wall-1040-bonded");
  set_branches(r.model, r.state, 0);
  const BodyPass pass = r.stepper.body_pass();
  for (auto _ : timing) benchmark::DoNotOptimize(compute_energies(r.stepper, pass));
  timing.SetItemsProcessed(timing.iterations() * std::int64_t(r.model.joints.size()));
}

void search(benchmark::State& timing) {
  Running& r = wall("wall-1040-bonded");
  for (auto _ : timing) {
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
BENCHMARK(energies);
BENCHMARK(search);

}  // namespace
}  // namespace voussoir

BENCHMARK_MAIN();
