#include "solver/identify/harmonic.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

namespace voussoir {

namespace {

constexpr double envelopes_wanted = 40.0;
constexpr double least_cycles = 10.0, most_cycles = 100.0;  // of a window: its band is 4 / cycles of the frequency
constexpr double largest_harmonic_damping = 0.02;           // above that the peak is too broad for a machine
constexpr double no_damping = 5e-4;                         // no structure has so little
constexpr double half_way = 2.0;  // kurtosis; a harmonic with a tenth of its power in noise has 1.75

/// The squared envelope of each window: the component at `omega` (rad/sample) under a Hann window.
void add_envelopes(const Eigen::VectorXcd& signal, double omega, Eigen::Index window, std::vector<double>& squares) {
  Eigen::VectorXcd kernel(window);
  for (Eigen::Index i = 0; i < window; ++i)
    kernel[i] =
        std::polar(0.5 - 0.5 * std::cos(2.0 * std::numbers::pi * double(i) / double(window)), omega * double(i));
  for (Eigen::Index start = 0; start + window <= signal.size(); start += std::max<Eigen::Index>(1, window / 2))
    squares.push_back(std::norm(kernel.dot(signal.segment(start, window))));
}

}  // namespace

Narrowband narrowband_kurtosis(const std::vector<Eigen::MatrixXd>& signals, double dt, double frequency, double damping,
                               const Eigen::VectorXcd& along) {
  Eigen::Index samples = 0;
  for (const Eigen::MatrixXd& x : signals) samples += x.rows();
  const double duration = dt * double(samples);
  const double seconds = std::clamp(duration / envelopes_wanted, least_cycles / frequency, most_cycles / frequency);
  const auto window = Eigen::Index(std::ceil(seconds / dt));
  std::vector<double> squares;
  for (const Eigen::MatrixXd& x : signals)
    add_envelopes(x * along.conjugate(), 2.0 * std::numbers::pi * frequency * dt, window, squares);
  Narrowband result;
  if (squares.empty()) return result;
  double second = 0.0, fourth = 0.0;
  for (const double a : squares) {
    second += a;
    fourth += a * a;
  }
  // Of A cos(ωt + φ) with a slow A the mean fourth power is 3/8 A⁴ and the mean square 1/2 A².
  result.kurtosis = 1.5 * fourth * double(squares.size()) / (second * second);
  const double memory = 1.0 / (2.0 * std::numbers::pi * frequency * std::max(damping, 1e-6));
  result.independent = duration / std::max(seconds, memory);
  return result;
}

bool is_harmonic(const Narrowband& band, double damping) {
  if (damping > largest_harmonic_damping || band.kurtosis > half_way) return false;
  // The kurtosis of n independent Gaussian envelopes scatters by 3/√n about 3.
  return damping < no_damping || band.kurtosis < 3.0 - 2.5 * 3.0 / std::sqrt(band.independent);
}

}  // namespace voussoir
