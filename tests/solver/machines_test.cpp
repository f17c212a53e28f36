// Machines on the structure against modes of it, however they run.
#include <gtest/gtest.h>

#include <algorithm>

#include "solver/identify/ssi.h"
#include "tests/solver/modal_models.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

constexpr double pi = std::numbers::pi;
constexpr double dt = 0.01, hum = 4.1;  // s, Hz

const ModalModel& bridge() {
  static const ModalModel model = {{2.6, 3.4, 5.3, 7.7}, {0.01, 0.012, 0.015, 0.02}, sines(6, 4)};
  return model;
}

double size_of(const Recording& r) {
  return std::sqrt(r.values.squaredNorm() / double(r.values.size()));
}

/// Adds a machine that hums for `on` s, rests for `off` s, and so on, each time from another phase.
void add_machine(Recording& r, double on, double off, double size, std::uint64_t seed = 5) {
  RandomStream random(seed);
  const double rms = size_of(r);
  double phase = 0.0;
  bool before = false;
  for (Eigen::Index i = 0; i < r.values.rows(); ++i) {
    const double t = dt * double(i);
    const bool runs = std::fmod(t, on + off) < on;
    if (runs && !before) phase = 2.0 * pi * random.uniform();
    before = runs;
    if (!runs) continue;
    for (Eigen::Index c = 0; c < r.values.cols(); ++c)
      r.values(i, c) += (1.0 + 0.1 * double(c)) * size * rms * std::sin(2.0 * pi * hum * t + phase);
  }
}

void print(const SsiResult& result) {
  for (const IdentifiedMode& m : result.modes)
    std::printf("  mode %.4f Hz, damping %.4f +- %.4f, kurtosis %.2f, %d stops with %.2f of the loss, %d hits\n",
                m.frequency, m.damping, m.damping_std, m.kurtosis, m.stops, m.stopped, m.hits);
  for (const RejectedMode& r : result.set_aside)
    std::printf("  aside %.4f Hz, damping %.5f, kurtosis %.2f, %d stops with %.2f of the loss: %s\n", r.mode.frequency,
                r.mode.damping, r.mode.kurtosis, r.mode.stops, r.mode.stopped, r.reason.c_str());
}

/// The four modes of the bridge, and nothing else.
void expect_the_bridge_alone(const SsiResult& result) {
  print(result);
  ASSERT_EQ(result.modes.size(), 4u);
  for (std::size_t m = 0; m < 4; ++m)
    EXPECT_NEAR(result.modes[m].frequency, bridge().frequency[m], 0.01 * bridge().frequency[m]);
}

struct Machine {
  const char* name;
  double on, off, size;  // s, s, share of the signal's root mean square
};

class Intermittent : public ::testing::TestWithParam<Machine> {};

TEST_P(Intermittent, IsNoMode) {
  Recording r = simulated(bridge(), 600.0, dt, 7, 0.05);
  add_machine(r, GetParam().on, GetParam().off, GetParam().size);
  expect_the_bridge_alone(identify_modes({r}));
}

INSTANTIATE_TEST_SUITE_P(
    Machines, Intermittent,
    ::testing::Values(Machine{"AMinuteInThree", 60.0, 120.0, 1.0}, Machine{"AMinuteInThreeAndWeaker", 60.0, 120.0, 0.4},
                      Machine{"AMinuteInTwo", 60.0, 60.0, 0.6}, Machine{"HalfAMinuteInTwo", 30.0, 90.0, 0.8},
                      Machine{"TwentySecondsInSixty", 20.0, 40.0, 0.8}, Machine{"TenSecondsInForty", 10.0, 30.0, 1.0}),
    [](const auto& i) { return std::string(i.param.name); });

/// A mode with little damping is none, however it is excited.
struct Light {
  const char* name;
  double damping;
  std::uint64_t seed;
};

class LightlyDamped : public ::testing::TestWithParam<Light> {};

ModalModel light_bridge(double damping) {
  ModalModel model = bridge();
  model.frequency[1] = hum;
  model.damping[1] = damping;
  return model;
}

void expect_the_light_mode(const SsiResult& result, double damping) {
  print(result);
  const auto found = std::find_if(result.modes.begin(), result.modes.end(),
                                  [](const IdentifiedMode& m) { return std::abs(m.frequency - hum) < 0.02; });
  ASSERT_NE(found, result.modes.end());
  EXPECT_NEAR(found->damping, damping, 0.5 * damping);
}

TEST_P(LightlyDamped, IsAModeUnderWhiteForces) {
  const Recording r = simulated(light_bridge(GetParam().damping), 600.0, dt, GetParam().seed, 0.05);
  expect_the_light_mode(identify_modes({r}), GetParam().damping);
}

/// Gusts: forces that change fivefold in the course of a minute.
TEST_P(LightlyDamped, IsAModeInGusts) {
  const ModalModel model = light_bridge(GetParam().damping);
  const Recording r = simulated(model, 600.0, dt, GetParam().seed + 50, 0.02,
                                [](double t) { return 0.2 + 0.8 * std::pow(std::sin(pi * t / 60.0), 2.0); });
  expect_the_light_mode(identify_modes({r}), GetParam().damping);
}

/// Vehicles: ten times the force for four seconds, every half a minute or so.
TEST_P(LightlyDamped, IsAModeUnderTraffic) {
  const ModalModel model = light_bridge(GetParam().damping);
  const Recording r = simulated(model, 600.0, dt, GetParam().seed + 100, 0.02, [](double t) {
    return std::fmod(t + 7.0 * std::sin(t / 90.0), 31.0) < 4.0 ? 1.0 : 0.1;
  });
  expect_the_light_mode(identify_modes({r}), GetParam().damping);
}

INSTANTIATE_TEST_SUITE_P(Modes, LightlyDamped,
                         ::testing::Values(Light{"OfThreeTenths", 0.003, 11}, Light{"OfThreeTenthsAgain", 0.003, 12},
                                           Light{"OfHalf", 0.005, 13}),
                         [](const auto& i) { return std::string(i.param.name); });

TEST(Machines, BelowTheLeastDampingAreNamed) {
  Recording r = simulated(bridge(), 600.0, dt, 7, 0.05);
  add_machine(r, 60.0, 120.0, 1.0);
  const SsiResult result = identify_modes({r});
  const auto aside = std::find_if(result.set_aside.begin(), result.set_aside.end(),
                                  [](const RejectedMode& m) { return std::abs(m.mode.frequency - hum) < 0.02; });
  ASSERT_NE(aside, result.set_aside.end());
  EXPECT_TRUE(aside->mode.intermittent);
  EXPECT_NE(aside->reason.find("intermittent machine"), std::string::npos) << aside->reason;
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
