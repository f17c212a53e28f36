// A whole bridge released in the shape of its first mode: the frequency of the run against the eigenvalue, without
// damping and with the Maxwell damping of the bridge cases.
#include "solver/base/error.h"
#include "solver/modal/damped_mode.h"
#include "tools/ladder/decay.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

/// S. Chiara with restrained abutments in blocks of 2.5 times their size, all joints elastic.
Assembly restrained_bridge() {
  const Generator& generator = find_generator("cs1");
  GeneratorInput input = default_input(generator);
  input.choices.at("abutments") = "restrained";
  input.values.at("block_scale") = 2.5;
  Assembly assembly = generator.build(input);
  set_law(assembly, elastic_law());
  return assembly;
}

/// Frequency of the block with the largest motion over eight cycles. With damping the first cycle, in which slow
/// branches settle, is left out.
Decay rings(const Assembly& assembly, const Mode& mode, const DampingSettings& damping) {
  SolverSettings settings = undamped();
  settings.damping = damping;
  Bench bench(assembly, settings);
  bench.begin();
  bench.stepper.search_distance = 1e300;
  displace(bench, mode, 1e-6);
  Eigen::Index top = 0;
  mode.shape.leftCols<3>().rowwise().norm().maxCoeff(&top);
  const Vec3 way = bench.displacement(top).normalized();
  const double cycle = mode.period() / bench.stepper.dt;  // steps
  const auto every = std::max(std::int64_t(1), std::int64_t(0.01 * cycle));
  std::vector<double> u;
  bool stayed = damping.kind == DampingSettings::Kind::none || bench.run(std::int64_t(cycle), every);
  stayed = stayed && bench.run(std::int64_t(8.5 * cycle), every,
                               [&](const BodyPass&) { u.push_back(bench.displacement(top).dot(way)); });
  if (!stayed) throw RunError("the motion of the bridge grows without limit");
  return measure_decay(u, double(every) * bench.stepper.dt);
}

std::vector<Finding> climb_bridge_ring(int) {
  const Assembly assembly = restrained_bridge();
  const Mode mode = modes_of(Bench(assembly), 1)[0];
  const DampedMode damped = damped_mode({}, mode.frequency);
  DampingSettings none;
  none.kind = DampingSettings::Kind::none;
  const Decay free = rings(assembly, mode, none), decay = rings(assembly, mode, {});
  return {near("cs1-r, first mode released", mode.frequency, free.frequency, 0.005, "Hz", "eigenvalue of K and M"),
          near("frequency shift of Maxwell damping", damped.frequency / mode.frequency,
               decay.frequency / free.frequency, 0.003, "-", "pole of the damped mode"),
          near("ratio of Maxwell damping", damped.ratio, decay.ratio, 0.02, "-", "pole of the damped mode")};
}

}  // namespace

Rung bridge_ring() {
  return {.name = "bridge-ring",
          .help = "first mode of a whole bridge: time-stepping run against eigenvalue",
          .climb = climb_bridge_ring};
}

}  // namespace voussoir::ladder
