// An axle at several places on a bare arch: collapse loads by the solver against limit analysis of the same blocks,
// and the place with the smallest collapse load.
#include <algorithm>

#include "geometry/road.h"
#include "tools/ladder/ring_strip.h"
#include "tools/ladder/rung.h"
#include "tools/limit/limit_analysis.h"

namespace voussoir::ladder {

namespace {

constexpr double axle = 10e3;  // N
constexpr double wheel = 0.3;  // m along

/// The extrados is the road of a bare arch.
Assembly arch_with_road() {
  Assembly assembly = ring_strip({.rings = {0.25}, .span = 4.0, .rise = 1.0, .voussoirs = 30});
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    if (!assembly.blocks[i].fixed) assembly.groups["deck"].push_back(std::int64_t(i));
  return assembly;
}

RoadLoad at(double x) {
  const RoadArea area = {x - 0.5 * wheel, x + 0.5 * wheel, -0.5, 0.5};
  return {area, axle / area.area(), "an axle"};
}

double by_limit_analysis(const Assembly& assembly, const Road& road, double x) {
  const RoadLoad load = at(x);
  limit::LimitProblem problem;
  for (const RoadShare::OfBlock& of : road.under(load.area).blocks)
    problem.loads.push_back({of.block, Vec3(0.0, 0.0, -load.pressure * of.area), of.centre});
  return limit::limit_analysis(assembly, problem).multiplier;
}

double by_program(const Assembly& assembly, double x, double expected, int threads) {
  Loads loads;
  loads.road = {at(x)};
  return collapse_multiplier(assembly, loads, expected, threads);
}

std::vector<Finding> climb_axle(int threads) {
  const Assembly assembly = arch_with_road();
  const Road road(assembly);
  std::vector<Finding> findings;
  const std::vector<double> places = {0.8, 1.0, 1.2, 1.4, 2.0};  // m
  std::vector<double> expected, got;
  for (const double x : places) {
    expected.push_back(by_limit_analysis(assembly, road, x));
    got.push_back(by_program(assembly, x, expected.back(), threads));
    findings.push_back(near(fmt::format("axle at {:.2f} of the span: factor", x / 4.0), expected.back(), got.back(),
                            0.02, "-", "linear program (Livesley 1978)"));
  }
  const auto worst = [&](const std::vector<double>& f) {
    return places[std::size_t(std::min_element(f.begin(), f.end()) - f.begin())];
  };
  findings.push_back(
      within("worst place of the axle", worst(expected), worst(got), 1e-9, "m", "the same, at each place"));
  return findings;
}

}  // namespace

Rung axle_strip() {
  return {.name = "axle-strip",
          .help = "collapse loads of an axle at several places on an arch",
          .climb = climb_axle,
          .slow = false};
}

}  // namespace voussoir::ladder
