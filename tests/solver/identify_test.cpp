// Identification against signals of known modal models. Numbers are printed: docs/theory/identification.md quotes them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <limits>
#include <numbers>

#include "solver/base/error.h"
#include "solver/identify/fdd.h"
#include "solver/identify/ssi.h"
#include "solver/identify/transfer.h"
#include "tests/solver/modal_models.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

constexpr double pi = std::numbers::pi;

double likeness(const Eigen::VectorXcd& shape, const Eigen::VectorXd& known) {
  return assurance(shape, Eigen::VectorXcd(known.cast<std::complex<double>>()));
}

/// The mode of that frequency and shape (NaN components taken from the known shape), null when there is none.
const IdentifiedMode* find(const SsiResult& result, double frequency, const Eigen::VectorXd& known) {
  const IdentifiedMode* best = nullptr;
  for (const IdentifiedMode& mode : result.modes) {
    if (std::abs(mode.frequency - frequency) > 0.02 * frequency || likeness(mode.shape, known) < 0.8) continue;
    if (!best || std::abs(mode.frequency - frequency) < std::abs(best->frequency - frequency)) best = &mode;
  }
  return best;
}

void expect_modes(const SsiResult& result, const ModalModel& model, double least_assurance) {
  EXPECT_EQ(result.modes.size(), model.frequency.size());
  for (std::size_t m = 0; m < model.frequency.size(); ++m) {
    const double f = model.frequency[m], z = model.damping[m];
    const IdentifiedMode* mode = find(result, f, model.shapes.col(Eigen::Index(m)));
    ASSERT_TRUE(mode) << f << " Hz";
    const double mac = likeness(mode->shape, model.shapes.col(Eigen::Index(m)));
    std::printf("  %.3f Hz: found %.4f ± %.4f Hz, damping %.4f, found %.4f ± %.4f, MAC %.5f, %d hits\n", f,
                mode->frequency, mode->frequency_std, z, mode->damping, mode->damping_std, mac, mode->hits);
    EXPECT_NEAR(mode->frequency, f, 0.005 * f);
    EXPECT_NEAR(mode->frequency, f, 4.0 * mode->frequency_std);
    EXPECT_NEAR(mode->damping, z, 3.0 * mode->damping_std);
    EXPECT_GT(mac, least_assurance);
    EXPECT_FALSE(mode->harmonic);
  }
}

const ModalModel& beam() {
  static const ModalModel model = {
      {2.1, 3.4, 4.6, 7.3, 9.9, 13.2}, {0.01, 0.015, 0.012, 0.01, 0.02, 0.015}, sines(8, 6)};
  return model;
}

TEST(Identify, FindsTheModesOfABeam) {
  const SsiResult result = identify_modes({simulated(beam(), 600.0, 0.01, 1, 0.1)});
  expect_modes(result, beam(), 0.99);
  EXPECT_TRUE(result.poor.empty());
  EXPECT_NEAR(result.dt, 0.02, 1e-12);
  EXPECT_EQ(result.settings.highest_frequency, 20.0);
  for (const IdentifiedMode& mode : result.modes) {
    EXPECT_GT(mode.mean_phase, 0.95);
    EXPECT_NEAR(mode.shape.cwiseAbs().maxCoeff(), 1.0, 1e-12);
    EXPECT_LT(mode.shape_std.maxCoeff(), 0.2);
  }
}

TEST(Identify, TellsCloseModesApart) {
  ModalModel model = {{3.0, 3.03}, {0.004, 0.004}, Eigen::MatrixXd(4, 2)};
  model.shapes << 1.0, 1.0, 1.0, -1.0, 0.5, 0.5, 0.3, -0.3;
  expect_modes(identify_modes({simulated(model, 1200.0, 0.02, 3, 0.1)}), model, 0.99);
}

TEST(Identify, FindsLowDampingWithThreeTwoAndOneChannels) {
  for (const Eigen::Index channels : {3, 2, 1}) {
    ModalModel model = {{2.0, 5.0, 8.0}, {0.003, 0.003, 0.02}, sines(3, 3).topRows(channels)};
    expect_modes(identify_modes({simulated(model, 1200.0, 0.02, 5, 0.05)}), model, 0.99);
  }
}

TEST(Identify, SetsAHarmonicAside) {
  Recording r = simulated(beam(), 600.0, 0.01, 7, 0.1);
  const double size = std::sqrt(r.values.squaredNorm() / double(r.values.size()));
  for (Eigen::Index i = 0; i < r.values.rows(); ++i)
    for (Eigen::Index c = 0; c < r.values.cols(); ++c)
      r.values(i, c) += (0.3 + 0.05 * double(c)) * size * std::sin(2.0 * pi * 6.0 * 0.01 * double(i));
  const SsiResult result = identify_modes({r});
  expect_modes(result, beam(), 0.99);
  int harmonics = 0;
  for (const RejectedMode& aside : result.set_aside) {
    if (!aside.mode.harmonic) continue;
    ++harmonics;
    EXPECT_NEAR(aside.mode.frequency, 6.0, 0.01);
    EXPECT_NEAR(aside.mode.kurtosis, 1.5, 0.2);
    EXPECT_NE(aside.reason.find("harmonic"), std::string::npos);
    std::printf("  harmonic at %.4f Hz, damping %.6f, kurtosis %.2f\n", aside.mode.frequency, aside.mode.damping,
                aside.mode.kurtosis);
  }
  EXPECT_EQ(harmonics, 1);
}

TEST(Identify, LeavesOutPoorChannelsAndTheGround) {
  Recording r = simulated(beam(), 300.0, 0.01, 9, 0.1);
  Normal normal(99);
  r.values.conservativeResize(Eigen::NoChange, 11);
  r.values.col(8).setConstant(0.02);
  for (Eigen::Index i = 0; i < r.values.rows(); ++i) {
    r.values(i, 9) = 3.0 * normal();
    r.values(i, 10) = normal();
  }
  for (const char* name : {"dead", "noisy", "base_x"}) r.channels.emplace_back(name);
  const SsiResult result = identify_modes({r});
  ASSERT_EQ(result.poor.size(), 3U);
  EXPECT_EQ(result.poor[0].channel, 8);
  EXPECT_EQ(result.poor[0].reason, "it does not move");
  EXPECT_EQ(result.poor[1].channel, 9);
  EXPECT_NE(result.poor[1].reason.find("coherence"), std::string::npos);
  EXPECT_EQ(result.poor[2].channel, 10);
  EXPECT_EQ(result.modes.size(), 6U);
  for (const IdentifiedMode& mode : result.modes) {
    ASSERT_EQ(mode.shape.size(), 11);
    for (const Eigen::Index c : {8, 9, 10})
      EXPECT_TRUE(std::isnan(mode.shape[c].real()) && std::isnan(mode.shape_std[c]));
    EXPECT_FALSE(std::isnan(mode.shape[0].real()));
  }
}

TEST(Identify, FindsNoModesInNoise) {
  Recording r = {.name = "noise", .dt = 0.02, .channels = {"a"}, .values = Eigen::MatrixXd(15000, 1)};
  Normal normal(4);
  for (double& x : r.values.reshaped()) x = normal();
  EXPECT_TRUE(identify_modes({r}).modes.empty());
}

TEST(Identify, JoinsRecordingsOfTheSameSensors) {
  Recording a = simulated(beam(), 200.0, 0.02, 11, 0.1), b = simulated(beam(), 400.0, 0.02, 12, 0.1);
  // The second lacks a sensor and has the others in another order.
  b.channels = {"s7", "s6", "s5", "s4", "s3", "s2", "s1", "elsewhere"};
  b.values = Eigen::MatrixXd(b.values.rowwise().reverse());
  const SsiResult result = identify_modes({a, b});
  EXPECT_EQ(result.channels, (std::vector<std::string>{"s1", "s2", "s3", "s4", "s5", "s6", "s7"}));
  ModalModel model = beam();
  model.shapes = Eigen::MatrixXd(beam().shapes.bottomRows(7));
  expect_modes(result, model, 0.99);
  EXPECT_NEAR(result.duration, 600.0, 1.0);
}

TEST(Identify, RepeatsToTheBit) {
  const ModalModel model = {{2.0, 5.0}, {0.01, 0.02}, sines(3, 2)};
  const Recording r = simulated(model, 100.0, 0.02, 13, 0.1);
  const SsiResult a = identify_modes({r}), b = identify_modes({r});
  ASSERT_EQ(a.modes.size(), 2U);
  ASSERT_EQ(b.modes.size(), 2U);
  for (std::size_t m = 0; m < a.modes.size(); ++m) {
    EXPECT_EQ(a.modes[m].frequency, b.modes[m].frequency);
    EXPECT_EQ(a.modes[m].damping_std, b.modes[m].damping_std);
    EXPECT_EQ(a.modes[m].shape, b.modes[m].shape);
  }
}

/// Scatter of what different recordings of one structure give, against the standard deviation each reports.
TEST(Identify, StandardDeviationsAreHonest) {
  constexpr int seeds = 16;
  const ModalModel model = {{2.0, 3.7, 8.0}, {0.01, 0.01, 0.02}, sines(3, 3)};
  const std::size_t modes = model.frequency.size();
  Eigen::ArrayXXd f(seeds, modes), z(seeds, modes), f_std(seeds, modes), z_std(seeds, modes);
  for (int seed = 0; seed < seeds; ++seed) {
    const SsiResult result = identify_modes({simulated(model, 300.0, 0.02, 1000 + std::uint64_t(seed), 0.1)});
    for (std::size_t m = 0; m < modes; ++m) {
      const IdentifiedMode* mode = find(result, model.frequency[m], model.shapes.col(Eigen::Index(m)));
      ASSERT_TRUE(mode) << "seed " << seed << ", " << model.frequency[m] << " Hz";
      const auto k = Eigen::Index(m);
      f(seed, k) = mode->frequency;
      z(seed, k) = mode->damping;
      f_std(seed, k) = mode->frequency_std;
      z_std(seed, k) = mode->damping_std;
    }
  }
  const auto scatter = [](const auto& x) {
    return std::sqrt((x - x.mean()).square().sum() / (double(x.size()) - 1.0));
  };
  for (Eigen::Index m = 0; m < Eigen::Index(modes); ++m) {
    const double of_f = f_std.col(m).mean() / scatter(f.col(m)), of_z = z_std.col(m).mean() / scatter(z.col(m));
    std::printf("  %.1f Hz: standard deviation reported over scatter of %d recordings: frequency %.2f, damping %.2f\n",
                model.frequency[std::size_t(m)], seeds, of_f, of_z);
    EXPECT_GT(of_f, 0.5);
    EXPECT_LT(of_f, 2.0);
    EXPECT_GT(of_z, 0.5);
    EXPECT_LT(of_z, 2.0);
    const double bias = z.col(m).mean() - model.damping[std::size_t(m)];
    EXPECT_LT(std::abs(bias), 2.0 * scatter(z.col(m)));
  }
}

TEST(Identify, AgreesWithFrequencyDomainDecomposition) {
  const Recording r = simulated(beam(), 600.0, 0.01, 15, 0.1);
  const SsiResult result = identify_modes({r});
  const Fdd fdd = decompose_spectra({r});
  ASSERT_EQ(result.modes.size(), 6U);
  EXPECT_GT((fdd.singular.col(0) - fdd.singular.col(1)).minCoeff(), -1e-30);
  for (const IdentifiedMode& mode : result.modes) {
    const FddPeak plain = peak_near(fdd, mode.frequency), peak = peak_near(fdd, mode.frequency, mode.shape);
    ASSERT_TRUE(plain.found && peak.found);
    std::printf("  SSI %.4f Hz, FDD %.4f Hz, MAC %.4f\n", mode.frequency, peak.frequency, peak.assurance);
    EXPECT_NEAR(peak.frequency, mode.frequency, 0.01 * mode.frequency + 1.0 / fdd.window);
    EXPECT_GT(peak.assurance, 0.95);
    EXPECT_GT(assurance(plain.shape, mode.shape), 0.95);
  }
  EXPECT_FALSE(peak_near(fdd, 100.0).found);
  EXPECT_THROW(peak_near(fdd, 3.0, Eigen::VectorXcd::Ones(3)), InputError);
}

/// A white sequence's power per Hz is 2 σ² dt, one-sided.
TEST(Identify, WelchSpectraHaveTheirDensity) {
  Recording r = {.name = "noise", .dt = 0.02, .channels = {"a"}, .values = Eigen::MatrixXd(200000, 1)};
  Normal normal(5);
  for (double& x : r.values.reshaped()) x = 3.0 * normal();
  const Fdd fdd = decompose_spectra({r}, {.highest_frequency = 20.0, .window = 5.0});
  EXPECT_NEAR(fdd.singular.col(0).segment(2, fdd.singular.rows() - 4).mean(), 2.0 * 9.0 * 0.02, 0.005 * 0.36);
}

/// Accelerations of a chain of three masses on a base that moves along one axis; absolute, as sensors have them.
struct Chain {
  Eigen::Matrix3d stiffness, damping;  // over the mass
  Chain() {
    const double k = 900.0;
    stiffness << 2.0 * k, -k, 0.0, -k, 2.0 * k, -k, 0.0, -k, k;
    damping = 1.0 * Eigen::Matrix3d::Identity() + 0.002 * stiffness;
  }
  /// 1 + ω² (K + iωC − ω²)⁻¹ 1.
  Eigen::Vector3cd closed_form(double frequency) const {
    const double w = 2.0 * pi * frequency;
    const Eigen::Matrix3cd dynamic = stiffness.cast<std::complex<double>>() + std::complex<double>(0.0, w) * damping -
                                     w * w * Eigen::Matrix3cd::Identity();
    const Eigen::Vector3cd ones = Eigen::Vector3cd::Ones();
    return ones + w * w * dynamic.partialPivLu().solve(ones);
  }
  /// Runge & Kutta with the base's acceleration straight between samples: an error of (ω dt)⁴ / 120.
  Eigen::MatrixXd response(const Eigen::VectorXd& base, double dt) const {
    Eigen::Matrix<double, 6, 1> x = Eigen::Matrix<double, 6, 1>::Zero();
    const auto rate = [&](const Eigen::Matrix<double, 6, 1>& at, double a) {
      Eigen::Matrix<double, 6, 1> v;
      v << at.tail<3>(), -stiffness * at.head<3>() - damping * at.tail<3>() - a * Eigen::Vector3d::Ones();
      return v;
    };
    Eigen::MatrixXd y(base.size(), 3);
    for (Eigen::Index i = 0; i < base.size(); ++i) {
      y.row(i) = (-stiffness * x.head<3>() - damping * x.tail<3>()).transpose();
      if (i + 1 == base.size()) break;
      const double half = 0.5 * (base[i] + base[i + 1]);
      const auto k1 = rate(x, base[i]), k2 = rate(x + 0.5 * dt * k1, half), k3 = rate(x + 0.5 * dt * k2, half),
                 k4 = rate(x + dt * k3, base[i + 1]);
      x += dt / 6.0 * (k1 + 2.0 * k2 + 2.0 * k3 + k4);
    }
    return y;
  }
};

/// Noise without what is above some 15 Hz: straight between samples is then what it is.
Eigen::VectorXd smooth_noise(Eigen::Index n, std::uint64_t seed) {
  Normal normal(seed);
  Eigen::VectorXd x(n);
  double a = 0.0, b = 0.0;
  for (double& v : x) {
    a += 0.3 * (normal() - a);
    b += 0.3 * (a - b);
    v = b;
  }
  return x;
}

TEST(Transfer, OfAChainOnAMovingBaseIsTheClosedForm) {
  const Chain chain;
  const double dt = 0.005;
  const Eigen::Index n = 240000;
  const Eigen::VectorXd x = smooth_noise(n, 21), y = 0.5 * smooth_noise(n, 22) + 0.4 * x;
  Recording r = {.name = "chain", .dt = dt, .channels = {"base_x", "first", "second", "third", "base_y"}, .values = {}};
  r.values.resize(n, 5);
  // The second input reaches the third sensor alone: twice the motion itself.
  r.values << x, chain.response(x, dt), y;
  r.values.col(3) += 2.0 * y;
  Normal normal(23);
  for (Eigen::Index i = 0; i < n; ++i) r.values(i, 1) += 0.05 * normal();
  const TransferFunctions t = transfer_functions({r}, {.highest_frequency = 12.0, .window = 42.0});
  ASSERT_EQ(t.inputs, (std::vector<std::string>{"base_x", "base_y"}));
  ASSERT_EQ(t.outputs, (std::vector<std::string>{"first", "second", "third"}));
  double worst = 0.0, normalised = 0.0;
  int lines = 0;
  for (Eigen::Index k = 0; k < t.frequencies.size(); ++k) {
    if (t.frequencies[k] < 0.5) continue;
    const Eigen::Vector3cd exact = chain.closed_form(t.frequencies[k]);
    const Eigen::MatrixXcd& h = t.values[std::size_t(k)];
    for (const Eigen::Index i : {1, 2})
      worst = std::max(worst, std::abs(h(i, 0) - exact[i]) / std::max(1.0, std::abs(exact[i])));
    // Of what the first input does to the third sensor some leaks into the second's: the standard deviation knows.
    EXPECT_LT(std::abs(h(2, 1) - 2.0), 0.05 + 5.0 * t.magnitude_std[std::size_t(k)](2, 1)) << t.frequencies[k] << " Hz";
    EXPECT_GT(t.coherence(k, 1), 0.97) << t.frequencies[k] << " Hz";
    normalised += std::pow((std::abs(h(0, 0)) - std::abs(exact[0])) / t.magnitude_std[std::size_t(k)](0, 0), 2.0);
    ++lines;
  }
  const double ratio = std::sqrt(normalised / lines);
  std::printf("  worst error of H %.3f of it, scatter of |H| with noise over reported %.2f, %.0f averages\n", worst,
              ratio, t.averages);
  EXPECT_LT(worst, 0.1);
  EXPECT_GT(ratio, 0.5);
  EXPECT_LT(ratio, 2.0);
}

/// The text of an InputError, empty when none was thrown.
template <class Work>
std::string refusal(Work&& work) {
  try {
    work();
  } catch (const InputError& e) {
    return e.what();
  }
  return {};
}

TEST(Identify, RefusesWhatCannotBe) {
  const Recording good = simulated(beam(), 60.0, 0.02, 31, 0.1);
  const auto refused = [](const Recording& r, const char* words, const SsiSettings& settings = {}) {
    for (const auto& text :
         {refusal([&] { identify_modes({r}, settings); }),
          settings.highest_frequency == 0.0 ? refusal([&] { transfer_functions({r}); }) : std::string(words)})
      EXPECT_NE(text.find(words), std::string::npos) << text;
  };
  EXPECT_NE(refusal([] { identify_modes({}); }).find("Give at least one"), std::string::npos);
  Recording r = good;
  r.dt = 0.0;
  refused(r, "must be above 0");
  r.dt = -0.01;
  refused(r, "must be above 0");
  r = good;
  r.values(17, 2) = std::numeric_limits<double>::quiet_NaN();
  refused(r, "sample 18 is nan");
  r = good;
  r.values = Eigen::MatrixXd(good.values.topRows(1));
  refused(r, "At least 2 samples");
  r.values = Eigen::MatrixXd(good.values.topRows(50));
  refused(r, "Record for longer");
  r = good;
  r.channels[3] = "s0";
  refused(r, "two channels have the name 's0'");
  r.channels.pop_back();
  refused(r, "8 columns but 7 channel names");
  refused(good, "at most 22.5 Hz", {.highest_frequency = 30.0});
  refused(good, "must be below the highest", {.highest_frequency = 10.0, .lowest_frequency = 12.0});
  refused(good, "Modes at 0.01 Hz need at least", {.highest_frequency = 10.0, .lowest_frequency = 0.01});
  refused(good, "Choose at most", {.highest_frequency = 10.0, .block_rows = 5000});
  refused(good, "'segments' is 1", {.highest_frequency = 10.0, .segments = 1});
  Recording other = good;
  other.dt = 0.01;
  EXPECT_NE(refusal([&] { identify_modes({good, other}); }).find("Resample"), std::string::npos);
  other.dt = 0.02;
  for (std::string& name : other.channels) name += "'";
  EXPECT_NE(refusal([&] { identify_modes({good, other}); }).find("no channel in common"), std::string::npos);
  r = good;
  r.values.setZero();
  EXPECT_NE(refusal([&] { identify_modes({r}); }).find("no channel is usable"), std::string::npos);
}

TEST(Transfer, RefusesWhatCannotBe) {
  Recording r = simulated(beam(), 60.0, 0.02, 33, 0.1);
  EXPECT_NE(refusal([&] { transfer_functions({r}); }).find("no channel base_x"), std::string::npos);
  r.channels[0] = "base_x";
  r.channels[1] = "base_y";
  EXPECT_EQ(refusal([&] { transfer_functions({r}); }), "");
  EXPECT_NE(refusal([&] { transfer_functions({r}, {.window = 55.0}); }).find("shorter window"), std::string::npos);
  r.values.col(1) = -2.0 * r.values.col(0);
  EXPECT_NE(refusal([&] { transfer_functions({r}); }).find("are proportional to each other"), std::string::npos);
  r.channels = {"base_x", "a", "b", "c", "d", "e", "f", "g"};
  r.values.col(0).setZero();
  EXPECT_NE(refusal([&] { transfer_functions({r}); }).find("no channel base_x"), std::string::npos);
}

/// Twenty minutes of forty channels: printed, and far from what would be slow.
TEST(Identify, IsQuickWithFortyChannels) {
  const ModalModel model = {{2.1, 3.4, 4.6, 7.3, 9.9, 13.2}, {0.01, 0.015, 0.012, 0.01, 0.02, 0.015}, sines(40, 6)};
  const Recording r = simulated(model, 300.0, 0.01, 41, 0.1);
  Recording longer = r;
  longer.values = Eigen::MatrixXd(r.values.replicate(4, 1));
  const auto start = std::chrono::steady_clock::now();
  const SsiResult result = identify_modes({longer});
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  std::printf("  20 minutes of 40 channels at 100 Hz: %.1f s\n", seconds);
  EXPECT_EQ(result.modes.size(), 6U);
  EXPECT_EQ(result.references.size(), 8U);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
