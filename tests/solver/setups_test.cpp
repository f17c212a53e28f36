// One structure, several setups: shapes of the whole from sensors that were moved, by those that stayed.
#include "solver/identify/setups.h"

#include <gtest/gtest.h>

#include <algorithm>

#include "solver/base/error.h"
#include "tests/solver/modal_models.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

const ModalModel& beam() {
  static const ModalModel model = {
      {2.1, 3.9, 5.2, 6.7, 7.1, 9.4}, {0.010, 0.012, 0.015, 0.012, 0.012, 0.02}, sines(20, 6)};
  return model;
}

/// The channels of these numbers, of a recording of its own.
Recording setup(const std::string& name, const std::vector<Eigen::Index>& channels, std::uint64_t seed) {
  const Recording whole = simulated(beam(), 600.0, 0.02, seed, 0.05);
  Recording r = {.name = name, .dt = whole.dt, .channels = {}, .values = whole.values(Eigen::all, channels)};
  for (const Eigen::Index c : channels) r.channels.push_back(whole.channels[std::size_t(c)]);
  return r;
}

std::vector<Eigen::Index> numbers(const std::vector<Eigen::Index>& references, Eigen::Index from, Eigen::Index to) {
  std::vector<Eigen::Index> all = references;
  for (Eigen::Index c = from; c < to; ++c)
    if (std::find(references.begin(), references.end(), c) == references.end()) all.push_back(c);
  return all;
}

/// MAC over all channels of the structure, in their own order.
double likeness(const SsiResult& result, const IdentifiedMode& mode, Eigen::Index m) {
  Eigen::VectorXcd shape = Eigen::VectorXcd::Zero(beam().shapes.rows());
  for (std::size_t c = 0; c < result.channels.size(); ++c)
    shape[std::stol(result.channels[c].substr(1))] = mode.shape[Eigen::Index(c)];
  return assurance(shape, Eigen::VectorXcd(beam().shapes.col(m).cast<std::complex<double>>()));
}

void expect_the_whole(const SsiResult& result, double least) {
  ASSERT_EQ(result.channels.size(), 20u);
  ASSERT_EQ(result.modes.size(), 6u);
  for (std::size_t m = 0; m < 6; ++m) {
    const IdentifiedMode& mode = result.modes[m];
    std::printf("  %.4f +- %.4f Hz, damping %.4f +- %.4f, MAC %.4f\n", mode.frequency, mode.frequency_std, mode.damping,
                mode.damping_std, likeness(result, mode, Eigen::Index(m)));
    EXPECT_NEAR(mode.frequency, beam().frequency[m], 0.005 * beam().frequency[m]);
    EXPECT_NEAR(mode.damping, beam().damping[m], 4.0 * mode.damping_std);
    EXPECT_GT(likeness(result, mode, Eigen::Index(m)), least);
    EXPECT_NEAR(mode.shape.cwiseAbs().maxCoeff(), 1.0, 1e-12);
  }
}

TEST(Setups, WithReferencesGiveShapesOfTheWhole) {
  const SsiResult result =
      identify_modes({setup("one", numbers({2, 5, 8}, 0, 9), 1), setup("two", numbers({2, 5, 8}, 9, 20), 2)});
  EXPECT_EQ(result.setups, 2);
  EXPECT_EQ(result.references.size(), 3u);
  EXPECT_NEAR(result.duration, 600.0, 2.0);  // of one setup
  expect_the_whole(result, 0.99);
}

TEST(Setups, OfThreeMayHandOnTheirReferences) {
  // The third shares its reference with the second alone.
  const SsiResult result =
      identify_modes({setup("one", numbers({2, 5, 8}, 0, 9), 1), setup("two", numbers({2, 5, 8}, 9, 15), 2),
                      setup("three", numbers({10, 13}, 15, 20), 3)});
  EXPECT_EQ(result.setups, 3);
  EXPECT_TRUE(result.references.empty());
  expect_the_whole(result, 0.98);
}

/// Setups of another day: 1 % stiffer in frequency. The mean says so in its standard deviation.
TEST(Setups, OfAnotherDayWidenTheDeviation) {
  Recording later = setup("two", numbers({2, 5, 8}, 9, 20), 2);
  later.dt /= 1.01;
  Recording first = setup("one", numbers({2, 5, 8}, 0, 9), 1);
  const std::vector<voussoir::Setup> setups = {{{first}, "one"}, {{later}, "two"}};
  const SsiResult result = merged(setups, {identify_modes({first}), identify_modes({later})});
  ASSERT_EQ(result.modes.size(), 6u);
  // Half of the difference where both setups are equally sure, three tenths of it at weights of nine to one.
  double mean = 0.0;
  for (std::size_t m = 0; m < 6; ++m) {
    EXPECT_NEAR(result.modes[m].frequency, 1.005 * beam().frequency[m], 0.007 * beam().frequency[m]);
    EXPECT_GT(result.modes[m].frequency_std, 0.002 * beam().frequency[m]);
    mean += result.modes[m].frequency_std / beam().frequency[m] / 6.0;
  }
  EXPECT_GT(mean, 0.003);
}

TEST(Setups, WithoutAReferenceAreRefused) {
  try {
    identify_modes({setup("one", numbers({}, 0, 9), 1), setup("two", numbers({}, 9, 20), 2)});
    FAIL() << "expected an error";
  } catch (const InputError& error) {
    const std::string text = error.what();
    for (const char* part : {"'two'", "no channel in common", "stay", "separately"})
      EXPECT_NE(text.find(part), std::string::npos) << text;
  }
}

TEST(Setups, RepeatToTheBit) {
  const std::vector<Recording> recordings = {setup("one", numbers({2, 5, 8}, 0, 9), 1),
                                             setup("two", numbers({2, 5, 8}, 9, 20), 2)};
  const SsiResult a = identify_modes(recordings), b = identify_modes(recordings);
  ASSERT_EQ(a.modes.size(), b.modes.size());
  for (std::size_t m = 0; m < a.modes.size(); ++m) EXPECT_EQ(a.modes[m].shape, b.modes[m].shape);
}

TEST(Setups, DroppedChannelsAreNamed) {
  Recording a = setup("one", numbers({}, 0, 9), 1), b = setup("two", numbers({}, 1, 9), 2);
  const std::vector<DroppedChannel> dropped = dropped_channels({a, b});
  ASSERT_EQ(dropped.size(), 1u);
  EXPECT_EQ(dropped[0].name, "s0");
  EXPECT_EQ(dropped[0].reason, "it is not in two");
  EXPECT_NO_THROW(check_in_common({a, b}));
  EXPECT_THROW(check_in_common({a, setup("far", numbers({8}, 9, 20), 2)}), InputError);
}

/// Two segments are too few for standard deviations.
TEST(Setups, WithoutDeviationsHaveNone) {
  SsiSettings settings;
  settings.segments = 2;
  const SsiResult result =
      identify_modes({setup("one", numbers({2, 5, 8}, 0, 9), 1), setup("two", numbers({2, 5, 8}, 9, 20), 2)}, settings);
  ASSERT_FALSE(result.modes.empty());
  for (const IdentifiedMode& mode : result.modes) {
    EXPECT_TRUE(std::isnan(mode.frequency_std)) << mode.frequency_std;
    EXPECT_TRUE(std::isnan(mode.damping_std)) << mode.damping_std;
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
