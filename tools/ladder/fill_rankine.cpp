// Earth pressure on a smooth wall: at rest, and after the wall has moved away (Rankine 1857). On a smooth base the
// stress is the same all along a level, σz = −γ (H − z) and σx = K σz, so that K is the elastic ν/(1 − ν), then the
// strength's (1 − sin φ)/(1 + sin φ).
#include <fmt/format.h>

#include "solver/base/error.h"
#include "tools/ladder/fill_models.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

constexpr double height = 4.0, length = 4.0, cell = 0.25;  // m; a slice of one cell
constexpr double density = 1800.0, rankine_youngs = 10e6,
                 poisson = 1.0 / 3.0;                                // kg/m3, Pa: loose, so that it gives way slowly
constexpr double rankine_kn = 2e9, rankine_weight = 9.81 * density;  // Pa/m, N/m3
constexpr std::int64_t wall = 1;                                     // block

/// Without cohesion.
Material sand(double friction, double dilation) {
  Material m = elastic_fill(density, rankine_youngs / (3.0 - 6.0 * poisson), rankine_youngs / (2.0 + 2.0 * poisson));
  m.cohesion = m.tensile_strength = 0.0;
  m.friction_angle = radians(friction), m.dilation_angle = radians(dilation);
  return m;
}

/// On a base, between the wall at x = 0 and one at the far end; no stone moves by itself, and none has friction.
Assembly trench(const Material& soil) {
  Assembly assembly = stone();
  add_box(assembly, {-1, 0, -1}, {length + 1, cell, 0}, true);
  add_box(assembly, {-1, 0, 0}, {0, cell, height + 0.5}, true);
  add_box(assembly, {length, 0, 0}, {length + 1, cell, height + 0.5}, true);
  FillMesh mesh = box_mesh({0, 0, 0}, {length, cell, height}, int(length / cell), 1, int(height / cell));
  return filled(std::move(assembly), std::move(mesh), soil, rankine_kn, 0.4 * rankine_kn, dry_law(0.0));
}

/// Settled already, as if between walls that do not give way; in plane strain.
void settle(Bench& bench) {
  FillModel& fill = bench.model.fill;
  const double stiff = fill.laws[0].stiff();
  for (std::size_t i = 0; i < fill.nodes.size(); ++i) {
    const double z = fill.nodes[i].z();
    move_node(bench.state, i,
              {0, 0, -rankine_weight * height / rankine_kn - rankine_weight / stiff * (height * z - 0.5 * z * z)});
    fill.held[i] |= 2;
  }
}

/// The wall moves away by a share of the fill's height, from rest to rest.
void drive_wall(Bench& bench, double share, int steps) {
  Stepper& stepper = bench.stepper;
  stepper.drives = {Drive{}};
  stepper.drives[0].displacement = {-share * height, 0, 0};
  stepper.drive.assign(bench.model.bodies.size(), -1);
  stepper.drive[std::size_t(bench.body(wall))] = 0;
  stepper.stage_start = bench.state.time();
  stepper.stage_duration = steps * stepper.dt;
}

/// Over ½ γ H² of the slice, mean of so many steps.
double thrust(Bench& bench, int steps) {
  constexpr int every = 10;
  const int samples = steps / every;
  double sum = 0.0;
  const auto sample = [&](const BodyPass& bodies) {
    sum -= bodies.update(std::size_t(bench.body(wall))).force.x / samples;
  };
  if (!bench.run(steps, every, sample)) throw RunError("the motion of the fill behind the wall grows without limit");
  return sum / (0.5 * rankine_weight * height * height * cell);
}

struct Pressure {
  double rest = 0.0, active = 0.0;
};

Pressure on_wall(double friction, double dilation) {
  SolverSettings settings = undamped({0, 0, -9.81});
  settings.damping.kind = DampingSettings::Kind::local;
  Bench bench(trench(sand(friction, dilation)), settings);
  settle(bench);
  bench.begin();
  thrust(bench, 2000);
  Pressure p;
  p.rest = thrust(bench, 100);
  constexpr int moving = 6000;
  drive_wall(bench, 0.005, moving);
  thrust(bench, moving + 1000);
  const double before = thrust(bench, 200);
  p.active = thrust(bench, 200);
  if (std::abs(p.active - before) > 1e-3 * before)
    throw RunError("the thrust on the wall is not steady: {:.5f}, then {:.5f}", before, p.active);
  return p;
}

std::vector<Finding> climb_fill_rankine(int) {
  std::vector<Finding> findings;
  const auto add = [&](double friction, double dilation, const char* how) {
    const double sine = std::sin(radians(friction));
    const Pressure p = on_wall(friction, dilation);
    if (findings.empty())
      findings.push_back(near("at rest", poisson / (1.0 - poisson), p.rest, 0.01, "-", "nu/(1 - nu)"));
    findings.push_back(near(fmt::format("active, friction of {:.0f} degrees{}", friction, how),
                            (1.0 - sine) / (1.0 + sine), p.active, 0.05, "-", "Rankine: (1 - sin phi)/(1 + sin phi)"));
  };
  for (const double friction : {30.0, 35.0, 40.0}) add(friction, friction, "");
  add(40.0, 0.0, ", no dilation");
  findings.back() =
      known_miss(findings.back(), "shear bands at constant volume carry less than the strength (Davis: at most 0.298)");
  return findings;
}

}  // namespace

Rung fill_rankine() {
  return {.name = "fill-rankine",
          .help = "earth pressure at rest, and on a wall that moves away",
          .climb = climb_fill_rankine};
}

}  // namespace voussoir::ladder
