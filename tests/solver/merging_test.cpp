// Setups put together: what becomes of their standard deviations, and one model of all against mode by mode.
#include <gtest/gtest.h>

#include <algorithm>

#include "solver/base/error.h"
#include "solver/identify/setups.h"
#include "tests/solver/modal_models.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

/// A setup that found one mode, each component wrong by a complex number of standard deviation `sigma`.
SsiResult found(const std::vector<std::string>& channels, const Eigen::VectorXd& truth, double sigma, Normal& normal) {
  const Eigen::Index n = truth.size();
  Eigen::VectorXcd raw(n);
  for (Eigen::Index i = 0; i < n; ++i)
    raw[i] = truth[i] + sigma * std::sqrt(0.5) * std::complex<double>(normal(), normal());
  Eigen::Index unit = 0;
  truth.cwiseAbs().maxCoeff(&unit);
  SsiResult result;
  result.channels = channels;
  result.duration = 600.0;
  IdentifiedMode mode;
  mode.frequency = 2.0;
  mode.damping = 0.01;
  mode.frequency_std = mode.damping_std = 1e-3;
  mode.shape = raw / std::complex<double>(raw[unit]);
  // To first order: what an error at each channel does to all components.
  mode.shape_changes = Eigen::MatrixXcd::Zero(n, n);
  for (Eigen::Index c = 0; c < n; ++c) {
    mode.shape_changes(c, c) += sigma / raw[unit];
    if (c == unit) mode.shape_changes.col(c) -= sigma * raw / (raw[unit] * raw[unit]);
  }
  mode.shape_std = mode.shape_changes.rowwise().norm();
  result.modes.push_back(mode);
  return result;
}

/// Ratio of the standard deviation of the merged shape over many draws to the one that is reported, by component.
Eigen::VectorXd scatter_over_reported(const Eigen::VectorXd& truth, double sigma, int draws) {
  const std::vector<std::string> first = {"r1", "r2", "a", "b", "c"}, second = {"r1", "r2", "d", "e", "f"};
  const std::vector<Setup> setups = {{{}, "one"}, {{}, "two"}};
  const Eigen::VectorXd one = truth.head(5), two = truth({0, 1, 5, 6, 7});
  Normal normal(17);
  Eigen::VectorXcd sum = Eigen::VectorXcd::Zero(8);
  Eigen::VectorXd squares = Eigen::VectorXd::Zero(8), reported = squares;
  for (int draw = 0; draw < draws; ++draw) {
    const SsiResult all = merged(setups, {found(first, one, sigma, normal), found(second, two, sigma, normal)});
    if (all.modes.size() != 1u) throw RunError("draw {}: {} modes", draw, all.modes.size());
    sum += all.modes[0].shape;
    squares += all.modes[0].shape.cwiseAbs2();
    reported += all.modes[0].shape_std.cwiseAbs2();
  }
  const Eigen::VectorXd variance = squares / draws - (sum / draws).cwiseAbs2();
  return (variance.cwiseQuotient(reported / draws)).cwiseSqrt();
}

TEST(Merging, StandardDeviationsOfShapesAreThoseOfAMonteCarlo) {
  Eigen::VectorXd sure(8), weak(8);
  sure << 0.7, -0.5, 0.3, 1.0, -0.2, 0.6, 0.1, -0.4;  // references that move
  weak << 0.15, 0.1, 0.3, 1.0, -0.2, 0.6, 0.1, -0.4;  // references that hardly do: the scale is what is uncertain
  for (const Eigen::VectorXd& truth : {sure, weak}) {
    const Eigen::VectorXd ratio = scatter_over_reported(truth, 0.02, 2000);
    std::printf("  scatter over reported:");
    for (Eigen::Index i = 0; i < 8; ++i) std::printf(" %.3f", ratio[i]);
    std::printf("\n");
    for (Eigen::Index i = 0; i < 8; ++i) {
      if (i == 3) continue;
      EXPECT_NEAR(ratio[i], 1.0, 0.08) << i;
    }
  }
}

TEST(Merging, TheComponentThatIsOneHasNoDeviation) {
  Eigen::VectorXd truth(8);
  truth << 0.7, -0.5, 0.3, 1.0, -0.2, 0.6, 0.1, -0.4;
  Normal normal(3);
  const SsiResult all =
      merged({{{}, "one"}, {{}, "two"}}, {found({"r1", "r2", "a", "b", "c"}, truth.head(5), 0.02, normal),
                                          found({"r1", "r2", "d", "e", "f"}, truth({0, 1, 5, 6, 7}), 0.02, normal)});
  EXPECT_EQ(all.modes[0].shape[3], 1.0);
  EXPECT_EQ(all.modes[0].shape_std[3], 0.0);
  EXPECT_EQ(all.modes[0].shape_changes.cols(), 10);
  for (const Eigen::Index i : {0, 1, 2, 4, 5, 6, 7}) EXPECT_GT(all.modes[0].shape_std[i], 0.005);
}

const ModalModel& structure() {
  static const ModalModel model = {{2.1, 3.9, 5.2, 7.1}, {0.010, 0.012, 0.015, 0.012}, sines(9, 4)};
  return model;
}

/// `count` setups with the references 2 and 6, each of its share of the other channels; frequencies and size of each
/// next one are so many times those before.
std::vector<Recording> roving(int count, double seconds, double stiffer = 1.0, double louder = 1.0,
                              std::uint64_t seed = 0) {
  std::vector<Recording> recordings;
  ModalModel model = structure();
  double size = 1.0;
  for (int j = 0; j < count; ++j) {
    const Recording whole = simulated(model, seconds, 0.04, 40 + std::uint64_t(j) + seed, 0.05);
    std::vector<Eigen::Index> channels = {2, 6};
    for (Eigen::Index c = 9 * j / count; c < 9 * (j + 1) / count; ++c)
      if (c != 2 && c != 6) channels.push_back(c);
    recordings.push_back(
        {fmt::format("records/{}.csv", j + 1), whole.dt, {}, size * whole.values(Eigen::all, channels)});
    for (const Eigen::Index c : channels) recordings.back().channels.push_back(whole.channels[std::size_t(c)]);
    for (double& f : model.frequency) f *= stiffer;
    size *= louder;
  }
  return recordings;
}

/// Few block rows: quick.
SsiSettings quick(SsiSettings::Merging merging) {
  SsiSettings settings;
  settings.merging = merging;
  settings.lowest_frequency = 1.0;
  settings.largest_order = 30;
  return settings;
}

/// MAC of a mode of the structure with the one that was found most like it, and that one's frequency; 0 where there is
/// none.
std::pair<double, double> best_likeness(const SsiResult& result, std::size_t m) {
  std::pair<double, double> best = {0.0, 0.0};
  for (const IdentifiedMode& mode : result.modes) {
    if (std::abs(mode.frequency - structure().frequency[m]) > 0.03 * structure().frequency[m]) continue;
    Eigen::VectorXcd shape = Eigen::VectorXcd::Zero(9);
    for (std::size_t c = 0; c < result.channels.size(); ++c)
      if (std::isfinite(mode.shape[Eigen::Index(c)].real()))
        shape[std::stol(result.channels[c].substr(1))] = mode.shape[Eigen::Index(c)];
    const Eigen::VectorXcd known = structure().shapes.col(Eigen::Index(m)).cast<std::complex<double>>();
    best = std::max(best, {assurance(shape, known), mode.frequency});
  }
  return best;
}

TEST(Merging, OneModelHoldsSetupsOfDifferentLoudness) {
  const SsiResult result = identify_modes(roving(3, 200.0, 1.0, 4.0), quick(SsiSettings::Merging::before));
  EXPECT_TRUE(result.joint);
  EXPECT_EQ(result.setups, 3);
  EXPECT_EQ(result.channels.size(), 9u);
  EXPECT_EQ(result.references.size(), 2u);
  ASSERT_EQ(result.modes.size(), 4u);
  for (std::size_t m = 0; m < 4; ++m) {
    const IdentifiedMode& mode = result.modes[m];
    std::printf("  %.4f +- %.4f Hz, damping %.4f +- %.4f, %d hits\n", mode.frequency, mode.frequency_std, mode.damping,
                mode.damping_std, mode.hits);
    EXPECT_NEAR(mode.frequency, structure().frequency[m], 5.0 * mode.frequency_std);
    EXPECT_NEAR(mode.damping, structure().damping[m], 5.0 * mode.damping_std);
    EXPECT_GT(best_likeness(result, m).first, 0.98);
  }
}

TEST(Merging, OneModelRepeatsToTheBit) {
  const std::vector<Recording> recordings = roving(2, 100.0);
  const SsiResult a = identify_modes(recordings, quick(SsiSettings::Merging::before)),
                  b = identify_modes(recordings, quick(SsiSettings::Merging::before));
  ASSERT_EQ(a.modes.size(), b.modes.size());
  for (std::size_t m = 0; m < a.modes.size(); ++m) EXPECT_EQ(a.modes[m].shape, b.modes[m].shape);
}

TEST(Merging, OneModelNeedsACommonReference) {
  std::vector<Recording> recordings = roving(3, 100.0);
  recordings[2].channels[0] = "x2";  // the first two share both references, the last one shares one only
  recordings[1].channels[1] = "x6";
  const std::string text = [&] {
    try {
      identify_modes(recordings, quick(SsiSettings::Merging::before));
    } catch (const InputError& error) {
      return std::string(error.what());
    }
    return std::string();
  }();
  EXPECT_NE(text.find("no channel is usable in all 3 setups"), std::string::npos) << text;
}

TEST(Merging, SetupsOfAnotherDayGoModeByMode) {
  const SsiResult same = identify_modes(roving(2, 200.0), quick(SsiSettings::Merging::after)),
                  other = identify_modes(roving(2, 200.0, 1.02), quick(SsiSettings::Merging::automatic));
  std::printf("  apart %.2f and %.2f\n", same.apart, other.apart);
  EXPECT_LT(same.apart, 2.0);
  EXPECT_GT(other.apart, 2.0);
  EXPECT_FALSE(other.joint);
}

/// Errors of the modes that were found, over some recordings of the same structure.
struct Errors {
  int found = 0;
  double frequency = 0.0, unlike = 0.0;  // root mean square, share; mean of 1 − MAC
};

Errors errors_of(SsiSettings::Merging merging, int count, double seconds, double stiffer, std::uint64_t runs) {
  Errors errors;
  for (std::uint64_t run = 0; run < runs; ++run) {
    const SsiResult result = identify_modes(roving(count, seconds, stiffer, 1.0, 1000 * run), quick(merging));
    for (std::size_t m = 0; m < structure().frequency.size(); ++m) {
      const double expected = structure().frequency[m] * (1.0 + (stiffer - 1.0) * 0.5 * (count - 1));
      const auto [likeness, frequency] = best_likeness(result, m);
      if (likeness < 0.8) continue;
      ++errors.found;
      errors.frequency += std::pow(frequency / expected - 1.0, 2);
      errors.unlike += 1.0 - likeness;
    }
  }
  errors.frequency = std::sqrt(errors.frequency / errors.found);
  errors.unlike /= errors.found;
  return errors;
}

/// The table of docs/theory/identification.md: which way is better when.
TEST(Merging, BothWaysSideBySide) {
  struct Scene {
    const char* name;
    int count;
    double seconds, stiffer;
  };
  for (const Scene& s : {Scene{"2 setups of 200 s", 2, 200.0, 1.0}, Scene{"4 setups of 60 s", 4, 60.0, 1.0},
                         Scene{"2 setups of 200 s, the second 1 % higher", 2, 200.0, 1.01}}) {
    const Errors after = errors_of(SsiSettings::Merging::after, s.count, s.seconds, s.stiffer, 3),
                 before = errors_of(SsiSettings::Merging::before, s.count, s.seconds, s.stiffer, 3);
    std::printf("  %s: PoSER %d of 12 modes, %.2f %%, 1 - MAC %.4f; PreGER %d of 12, %.2f %%, %.4f\n", s.name,
                after.found, 100.0 * after.frequency, after.unlike, before.found, 100.0 * before.frequency,
                before.unlike);
    EXPECT_GE(after.found, 9);
    EXPECT_GE(before.found, 9);
    EXPECT_LT(after.unlike, 0.02);
    EXPECT_LT(before.unlike, 0.03);
  }
}

TEST(Merging, ARecordingTooShortIsNamed) {
  std::vector<Recording> recordings = {simulated(structure(), 200.0, 0.04, 5, 0.05),
                                       simulated(structure(), 200.0, 0.04, 6, 0.05)};
  recordings[1].name = "short";
  recordings[1].values.conservativeResize(70, Eigen::NoChange);
  SsiSettings settings = quick(SsiSettings::Merging::automatic);
  settings.block_rows = 40;
  const SsiResult result = identify_modes(recordings, settings);
  ASSERT_EQ(result.too_short.size(), 1u);
  EXPECT_EQ(result.too_short[0].name, "short");
  EXPECT_EQ(result.too_short[0].reason, "it has 2.76 s, but the correlations need more than 3.16 s");
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
