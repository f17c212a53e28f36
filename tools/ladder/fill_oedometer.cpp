// A cube of fill pressed down between smooth walls that do not give way.
//
// The closed form is that of small strains. It holds at any strain between logarithmic strain and Kirchhoff stress,
// the pair in which the elements are formulated; so the plate goes down to a height of exp(−ε), and what is read is the
// stress times the volume ratio (de Souza Neto, Perić & Owen 2008, 14.4).
#include "solver/base/error.h"
#include "tools/ladder/fill_rig.h"
#include "tools/ladder/models.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

struct Reading {
  double vertical = 0.0, sideways = 0.0;  // Kirchhoff stress, Pa
  std::int64_t flowed = 0;
};

/// After ramps of logarithmic strain up to each of `strains`.
std::vector<Reading> compress(const Material& soil, const std::vector<double>& strains) {
  FillRig rig(box_mesh({0, 0, 0}, {1, 1, 1}, 2, 2, 2), soil);
  const auto top = [](const Vec3& x) { return x.z() > 1.0 - 1e-9; };
  const auto right = [](const Vec3& x) { return x.x() > 1.0 - 1e-9; };
  for (int c = 0; c < 3; ++c) rig.hold(c, [c](const Vec3& x) { return x[c] < 1e-9 || x[c] > 1.0 - 1e-9; });
  rig.pass.dt = rig.safe_step(0.4);
  rig.pass.local = 0.8;
  std::vector<Reading> readings;
  double height = 1.0;
  for (const double strain : strains) {
    constexpr int steps = 8000;
    const double to = std::exp(-strain);
    // All nodes at once, so that no wave runs ahead of the plate.
    for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i)
      rig.set_velocity(i, {0, 0, (to - height) / (steps * rig.pass.dt) * rig.fill.nodes[i].z()});
    for (int s = 0; s < steps; ++s) rig.step();
    height = to;
    for (std::size_t i = 0; i < rig.fill.nodes.size(); ++i) rig.set_velocity(i, Vec3::Zero());
    for (int s = 0; s < 2000; ++s) rig.step();
    Reading r;
    rig.stresses();
    r.flowed = rig.flowed();
    // The volume ratio equals the height, and the wall at x = 1 is pressed over its remaining height.
    r.vertical = rig.force_on(2, top) * height, r.sideways = rig.force_on(0, right);
    readings.push_back(r);
  }
  return readings;
}

/// K = G = 200 MPa, c = 1 MPa, φ = ψ = 10°.
Material flowing() {
  Material m = elastic_fill(1500.0, 200e6, 200e6);
  m.cohesion = 1e6, m.tensile_strength = 1e9;
  m.friction_angle = m.dilation_angle = radians(10.0);
  return m;
}

/// The bridges' fill: c = 20 kPa, φ = 40°.
Material backfill() {
  Material m = elastic_fill(1500.0, 800e6 / 3.0, 160e6);
  m.cohesion = 20e3, m.friction_angle = radians(40.0);
  return m;
}

/// Logarithmic strain at which the vertical stress leaves the elastic line, from readings on either side.
double yield_strain() {
  const double stiff = 200e6 * 7.0 / 3.0;
  const std::vector<Reading> r = compress(flowing(), {0.006, 0.008, 0.010});
  // Elastic up to the first; from there the line through the last two is met by the elastic one.
  const double slope = (r[2].vertical - r[1].vertical) / 0.002;
  return (r[1].vertical - slope * 0.008) / (stiff - slope);
}

std::vector<Finding> climb_fill_oedometer(int) {
  const std::string source = "closed form (associated flow, two equal middle stresses)";
  const std::vector<Reading> yields = compress(flowing(), {0.02});
  const std::vector<Reading> never = compress(backfill(), {0.005, 0.02});
  if (yields[0].flowed == 0) throw RunError("the fill in the oedometer never yielded");
  std::vector<Finding> findings;
  findings.push_back(near("strain at yield", 0.006408, yield_strain(), 5e-3, "-", source));
  findings.push_back(
      near("vertical stress at a strain of 0.02", 7.0262, yields[0].vertical / 1e6, 5e-3, "MPa", source));
  findings.push_back(near("stress on the walls", 3.2689, yields[0].sideways / 1e6, 5e-3, "MPa", source));
  findings.push_back(near("the bridges' fill: vertical stress at 0.005", 2.4, never[0].vertical / 1e6, 5e-3, "MPa",
                          "(K + 4/3 G) eps"));
  findings.push_back(within("the bridges' fill: share of the vertical on the walls", 1.0 / 3.0,
                            never[1].sideways / never[1].vertical, 2e-3, "-", "nu/(1 - nu)"));
  findings.push_back(nothing("the bridges' fill: tetrahedra that flow", double(never[1].flowed), 0.0, "-",
                             "elastic: K0 = 1/3 is above the active 0.217"));
  return findings;
}

}  // namespace

Rung fill_oedometer() {
  return {.name = "fill-oedometer",
          .help = "fill pressed between walls: elastic, and flowing",
          .climb = climb_fill_oedometer};
}

}  // namespace voussoir::ladder
