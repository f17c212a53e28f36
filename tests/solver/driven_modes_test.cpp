// Modes from transfer functions against known structures. Numbers are printed: docs/theory/identification.md quotes
// them.
#include "solver/identify/driven_modes.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <limits>

#include "solver/base/error.h"
#include "solver/identify/prepare.h"
#include "solver/identify/ssi.h"
#include "solver/identify/subspace.h"
#include "tests/solver/signals.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

constexpr double pi = std::numbers::pi;
constexpr double fine = 0.001;  // s, the simulation's step
constexpr int decimation = 10;  // samples of the simulation for one of the recording

/// ü = D a + Σ φ z̈, z̈ + 2ζω ż + ω² z = −Γ a.
struct Structure {
  std::vector<double> frequency, damping;  // Hz, ratio
  Eigen::MatrixXd shapes;                  // outputs × modes, the largest of each 1 in size
  Eigen::MatrixXd participation;           // modes × inputs
  Eigen::MatrixXd rigid;                   // D: outputs × inputs
};

Structure largest_one(Structure s) {
  for (Eigen::Index m = 0; m < s.shapes.cols(); ++m) s.shapes.col(m) /= s.shapes.col(m).cwiseAbs().maxCoeff();
  return s;
}

/// Shapes of a beam with a little of noise, so that none is symmetric.
Eigen::MatrixXd uneven_sines(Eigen::Index outputs, Eigen::Index modes) {
  Normal normal(77);
  Eigen::MatrixXd shapes(outputs, modes);
  for (Eigen::Index c = 0; c < outputs; ++c)
    for (Eigen::Index m = 0; m < modes; ++m)
      shapes(c, m) = std::sin(pi * double(m + 1) * double(c + 1) / double(outputs + 1)) + 0.1 * normal();
  return shapes;
}

Structure bridge(Eigen::Index outputs = 8) {
  Structure s = {.frequency = {2.1, 3.7, 5.6, 8.3, 11.4},
                 .damping = {0.02, 0.012, 0.03, 0.015, 0.04},
                 .shapes = uneven_sines(outputs, 5),
                 .participation = Eigen::MatrixXd(5, 2),
                 .rigid = Eigen::MatrixXd::Zero(outputs, 2)};
  s.participation << 1.3, 0.0, 0.2, 1.1, -0.6, 0.3, 0.4, 0.5, 0.3, -0.4;
  for (Eigen::Index c = 0; c < outputs; ++c) s.rigid(c, c % 2) = 1.0;
  return largest_one(s);
}

/// White motion of the ground under an envelope (of the time in s).
template <class Envelope>
Eigen::MatrixXd ground(Eigen::Index inputs, double duration, std::uint64_t seed, Envelope&& envelope) {
  Normal normal(seed);
  Eigen::MatrixXd a(Eigen::Index(duration / fine), inputs);
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index j = 0; j < inputs; ++j) a(i, j) = envelope(fine * double(i)) * normal();
  return a;
}
Eigen::MatrixXd white(Eigen::Index inputs, double duration, std::uint64_t seed) {
  return ground(inputs, duration, seed, [](double) { return 1.0; });
}

/// Absolute accelerations. The mean of the ground's at both ends of a step acts on the modes: no phase, and a
/// thousandth of the size at 12 Hz.
Eigen::MatrixXd accelerations(const Structure& s, const Eigen::MatrixXd& a) {
  std::vector<Oscillator> modes;
  for (std::size_t m = 0; m < s.frequency.size(); ++m) modes.emplace_back(s.frequency[m], s.damping[m], fine);
  Eigen::MatrixXd relative(a.rows(), s.shapes.cols());
  const Eigen::MatrixXd force = -a * s.participation.transpose();
  for (Eigen::Index i = 0; i < a.rows(); ++i)
    for (Eigen::Index m = 0; m < relative.cols(); ++m) {
      Oscillator& mode = modes[std::size_t(m)];
      relative(i, m) = mode.acceleration(force(i, m));
      mode.advance(0.5 * (force(i, m) + force(std::min(i + 1, a.rows() - 1), m)));
    }
  return a * s.rigid.transpose() + relative * s.shapes.transpose();
}

/// At 100 Hz, with noise of a share of each channel's root mean square; the ground's channels last.
Recording recorded(const Eigen::MatrixXd& outputs, const Eigen::MatrixXd& base, double noise, std::uint64_t seed) {
  Eigen::MatrixXd all(outputs.rows(), outputs.cols() + base.cols());
  all << outputs, base;
  Recording r = {.name = "simulated", .dt = fine * decimation, .channels = {}, .values = {}};
  r.values = decimated(all, fine, decimation, 40.0);
  for (Eigen::Index c = 0; c < outputs.cols(); ++c) r.channels.push_back(fmt::format("s{}", c));
  for (Eigen::Index c = 0; c < base.cols(); ++c) r.channels.push_back(fmt::format("base_{}", "xyz"[c]));
  Normal normal(seed);
  for (Eigen::Index c = 0; c < outputs.cols(); ++c) {
    const double size = noise * std::sqrt(r.values.col(c).squaredNorm() / double(r.values.rows()));
    for (double& x : r.values.col(c)) x += size * normal();
  }
  return r;
}

Recording recorded(const Structure& s, const Eigen::MatrixXd& base, double noise, std::uint64_t seed) {
  return recorded(accelerations(s, base), base, noise, seed);
}

double likeness(const DrivenMode& mode, const Structure& s, Eigen::Index m) {
  return assurance(mode.shape, Eigen::VectorXcd(s.shapes.col(m).cast<std::complex<double>>()));
}

const DrivenMode* find(const DrivenModes& result, const Structure& s, Eigen::Index m) {
  const DrivenMode* best = nullptr;
  for (const DrivenMode& mode : result.modes)
    if (std::abs(mode.frequency - s.frequency[std::size_t(m)]) < 0.04 * mode.frequency &&
        (!best || likeness(mode, s, m) > likeness(*best, s, m)))
      best = &mode;
  return best;
}

/// What is found less what is known, in standard deviations: frequency, damping, then the parts of the shape and of the
/// participations (what is known of these: complex, per input).
Eigen::VectorXd deviations(const DrivenMode& mode, const Structure& s, Eigen::Index m, Eigen::VectorXcd participation) {
  Eigen::VectorXd shape = s.shapes.col(m);
  if (shape.dot(mode.shape.real()) < 0.0) {
    shape *= -1.0;
    participation *= -1.0;
  }
  const Eigen::VectorXcd of_shape = mode.shape - shape, of_participation = mode.participation - participation;
  Eigen::VectorXd off(2 + 2 * (shape.size() + participation.size()));
  off << (mode.frequency - s.frequency[std::size_t(m)]) / mode.frequency_std,
      (mode.damping - s.damping[std::size_t(m)]) / mode.damping_std, of_shape.real().cwiseQuotient(mode.shape_std),
      of_shape.imag().cwiseQuotient(mode.shape_std), of_participation.real().cwiseQuotient(mode.participation_std),
      of_participation.imag().cwiseQuotient(mode.participation_std);
  return off;
}
Eigen::VectorXd deviations(const DrivenMode& mode, const Structure& s, Eigen::Index m) {
  return deviations(mode, s, m, s.participation.row(m).transpose().cast<std::complex<double>>());
}

void print(const DrivenModes& result) {
  fmt::print("  explained {:.4f}\n", result.explained);
  const auto line = [](const DrivenMode& m, const std::string& reason) {
    fmt::print("  {:.4f} ± {:.4f} Hz, damping {:.4f} ± {:.4f}, MPC {:.3f}, second {:.2f} {}\n", m.frequency,
               m.frequency_std, m.damping, m.damping_std, m.mean_phase, m.second, reason);
  };
  for (const DrivenMode& m : result.modes) line(m, "");
  for (const UndrivenMode& m : result.set_aside) line(m.mode, m.reason);
}

void expect_mode(const DrivenMode& mode, const Structure& s, Eigen::Index m, const Eigen::VectorXd& off) {
  const double f = s.frequency[std::size_t(m)], z = s.damping[std::size_t(m)];
  const double parts = off.tail(off.size() - 2).norm() / std::sqrt(double(off.size() - 2));
  fmt::print(
      "  {:.3f} Hz: found {:.4f} ± {:.4f} Hz, damping {:.4f}, found {:.4f} ± {:.4f}, MAC {:.5f}; shape and "
      "participation "
      "within {:.1f} std, rms {:.2f}; their std at most {:.3f} and {:.3f}\n",
      f, mode.frequency, mode.frequency_std, z, mode.damping, mode.damping_std, likeness(mode, s, m),
      off.tail(off.size() - 2).cwiseAbs().maxCoeff(), parts, mode.shape_std.maxCoeff(),
      mode.participation_std.maxCoeff());
  EXPECT_GT(likeness(mode, s, m), 0.99);
  EXPECT_LT(std::abs(off[0]), 3.0);
  EXPECT_LT(std::abs(off[1]), 3.0);
  // Some twenty numbers a mode: one in a few hundred is beyond three.
  EXPECT_LT(off.tail(off.size() - 2).cwiseAbs().maxCoeff(), 4.0);
  EXPECT_LT(parts, 1.5);
  EXPECT_LT(mode.frequency_std, 0.01 * f);
  EXPECT_LT(mode.damping_std, 0.6 * z);
  EXPECT_LT(mode.shape_std.maxCoeff(), 0.3);
}

void expect_modes(const DrivenModes& result, const Structure& s) {
  print(result);
  EXPECT_EQ(result.modes.size(), s.frequency.size());
  for (Eigen::Index m = 0; m < s.shapes.cols(); ++m) {
    const DrivenMode* mode = find(result, s, m);
    ASSERT_TRUE(mode) << s.frequency[std::size_t(m)] << " Hz";
    expect_mode(*mode, s, m, deviations(*mode, s, m));
  }
}

DrivenModes found(const Recording& r, const TransferSettings& settings = {}) {
  return driven_modes(transfer_functions({r}, settings));
}

TEST(DrivenModes, OfABridgeOnWhiteGround) {
  const Structure s = bridge();
  const DrivenModes result = found(recorded(s, white(2, 120.0, 1), 0.03, 2));
  EXPECT_EQ(result.inputs, (std::vector<std::string>{"base_x", "base_y"}));
  EXPECT_EQ(result.outputs.size(), 8U);
  EXPECT_GT(result.explained, 0.95);
  expect_modes(result, s);
}

TEST(DrivenModes, OfAMotionThatRisesAndDecays) {
  const Structure s = bridge();
  const auto envelope = [](double t) { return t / 5.0 * std::exp(1.0 - t / 5.0); };
  expect_modes(found(recorded(s, ground(2, 40.0, 3, envelope), 0.03, 4), {.window = 6.0}), s);
}

TEST(DrivenModes, FourPerCentApart) {
  Structure s = bridge();
  s.frequency = {2.1, 5.0, 5.2, 8.3, 11.4};
  s.damping = {0.02, 0.015, 0.015, 0.015, 0.03};
  const TransferFunctions t = transfer_functions({recorded(s, white(2, 120.0, 5), 0.03, 6)});
  expect_modes(driven_modes(t), s);
  // With a pole too few, one has to stand for both.
  const DrivenModes four = driven_modes(t, {.largest_count = 4});
  print(four);
  ASSERT_EQ(four.set_aside.size(), 1U);
  EXPECT_NE(four.set_aside[0].reason.find("not a single mode"), std::string::npos);
}

TEST(DrivenModes, StandardDeviationsAreHonest) {
  constexpr int seeds = 12;
  const Structure s = bridge();
  std::vector<Eigen::VectorXd> all;
  for (int seed = 0; seed < seeds; ++seed) {
    const auto number = std::uint64_t(seed);
    const DrivenModes result = found(recorded(s, white(2, 120.0, 100 + number), 0.03, 200 + number));
    EXPECT_EQ(result.modes.size() + result.set_aside.size(), 5U) << "seed " << seed;
    for (Eigen::Index m = 0; m < 5; ++m) {
      const DrivenMode* mode = find(result, s, m);
      ASSERT_TRUE(mode) << "seed " << seed << ", " << s.frequency[std::size_t(m)] << " Hz";
      all.push_back(deviations(*mode, s, m));
    }
  }
  Eigen::ArrayXXd off(all.front().size(), Eigen::Index(all.size()));
  for (std::size_t i = 0; i < all.size(); ++i) off.col(Eigen::Index(i)) = all[i];
  const auto rms = [&](Eigen::Index begin, Eigen::Index n) {
    return std::sqrt(off.middleRows(begin, n).square().mean());
  };
  const Eigen::Vector4d error(rms(0, 1), rms(1, 1), rms(2, 16), rms(18, 4));
  fmt::print(
      "  error over its standard deviation, root mean square of 5 modes in {} recordings: frequency {:.2f}, damping "
      "{:.2f}, shape {:.2f}, participation {:.2f}; beyond 3: {:.2f} %\n",
      seeds, error[0], error[1], error[2], error[3], 100.0 * (off.abs() > 3.0).cast<double>().mean());
  EXPECT_LT(error.maxCoeff(), 1.3);
  EXPECT_GT(error.minCoeff(), 0.2);
  EXPECT_LT((off.abs() > 3.0).cast<double>().mean(), 0.02);
}

/// White noise through soil of 3 Hz that is damped by 0.6 (Kanai 1957), under an envelope: 40 s.
Eigen::MatrixXd earthquake(std::uint64_t seed) {
  Eigen::MatrixXd a =
      ground(2, 40.0, seed, [](double t) { return std::pow(t / 5.0 * std::exp(1.0 - t / 5.0), 2.0) + 0.003; });
  for (Eigen::Index c = 0; c < a.cols(); ++c) {
    Oscillator soil(3.0, 0.6, fine);
    for (double& x : a.col(c)) x -= soil.step(x);
  }
  return a;
}

TEST(DrivenModes, OfEarthquakes) {
  constexpr int seeds = 8;
  const Structure s = bridge();
  int all = 0, beyond = 0, others = 0;
  double frequency = 0.0, damping = 0.0, least = 1.0;
  for (int seed = 0; seed < seeds; ++seed) {
    const auto number = std::uint64_t(seed);
    const DrivenModes result = found(recorded(s, earthquake(300 + number), 0.03, 400 + number), {.window = 6.0});
    int here = 0;
    for (Eigen::Index m = 0; m < 5; ++m) {
      const DrivenMode* mode = find(result, s, m);
      if (!mode) continue;
      ++here;
      const Eigen::VectorXd off = deviations(*mode, s, m);
      beyond += std::abs(off[0]) > 3.0 || std::abs(off[1]) > 3.0;
      frequency = std::max(frequency, std::abs(mode->frequency / s.frequency[std::size_t(m)] - 1.0));
      damping = std::max(damping, std::abs(mode->damping - s.damping[std::size_t(m)]));
      least = std::min(least, likeness(*mode, s, m));
    }
    all += here;
    others += int(result.modes.size()) - here;
  }
  fmt::print(
      "  {} earthquakes: {} of {} modes, {} others; frequencies within {:.2f} %, dampings within {:.4f}, MAC at least "
      "{:.4f}; {} with a frequency or damping beyond 3 std\n",
      seeds, all, 5 * seeds, others, 100.0 * frequency, damping, least, beyond);
  EXPECT_GE(all, 5 * seeds - 4);
  EXPECT_LE(others, 2);
  EXPECT_LT(frequency, 0.03);
  EXPECT_GT(least, 0.95);
  EXPECT_LE(beyond, 2);
}

/// A window of 5 s on a mode whose memory is 8 s.
TEST(DrivenModes, TheWindowWidensNoPeak) {
  Structure s = bridge();
  s.damping[0] = 0.01;
  const TransferFunctions t = transfer_functions({recorded(s, white(2, 600.0, 7), 0.03, 8)}, {.window = 5.2});
  const DrivenModes seen = driven_modes(t), plain = driven_modes(t, {.largest_count = 5, .smoothed = false});
  for (Eigen::Index m = 0; m < 5; ++m) {
    const DrivenMode *a = find(seen, s, m), *b = find(plain, s, m);
    ASSERT_TRUE(a && b) << s.frequency[std::size_t(m)] << " Hz";
    const double z = s.damping[std::size_t(m)];
    fmt::print(
        "  {:.1f} Hz, window {:.2f} s: damping {:.4f}, found {:.4f} ± {:.4f}, without the window {:.4f} ± {:.4f}\n",
        s.frequency[std::size_t(m)], t.window, z, a->damping, a->damping_std, b->damping, b->damping_std);
    EXPECT_NEAR(a->damping, z, std::min(3.0 * a->damping_std, 0.15 * z));
  }
  EXPECT_GT(find(plain, s, 0)->damping, 1.5 * s.damping[0]);
}

TEST(DrivenModes, KeepTheDelayOfAClock) {
  Structure s = bridge(4);
  s.frequency = {2.1, 5.6, 11.4};
  s.damping = {0.02, 0.015, 0.02};
  s.shapes = Eigen::MatrixXd(s.shapes.leftCols(3));
  s.participation = Eigen::MatrixXd(s.participation({0, 1, 2}, Eigen::all));
  s = largest_one(s);
  constexpr Eigen::Index late = 8;  // steps of 1 ms
  const Eigen::MatrixXd base = white(2, 120.0, 9);
  Eigen::MatrixXd y = accelerations(s, base);
  y.col(3).tail(y.rows() - late) = Eigen::VectorXd(y.col(3).head(y.rows() - late));
  const DrivenModes result = found(recorded(y, base, 0.03, 10));
  print(result);
  EXPECT_EQ(result.modes.size(), 3U);
  for (Eigen::Index m = 0; m < 3; ++m) {
    const DrivenMode* mode = find(result, s, m);
    ASSERT_TRUE(mode) << s.frequency[std::size_t(m)] << " Hz";
    const Eigen::VectorXcd ratio = mode->shape.cwiseQuotient(s.shapes.col(m).cast<std::complex<double>>());
    const double omega = 2.0 * pi * mode->frequency;
    const double delay = -std::arg(ratio[3] * std::conj(ratio.head(3).mean())) / omega;
    const double spread = mode->shape_std[3] / std::abs(mode->shape[3]) / omega;
    fmt::print("  {:.1f} Hz: {:.2f} ± {:.2f} ms late, damping {:.4f} ± {:.4f}\n", mode->frequency, 1e3 * delay,
               1e3 * spread, mode->damping, mode->damping_std);
    EXPECT_NEAR(delay, 0.008, 0.001);
    EXPECT_NEAR(mode->frequency, s.frequency[std::size_t(m)], 3.0 * mode->frequency_std);
    EXPECT_NEAR(mode->damping, s.damping[std::size_t(m)], 3.0 * mode->damping_std);
  }
}

/// Of two supports the second moves as the first did 50 ms before; sensors ride on the first.
TEST(DrivenModes, OfAMotionThatArrivesLate) {
  Structure s = bridge();
  s.rigid.col(1).setZero();
  constexpr Eigen::Index late = 50;
  Eigen::MatrixXd base = white(2, 120.0, 11);
  base.col(1).head(late).setZero();
  base.col(1).tail(base.rows() - late) = base.col(0).head(base.rows() - late);
  const DrivenModes result = found(recorded(accelerations(s, base), base.leftCols(1), 0.03, 12));
  print(result);
  for (Eigen::Index m = 0; m < 5; ++m) {
    const DrivenMode* mode = find(result, s, m);
    ASSERT_TRUE(mode) << s.frequency[std::size_t(m)] << " Hz";
    // A delay τ turns a residue by e^(−λτ): the phase −ωτ, and e^(ζωτ) in size.
    const double omega = 2.0 * pi * s.frequency[std::size_t(m)], z = s.damping[std::size_t(m)];
    const std::complex<double> pole(-z * omega, omega * std::sqrt(1.0 - z * z));
    const std::complex<double> known =
        s.participation(m, 0) + s.participation(m, 1) * std::exp(-pole * (fine * double(late)));
    const std::complex<double> got = mode->participation[0];
    fmt::print("  participation {:.3f} {:+.3f}i, found {:.3f} {:+.3f}i ± {:.3f}\n", known.real(), known.imag(),
               got.real(), got.imag(), mode->participation_std[0]);
    expect_mode(*mode, s, m, deviations(*mode, s, m, Eigen::VectorXcd::Constant(1, known)));
  }
}

TEST(DrivenModes, ANoisyAndADeadChannelDoNoHarm) {
  const Structure s = bridge();
  Recording r = recorded(s, white(2, 120.0, 1), 0.03, 2);
  Normal normal(13);
  r.values.conservativeResize(Eigen::NoChange, 12);
  for (double& x : r.values.col(10)) x = 20.0 * normal();
  r.values.col(11).setZero();
  r.channels.insert(r.channels.end(), {"noise", "dead"});
  const DrivenModes result = found(r);
  print(result);
  EXPECT_EQ(result.modes.size(), 5U);
  EXPECT_GT(result.explained, 0.95);
  for (Eigen::Index m = 0; m < 5; ++m) {
    const auto near = std::find_if(result.modes.begin(), result.modes.end(), [&](const DrivenMode& mode) {
      return std::abs(mode.frequency - s.frequency[std::size_t(m)]) < 3.0 * mode.frequency_std;
    });
    ASSERT_NE(near, result.modes.end()) << s.frequency[std::size_t(m)] << " Hz";
    EXPECT_NEAR(near->damping, s.damping[std::size_t(m)], 3.0 * near->damping_std);
    EXPECT_LT(std::abs(near->shape[8]), 4.0 * near->shape_std[8] + 1e-12);
    EXPECT_LT(std::abs(near->shape[9]), 1e-6);
    fmt::print("  {:.3f} ± {:.4f} Hz, the noise moves by {:.3f} ± {:.3f}\n", near->frequency, near->frequency_std,
               std::abs(near->shape[8]), near->shape_std[8]);
  }
}

TEST(DrivenModes, OfTooLittleAreRefusedOrFew) {
  const Structure s = bridge();
  for (const double duration : {1.0, 2.0, 3.0, 4.0, 6.0, 8.0, 12.0, 20.0}) {
    try {
      const DrivenModes result = found(recorded(s, white(2, duration, 14), 0.03, 15));
      fmt::print("  {} s: {} modes, {} set aside\n", duration, result.modes.size(), result.set_aside.size());
      EXPECT_LE(result.modes.size(), 7U);
      for (const DrivenMode& mode : result.modes) EXPECT_TRUE(mode.shape.allFinite() && mode.shape_std.allFinite());
    } catch (const InputError& e) {
      fmt::print("  {} s: {}\n", duration, e.what());
    }
  }
  TransferFunctions t = transfer_functions({recorded(s, white(2, 60.0, 16), 0.03, 17)});
  for (Eigen::MatrixXcd& h : t.values) h(0, 0) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_THROW(driven_modes(t), InputError);
  EXPECT_THROW(driven_modes({}), InputError);
  EXPECT_THROW(driven_modes(t, {.largest_count = 0}), InputError);
}

TEST(DrivenModes, OfNoiseAreNone) {
  const Eigen::MatrixXd base = white(1, 120.0, 18), y = white(3, 120.0, 19);
  const DrivenModes result = found(recorded(y, base, 0.0, 20));
  print(result);
  EXPECT_TRUE(result.modes.empty());
}

TEST(DrivenModes, RepeatToTheBit) {
  const TransferFunctions t = transfer_functions({recorded(bridge(), white(2, 60.0, 21), 0.03, 22)});
  const DrivenModes a = driven_modes(t), b = driven_modes(t);
  ASSERT_EQ(a.modes.size(), b.modes.size());
  ASSERT_GE(a.modes.size(), 4U);
  EXPECT_EQ(a.explained, b.explained);
  for (std::size_t m = 0; m < a.modes.size(); ++m) {
    EXPECT_EQ(a.modes[m].frequency, b.modes[m].frequency);
    EXPECT_EQ(a.modes[m].damping_std, b.modes[m].damping_std);
    EXPECT_EQ(a.modes[m].shape, b.modes[m].shape);
    EXPECT_EQ(a.modes[m].participation_std, b.modes[m].participation_std);
  }
}

TEST(DrivenModes, AreQuickWithFortyChannels) {
  Structure s = bridge(40);
  s.participation.conservativeResize(Eigen::NoChange, 3);
  s.participation.col(2) << 0.1, 0.5, -0.3, 0.8, 0.2;
  s.rigid = Eigen::MatrixXd::Ones(40, 3);
  const TransferFunctions t = transfer_functions({recorded(s, white(3, 60.0, 23), 0.03, 24)});
  const auto start = std::chrono::steady_clock::now();
  const DrivenModes result = driven_modes(t);
  const double seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  print(result);
  fmt::print("  60 s of 40 channels and 3 inputs at 100 Hz: {:.2f} s\n", seconds);
  EXPECT_EQ(result.modes.size(), 5U);
}

TEST(DrivenModes, BaseMotionIsAChannelThatMoves) {
  Recording r = recorded(bridge(), white(2, 20.0, 25), 0.03, 26);
  EXPECT_TRUE(has_base_motion({r}));
  Recording still = r;
  still.values.rightCols(2).setZero();
  EXPECT_FALSE(has_base_motion({still}));
  r.channels[8] = "s8";
  r.channels[9] = "s9";
  EXPECT_FALSE(has_base_motion({r}));
  EXPECT_THROW(has_base_motion({}), InputError);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
