// The composite law against its closed forms (docs/theory/joints.md): energies of a point that is pulled, sheared and
// crushed, the state after unloading, the dilation under repeated sliding, and the position of the resultant of a
// crushed hinge.
#include <fmt/format.h>

#include <cmath>

#include "solver/model/laws.h"
#include "tools/ladder/models.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

constexpr double mortar_kn = 1e10, mortar_ks = 4e9, fc = 3e6;                           // Pa/m, Pa/m, Pa
constexpr double mortar_GI = 20.0, mortar_GII = 80.0, mortar_Gc = 4000.0, peak = 4e-4;  // J/m2, J/m2, J/m2, m
constexpr double lift = 0.2, lift_length = 1e-3, lift_pressure = 2e6;                   // tan ψ0, m, Pa
constexpr double softening = mortar_Gc / (67.0 / 75.0 * fc);  // m, first half of the softening in pressure

JointLaw mortar() {
  JointLaw law;
  law.kind = JointLaw::Kind::composite;
  law.tension = 1e5, law.cohesion = 2e5;
  law.friction_angle = law.residual_friction_angle = std::atan(0.7);
  law.fracture_energy = {mortar_GI, mortar_GII};
  law.compressive_strength = fc, law.compressive_energy = mortar_Gc, law.compressive_peak = peak;
  return law;
}

/// One point, moved by hand: its work and losses, J/m2.
struct Probe {
  LawConstants law;
  PointMemory memory;
  PointResult last;
  double un = 0.0, us = 0.0, work = 0.0, fracture = 0.0, friction = 0.0;

  explicit Probe(const JointLaw& l) : law(law_constants(l)) { to(0.0, 0.0, 1); }
  double normal() const { return mortar_kn * last.n; }  // Pa
  double shear() const { return mortar_ks * last.s; }
  void step(double n, double s) {
    const PointResult next = CompositeLaw::update(law, mortar_kn, mortar_ks, n, s, 0.0, memory);
    work += 0.5 * (mortar_kn * (last.n + next.n) * (n - un) + mortar_ks * (last.s + next.s) * (s - us));
    fracture += next.fracture, friction += next.friction;
    un = n, us = s, last = next;
  }
  /// Moves straight to a jump in the given number of steps.
  void to(double n, double s, int steps) {
    const double n0 = un, s0 = us;
    for (int i = 1; i <= steps; ++i) step(n0 + (n - n0) * i / steps, s0 + (s - s0) * i / steps);
  }
  /// Slides to a jump under a pressure; the normal jump is corrected after every step.
  void slide_under(double pressure, double s, int steps) {
    const double s0 = us;
    for (int i = 1; i <= steps; ++i) step(un - (pressure + normal()) / mortar_kn, s0 + (s - s0) * i / steps);
  }
};

void pull_and_slide(std::vector<Finding>& findings) {
  Probe pulled(mortar());
  pulled.to(5e-3, 0.0, 20000);
  findings.push_back(near("work of pulling apart", mortar_GI, pulled.work, 0.005, "J/m2", "GI: area under the curve"));
  Probe slid(mortar());
  constexpr double pressure = 5e4, rubbed = 0.7 * pressure, elastic = rubbed / mortar_ks;  // below the cap
  slid.to(-pressure / mortar_kn, 0.0, 1);
  slid.work = 0.0;
  slid.to(-pressure / mortar_kn, 1e-2, 40000);
  const double above = slid.work - rubbed * (1e-2 - elastic) - 0.5 * rubbed * elastic;
  findings.push_back(
      near("work of sliding above friction", mortar_GII, above, 0.005, "J/m2", "GII: area above friction"));
}

/// S at an inelastic jump beyond the end of the first half of the softening.
double strength_beyond(double crushed) {
  const double y = (crushed - peak) / softening;
  return fc * (0.1 + 0.4 * std::exp(-(y - 1.0) / 0.4));
}

void press(std::vector<Finding>& findings) {
  Probe pressed(mortar());
  const double down = peak + 12.0 * softening;
  pressed.to(-down, 0.0, 40000);
  const double crushed = down + pressed.normal() / mortar_kn, p = -pressed.normal();
  const double others = 7.0 / 9.0 * fc * peak + 0.1 * fc * (crushed - peak) + 0.5 * p * p / mortar_kn;
  findings.push_back(
      near("work of crushing above a tenth of fc", mortar_Gc, pressed.work - others, 0.005, "J/m2", "Gc"));
  findings.push_back(near("residual pressure", strength_beyond(crushed), p, 0.005, "Pa", "softening curve"));
}

/// Pressed beyond its strength, unloaded, and reloaded to the same closure.
void unload(std::vector<Finding>& findings) {
  Probe point(mortar());
  const double down = peak + 2.0 * softening;
  point.to(-down, 0.0, 20000);
  const double p = -point.normal(), crushed = down - p / mortar_kn, strength = strength_beyond(crushed);
  const double kept = strength / (strength + 0.3 * mortar_kn * crushed), work = point.work;
  point.to(-down + 0.5 * p / (mortar_kn * kept), 0.0, 100);
  const double stiffness = (p + point.normal()) / (0.5 * p / (mortar_kn * kept));
  findings.push_back(
      near("unloading stiffness", mortar_kn * kept, stiffness, 0.005, "Pa/m", "kn S/(S + 0.3 kn kappa)"));
  while (point.normal() < -1.0) point.step(point.un - point.normal() / (mortar_kn * kept), 0.0);
  findings.push_back(near("permanent closure", 0.7 * crushed, -point.un, 0.005, "m", "0.7 kappa"));
  point.to(-down, 0.0, 100);
  findings.push_back(near("pressure after reloading", p, -point.normal(), 0.005, "Pa", "elastic cycle"));
  findings.push_back(nothing("work of the cycle / total work", (point.work - work) / work, 1e-3, "-", "elastic cycle"));
}

/// Twenty cycles of ± 1 mm under a pressure, without bond.
void dilate(std::vector<Finding>& findings) {
  JointLaw law = mortar();
  law.tension = law.cohesion = 0.0;
  law.dilation_angle = std::atan(lift), law.dilation_length = lift_length, law.dilation_pressure = lift_pressure;
  Probe point(law);
  constexpr double pressure = 2e5;  // below the cap
  point.to(-pressure / mortar_kn, 0.0, 1);
  for (int i = 0; i < 20; ++i) point.slide_under(pressure, i % 2 ? -1e-3 : 1e-3, 4000);
  const double most = (1.0 - pressure / lift_pressure) * lift * lift_length;
  findings.push_back(near("dilation after twenty reversals", most, point.un + pressure / mortar_kn, 0.01, "m",
                          "(1 - p/p_psi) tan psi u0"));
}

/// Depth from the edge to the resultant of a block on strips of base that is tilted more and more under a load. The
/// strips give closely spaced points.
double hinge_lever(double depth, double width, double load) {
  constexpr int strips = 40;
  JointLaw law = mortar();
  law.tension = law.cohesion = 0.0;
  law.compressive_energy = 1e9, law.compressive_peak = 1e-5;  // as good as perfectly plastic
  Assembly assembly = stone();
  for (int i = 0; i < strips; ++i)
    add_box(assembly, {depth * i / strips, 0, -0.1}, {depth * (i + 1) / strips, width, 0}, true);
  add_box(assembly, {0, 0, 0}, {depth, width, 0.4});
  Bench bench(joined(std::move(assembly), mortar_kn, mortar_ks, law));
  bench.begin(1e-3);
  const Vec3 middle(depth / 2, width / 2, 0.0), arm(0, 0, 0.2);
  double down = 0.0, lever = 0.0;
  for (int i = 1; i <= 1000; ++i) {
    const Eigen::Quaterniond turn(Eigen::AngleAxisd(4e-5 * i, Vec3::UnitY()));
    double force = 0.0;
    for (int k = 0; k < 400 && std::abs(force - load) > 1e-5 * load; ++k) {
      if (k > 0) down += 0.5 * (load - force) / (mortar_kn * depth * width);
      bench.place(strips, Vec3(0, 0, -down) + turn * arm - arm, turn);
      bench.stepper.patches_only();
      double moment = force = 0.0;
      for (std::size_t j = 0; j < bench.model.joints.size(); ++j) {
        const Patch& patch = bench.model.joints[j];
        if (patch.a != bench.body(strips) && patch.b != bench.body(strips)) continue;
        const auto [f, m] = bench.wrench_on(strips, j, middle);
        force += f.z(), moment += m.y();
      }
      lever = std::abs(moment) / load;
    }
  }
  return lever;
}

void hinge(std::vector<Finding>& findings) {
  constexpr double depth = 0.4, width = 0.5;
  for (const double share : {0.1, 0.25, 0.5}) {
    const double load = share * fc * depth * width, lever = depth / 2 - load / (2 * fc * width);
    findings.push_back(near(fmt::format("lever of a hinge under {:g} of its strength", share), lever,
                            hinge_lever(depth, width, load), 0.02, "m", "t/2 - N/(2 fc w)"));
  }
}

std::vector<Finding> climb_composite_joint(int) {
  std::vector<Finding> findings;
  for (const auto part : {pull_and_slide, press, unload, dilate, hinge}) part(findings);
  return findings;
}

}  // namespace

Rung composite_joint() {
  return {.name = "composite-joint",
          .help = "a composite joint pulled, sheared and crushed: energies, unloading, dilation, lever arm of a hinge",
          .climb = climb_composite_joint};
}

}  // namespace voussoir::ladder
