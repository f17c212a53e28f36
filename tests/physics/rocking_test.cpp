// The rocking block of Housner (1963): 0.6 × 2.4 m, α = 0.24498, p = √(3 g/(4 R)) = 2.43847 /s.
#include "tests/solver/measured.h"
#include "tests/solver/models.h"
#include "tools/convergence/specimens.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

constexpr double half_width = 0.3, half_height = 1.2;

/// The block on a wide base; σ/(kn × size) = 8e-7.
std::unique_ptr<Bench> rocking_block(DampingSettings::Kind damping) {
  Assembly assembly = stone(2000.0, 1e10, 2.0);
  add_box(assembly, {-2, -1, -0.5}, {2, 1, 0}, true);
  add_box(assembly, {-half_width, -0.3, 0}, {half_width, 0.3, 2 * half_height});
  SolverSettings settings = undamped({0, 0, -9.81});
  settings.damping.kind = damping;
  auto bench = std::make_unique<Bench>(joined(std::move(assembly), 1e11, 4e10, dry_law(2.0)), settings);
  bench->begin();
  return bench;
}

double tilt(Bench& bench) {
  return 2 * std::asin(bench.rotation(1).y());
}

double quarter_period(double start) {
  return exact_rocking_quarter(2 * half_width, 2 * half_height, start);
}

TEST(Rocking, QuadratureAgreesWithThePublishedPeriods) {
  const double alpha = std::atan(half_width / half_height);
  const std::map<double, double> published = {
      {0.1, 0.7695}, {0.3, 1.4733}, {0.5, 2.1641}, {0.7, 3.0768}, {0.9, 4.9122}};
  for (const auto& [share, period] : published) EXPECT_NEAR(4 * quarter_period(share * alpha), period, 2e-4 * period);
}

/// Times at which the tilt changes sign, from rest at a share of α.
std::vector<double> crossings(double share, double duration) {
  auto bench = rocking_block(DampingSettings::Kind::none);
  const double alpha = std::atan(half_width / half_height);
  // Turned about the edge at x = +half_width, a positive turn about y.
  bench->turn_about(1, {half_width, 0, 0}, Eigen::Quaterniond(Eigen::AngleAxisd(share * alpha, Vec3::UnitY())));
  std::vector<double> times;
  double before = tilt(*bench);
  EXPECT_TRUE(bench->run(std::int64_t(duration / bench->stepper.dt), 1, [&](const BodyPass&) {
    const double now = tilt(*bench);
    if (before * now < 0.0) times.push_back(bench->state.time());
    before = now;
  }));
  return times;
}

TEST(Rocking, QuarterPeriod) {
  const double alpha = std::atan(half_width / half_height);
  for (double share : {0.1, 0.3, 0.5, 0.7, 0.9}) {
    const double expected = quarter_period(share * alpha);
    const std::vector<double> times = crossings(share, 1.1 * expected);
    ASSERT_FALSE(times.empty()) << share;
    EXPECT_NEAR(times[0], expected, 0.01 * expected) << share;
    char what[60];
    std::snprintf(what, sizeof what, "Free rocking from %.1f alpha: four quarter cycles", share);
    measured(what, 4 * expected, 4 * times[0], "s");
  }
}

/// An elastic joint gives the impact back as bouncing and jitter: the block goes over to its other edge, never higher
/// than it started. (Housner's inelastic impact would leave 0.9118 of the spin; four quarters are the cycle without
/// loss.)
TEST(Rocking, GoesOverToItsOtherEdge) {
  auto bench = rocking_block(DampingSettings::Kind::none);
  const double start = 0.5 * std::atan(half_width / half_height);
  bench->turn_about(1, {half_width, 0, 0}, Eigen::Quaterniond(Eigen::AngleAxisd(start, Vec3::UnitY())));
  double lowest = 0.0, highest = 0.0;
  ASSERT_TRUE(bench->run(std::int64_t(3.0 / bench->stepper.dt), 1, [&](const BodyPass&) {
    if (bench->state.time() < 0.6) return;
    lowest = std::min(lowest, tilt(*bench));
    highest = std::max(highest, tilt(*bench));
  }));
  EXPECT_LT(lowest, -0.5 * start);
  EXPECT_GT(lowest, -1.01 * start);
  EXPECT_LT(highest, 1.01 * start);
  EXPECT_LT(std::abs(bench->rotation(1).x()) + std::abs(bench->rotation(1).z()), 1e-3) << "in its plane";
}

/// Spin after the first impact over that before it, from the tilts at rest on either side: both turned into spin at the
/// impact by what the weight does on the way, ½ ω² = p² (cos(α − θ) − cos α).
double restitution(DampingSettings::Kind damping) {
  auto bench = rocking_block(damping);
  const double alpha = std::atan(half_width / half_height), start = 0.5 * alpha;
  bench->turn_about(1, {half_width, 0, 0}, Eigen::Quaterniond(Eigen::AngleAxisd(start, Vec3::UnitY())));
  double lowest = 0.0;
  EXPECT_TRUE(bench->run(std::int64_t(1.3 / bench->stepper.dt), 1,
                         [&](const BodyPass&) { lowest = std::min(lowest, tilt(*bench)); }));
  const auto energy = [&](double tilt) { return std::cos(alpha - tilt) - std::cos(alpha); };
  return std::sqrt(energy(-lowest) / energy(start));
}

/// Reported, not tuned: between Housner's inelastic impact, 1 − 1.5 sin² α, and none at all.
TEST(Rocking, RestitutionOfTheImpact) {
  const double alpha = std::atan(half_width / half_height);
  const double housner = 1.0 - 1.5 * std::sin(alpha) * std::sin(alpha);
  EXPECT_NEAR(housner, 0.9118, 5e-5);
  for (const auto& [name, kind] :
       {std::pair{"undamped", DampingSettings::Kind::none}, {"Maxwell", DampingSettings::Kind::maxwell}}) {
    const double got = restitution(kind);
    measured(std::string("spin after an impact over that before, ") + name, housner, got, "-");
    EXPECT_GT(got, 0.7);
    EXPECT_LT(got, 1.0);
  }
}

/// A slowly rising base acceleration lifts an edge at b/h = 0.25 g.
TEST(Rocking, UpliftAccelerationOfTheBase) {
  auto bench = rocking_block(DampingSettings::Kind::maxwell);
  ASSERT_TRUE(bench->balance().converged);
  bench->begin();
  GroundMotion ramp;
  ramp.dt = 2.0;
  for (int i = 0; i <= 3; ++i) ramp.acceleration.emplace_back((0.2 + 0.02 * i) * 9.81 * std::min(1, i), 0, 0);
  bench->stepper.motion = &ramp;
  double lifted = 0.0;
  ASSERT_TRUE(bench->run(std::int64_t(6.0 / bench->stepper.dt), 1, [&](const BodyPass&) {
    if (lifted == 0.0 && std::abs(tilt(*bench)) > 1e-4)
      lifted = base_acceleration(&ramp, bench->state.time()).x() / 9.81;
  }));
  EXPECT_NEAR(lifted, 0.25, 0.01 * 0.25);
  measured("Rocking block: uplift", 0.25, lifted, "g");
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
