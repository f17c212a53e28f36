// The six springs of an intact patch are exactly its points: with and without the shortcut the same wrench, over a
// history of random motions below and across the limit.
#include "solver/base/error.h"
#include "tools/ladder/models.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

using Damping = DampingSettings::Kind;

Assembly two_blocks(int corners, const JointLaw& law, std::mt19937& random) {
  const Polygon polygon = random_polygon(corners, random);
  const Polygon reversed(polygon.rbegin(), polygon.rend());
  Assembly assembly = stone();
  const auto prism = [&](double height) {
    const Polyhedron shape = make_prism(polygon, {0, 0, height});
    return mass_properties(shape).volume > 0.0 ? shape : make_prism(reversed, {0, 0, height});
  };
  add_block(assembly, prism(-0.7));
  add_block(assembly, prism(0.6));
  return joined(std::move(assembly), 2e9, 8e8, law);
}

/// A path of the second block's placement: sums of sines, so that it comes back, about a mean compression.
struct Path {
  explicit Path(std::mt19937& random) {
    std::uniform_real_distribution<double> unit(0.0, 1.0);
    for (int c = 0; c < 6; ++c) {
      rate[c] = 0.5 + unit(random);
      phase[c] = 2 * pi * unit(random);
    }
  }
  double value(int c, double t) const { return std::sin(rate[c] * t + phase[c]); }
  double rate[6], phase[6];
};

struct Outcome {
  double worst = 0.0, largest = 0.0;    // difference and size of the components of the wrench
  std::int64_t intact = 0, points = 0;  // patch passes of the bench with the shortcut
  std::int64_t loaded = 0;  // those intact ones that carried anything: where nothing is carried, nothing is compared
  bool intact_after_points = false;
};

/// Both blocks of two benches that differ only in the shortcut are moved alike.
struct Motion {
  const char* name;
  JointLaw law;
  double press, reach;  // m: mean compression, and how far it goes about it
  unsigned seed;
  double aside;                      // the share of `reach` that all motions but the normal one get
  bool loaded;                       // it carries something while the shortcut is taken
  bool (*as_meant)(const Outcome&);  // whether the shortcut was taken, and left, as the motion is meant to make it
};

struct Placement {
  Vec3 move;
  Eigen::Quaterniond turn;
};

Placement placement(const Motion& motion, const Path& path, double t) {
  const double aside = motion.aside;
  const Vec3 move = motion.reach * Vec3(aside * path.value(0, t), aside * path.value(1, t), path.value(2, t));
  const Vec3 turn = aside * motion.reach * Vec3(path.value(3, t), path.value(4, t), path.value(5, t));
  const double w = std::sqrt(1 - 0.25 * turn.squaredNorm());
  return {move - Vec3(0, 0, motion.press), {w, 0.5 * turn.x(), 0.5 * turn.y(), 0.5 * turn.z()}};
}

void compare_wrenches(const Bench& fast, const Bench& slow, const PassReport& report, Outcome& outcome) {
  outcome.intact += report.intact;
  outcome.points += report.points;
  outcome.intact_after_points |= report.intact > 0 && outcome.points > 0;
  double carried = 0.0;
  for (std::size_t c = 0; c < 6; ++c) {
    const double a = fast.stepper.wrenches[c], b = slow.stepper.wrenches[c];
    carried = std::max(carried, std::abs(a));
    outcome.worst = std::max(outcome.worst, std::abs(a - b));
    outcome.largest = std::max(outcome.largest, std::abs(b));
  }
  outcome.loaded += report.intact > 0 && carried > 0.0;
}

Outcome compare(const Motion& motion, int corners, Damping damping) {
  std::mt19937 random(motion.seed), again(motion.seed);
  SolverSettings on = undamped(), off = undamped();
  on.damping.kind = off.damping.kind = damping;
  off.step.intact_shortcut = false;
  Bench fast(two_blocks(corners, motion.law, random), on), slow(two_blocks(corners, motion.law, again), off);
  fast.begin(1e-3), slow.begin(1e-3);
  const Path path(random);
  const Eigen::Quaterniond whole = random_rotation(random);
  Outcome outcome;
  for (int i = 0; i < 3000; ++i) {
    const Placement p = placement(motion, path, 0.02 * i);
    for (Bench* bench : {&fast, &slow}) {
      bench->turn_about(0, Vec3::Zero(), whole);
      const Vec3 arm = bench->assembly.blocks[1].centroid;
      bench->place(1, whole * (p.turn * arm + p.move) - arm, whole * p.turn);
    }
    const PassReport report = fast.stepper.patches_only();
    slow.stepper.patches_only();
    compare_wrenches(fast, slow, report, outcome);
  }
  return outcome;
}

/// The last but one: a joint without bond opens wholly, goes back to the intact path, closes and slides, over and over.
/// The last does it almost squarely: from wholly open to wholly closed in one step, loaded all the while it is closed.
std::vector<Motion> motions() {
  const auto below = [](const Outcome& o) { return o.points == 0; };
  const auto across = [](const Outcome& o) { return o.intact > 0 && o.points > 0; };
  const auto closes = [](const Outcome& o) { return o.intact_after_points && o.points > 0; };
  const auto bounces = [](const Outcome& o) { return o.loaded > 1000; };
  return {{"below the limit", weak_bond(), 2e-4, 1e-5, 21, 1.0, true, below},
          {"across the limit", weak_bond(), 5e-5, 1e-4, 22, 1.0, true, across},
          {"dry joint", dry_law(0.5), 0.0, 1e-4, 23, 1.0, false, closes},
          {"bouncing dry joint", dry_law(0.5), 0.0, 1e-4, 24, 1e-3, true, bounces}};
}

/// Largest difference of any component, as a share of the largest, over polygons of 3, 4, 5 and 8 corners.
double difference(const Motion& motion, Damping damping) {
  double worst = 0.0;
  for (int corners : {3, 4, 5, 8}) {
    const Outcome outcome = compare(motion, corners, damping);
    if (!motion.as_meant(outcome))
      throw RunError(
          "{}, {} corners: {} passes by the shortcut and {} point by point do not produce the states to be compared",
          motion.name, corners, outcome.intact, outcome.points);
    worst = std::max(worst, outcome.worst / outcome.largest);
  }
  return worst;
}

std::vector<Finding> climb_intact_shortcut(int) {
  std::vector<Finding> findings;
  const std::pair<const char*, Damping> dampings[] = {
      {"undamped", Damping::none}, {"Rayleigh", Damping::rayleigh}, {"Maxwell", Damping::maxwell}};
  for (const auto& [name, damping] : dampings)
    for (const Motion& motion : motions()) {
      const Finding finding = nothing(std::string(motion.name) + ", " + name + ": difference",
                                      difference(motion, damping), 1e-10, "-", "point by point");
      // Six numbers are rounded on one path, three a point on the other, each to 6e-8 of a viscous stress that is up to
      // a sixth of the elastic one and remembers some hundred roundings.
      findings.push_back(damping == Damping::maxwell && motion.loaded
                             ? known_miss(finding, "the branches of Maxwell damping are stored in single precision")
                             : finding);
    }
  return findings;
}

}  // namespace

Rung intact_shortcut() {
  return {.name = "intact-shortcut",
          .help = "wrench of intact joints: six springs against point by point",
          .climb = climb_intact_shortcut};
}

}  // namespace voussoir::ladder
