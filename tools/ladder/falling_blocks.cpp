// A block that falls on a fixed one: nothing passes through, energy never grows.
#include "solver/base/error.h"
#include "tools/ladder/models.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

constexpr double side = 0.5;  // m
constexpr const char* tight = "no penetration";

struct Fall {
  double overlap = 0.0;    // m, deepest so far
  double gain = 0.0;       // of stored energy over the starting one, share of the largest kinetic energy
  double imbalance = 0.0;  // of the ledger, same share
  double lowest = 1e300;   // m, of the block's centroid
};

struct Drop {
  std::string name;
  Eigen::Quaterniond rotation;
  double gap, duration;  // m, s
  double allowed;        // overlap, share of the side
  Vec3 aside = Vec3::Zero();
  DampingSettings::Kind damping = DampingSettings::Kind::none;
};

/// A cube that hangs `gap` m above a fixed slab, turned.
Assembly cube_above_slab(const Drop& drop) {
  Polyhedron cube = make_box(Vec3::Constant(-side / 2), Vec3::Constant(side / 2));
  double low = 1e300;
  for (const Vec3& v : cube.vertices) low = std::min(low, (drop.rotation * v).z());
  Assembly assembly = stone(2000.0, 1e10, 0.5);
  add_box(assembly, {-1, -1, -1}, {1, 1, 0}, true);
  for (Vec3& v : cube.vertices) v += drop.aside + Vec3(0, 0, drop.gap - low);
  add_block(assembly, cube);
  return joined(std::move(assembly), 1e8, 4e7, dry_law(0.5));
}

Fall fall(const Drop& drop) {
  SolverSettings settings = undamped({0, 0, -9.81});
  settings.damping.kind = drop.damping;
  Bench bench(cube_above_slab(drop), settings);
  bench.place(1, Vec3::Zero(), drop.rotation);
  bench.begin(1e-5);
  update_contacts(bench.model, bench.state, bench.stepper.damping.branches);
  bench.stepper.prepare();
  Fall f;
  double first = 1e300, kinetic = 0.0;
  const bool stayed = bench.run(std::int64_t(drop.duration / 1e-5), 10, [&](const BodyPass& pass) {
    f.overlap = std::max(f.overlap, bench.overlap(0, 1));
    f.lowest = std::min(f.lowest, bench.assembly.blocks[1].centroid.z() + bench.displacement(1).z());
    const Energies e = compute_energies(bench.stepper, pass);
    if (first == 1e300) first = e.total();
    kinetic = std::max(kinetic, e.kinetic);
    f.gain = std::max(f.gain, e.stored() - first);
    f.imbalance = std::max(f.imbalance, std::abs(e.total() - first));
  });
  if (!stayed) throw RunError("the motion of the block that falls {} grows without limit", drop.name);
  f.gain /= kinetic, f.imbalance /= kinetic;
  return f;
}

Finding overlap_of(const std::string& name, const Fall& f, double allowed) {
  return nothing(name + ": deepest overlap", f.overlap, allowed * side, "m", tight);
}

/// Tolerance for rounding, as a share of the largest kinetic energy.
Finding gain_of(const std::string& name, const Fall& f) {
  return nothing(name + ": growth of energy", f.gain, 1e-9, "-", "first law");
}

void raise(Fall& worst, const Fall& f) {
  worst.overlap = std::max(worst.overlap, f.overlap);
  worst.gain = std::max(worst.gain, f.gain);
  worst.imbalance = std::max(worst.imbalance, f.imbalance);
  worst.lowest = std::min(worst.lowest, f.lowest);
}

/// 4900 J on a corner from 2 m: the soft contact of a sharp corner is compressed by 14 mm, 2.8 %.
std::vector<Drop> drops() {
  const Eigen::Quaterniond flat = Eigen::Quaterniond::Identity(), on_edge(Eigen::AngleAxisd(0.6, Vec3::UnitY()));
  const Vec3 diagonal = Vec3(1, 1, 1).normalized(), down = Vec3(0.1, 0.05, -1).normalized();
  const Eigen::Quaterniond on_corner(
      Eigen::AngleAxisd(std::acos(diagonal.dot(down)), diagonal.cross(down).normalized()));
  return {{"on a face", flat, 0.1, 0.8, 0.01},
          {"on an edge", on_edge, 0.1, 0.8, 0.01},
          {"on a corner", on_corner, 0.1, 0.8, 0.01},
          {"on a corner from 2 m", on_corner, 2.0, 1.2, 0.05},
          {"over the other's edge", on_edge, 0.1, 0.3, 0.01, {1.0, 0.3, 0}}};
}

Fall worst_of_any_way_up() {
  std::mt19937 random(41);
  Fall worst;
  for (int i = 0; i < 12; ++i) raise(worst, fall({"any orientation", random_rotation(random), 0.05, 0.5, 0.01}));
  return worst;
}

/// With damping it comes to rest on the slab.
std::vector<Finding> come_to_rest() {
  const std::string name = "damped, on a face";
  const Fall f =
      fall({name, Eigen::Quaterniond::Identity(), 0.02, 3.0, 0.01, {0, 0, 0}, DampingSettings::Kind::maxwell});
  return {overlap_of(name, f, 0.01),
          within(name + ": lowest centroid", side / 2, f.lowest, 0.01 * side, "m", "rests on the slab")};
}

std::vector<Finding> climb_falling_blocks(int) {
  std::vector<Finding> findings;
  Fall all;
  for (const Drop& drop : drops()) {
    const Fall f = fall(drop);
    findings.push_back(overlap_of(drop.name, f, drop.allowed));
    const Finding gain = gain_of(drop.name, f);
    const bool flat = findings.size() == 1;
    findings.push_back(
        flat ? known_miss(
                   gain,
                   "an undamped contact opens and closes within a time step; the error decreases with the time step")
             : gain);
    raise(all, f);
  }
  const Fall any = worst_of_any_way_up();
  findings.push_back(overlap_of("12 orientations", any, 0.01));
  findings.push_back(gain_of("12 orientations", any));
  raise(all, any);
  findings.push_back(within("lowest centroid of all", side / 2, all.lowest, 0.05 * side, "m", tight));
  findings.push_back(nothing("largest error of the energy balance", all.imbalance, 0.01, "-", "first law"));
  for (Finding& finding : come_to_rest()) findings.push_back(std::move(finding));
  return findings;
}

}  // namespace

Rung falling_blocks() {
  return {.name = "falling-blocks",
          .help = "a block falls on another: on a face, an edge, a corner, in any orientation",
          .climb = climb_falling_blocks};
}

}  // namespace voussoir::ladder
