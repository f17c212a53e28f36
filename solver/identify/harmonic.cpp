#include "solver/identify/harmonic.h"

#include <algorithm>
#include <cmath>
#include <complex>
#include <numbers>

#include "solver/base/constants.h"
#include "solver/identify/spectra.h"

namespace voussoir {

namespace {

constexpr double envelopes_wanted = 40.0;
constexpr double least_cycles = 10.0, most_cycles = 100.0;  // of a window: its band is 4 / cycles of the frequency
constexpr double largest_harmonic_damping = 0.02;           // above that the peak is too broad for a machine
constexpr double no_damping = 5e-4;                         // no structure has so little
constexpr double short_of_memory = 0.03;  // of a mode's memory 1/(ζω): windows in which nothing decays yet
constexpr double least_stop_cycles = 6.0, most_stop_cycles = 40.0;
constexpr Eigen::Index lag = 3;   // half windows
constexpr double surprise = 6.0;  // squared deviation over its mean: noise exceeds it once in e⁶ windows
constexpr double fallen = 0.5;    // of what the damping would leave
constexpr int least_stops = 3;
constexpr double most_lost = 0.35;  // share of the energy lost
constexpr double half_way = 2.0;    // kurtosis; a harmonic with a tenth of its power in noise has 1.75

/// The envelope in each window, which overlap by a half: the component at `omega` (rad/sample) under a Hann window. Its
/// phase is that at the beginning of the signal.
Eigen::VectorXcd envelopes(const Eigen::VectorXcd& signal, double omega, Eigen::Index window) {
  Eigen::VectorXcd kernel(window);
  for (Eigen::Index i = 0; i < window; ++i)
    kernel[i] = std::polar(0.5 - 0.5 * std::cos(2.0 * pi * double(i) / double(window)), omega * double(i));
  const Eigen::Index hop = std::max<Eigen::Index>(1, window / 2);
  const Eigen::Index count = signal.size() < window ? 0 : (signal.size() - window) / hop + 1;
  Eigen::VectorXcd a(count);
  for (Eigen::Index k = 0; k < count; ++k)
    a[k] = kernel.dot(signal.segment(k * hop, window)) * std::polar(1.0, -omega * double(k * hop));
  return a;
}

/// Ratio of the envelope to the decayed envelope of one and a half windows before. A switch cannot be in both windows.
struct Step {
  double before = 0.0, after = 0.0, unforeseen = 0.0;  // squares
};

std::vector<Step> steps_of(const Eigen::VectorXcd& a, double left) {
  std::vector<Step> steps;
  for (Eigen::Index k = 0; k + lag < a.size(); ++k)
    steps.push_back({std::norm(a[k]), std::norm(a[k + lag]), std::norm(a[k + lag] - left * a[k])});
  return steps;
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
    for (const auto& a : envelopes(x * along.conjugate(), 2.0 * pi * frequency * dt, window))
      squares.push_back(std::norm(a));
  Narrowband result;
  if (squares.empty()) return result;
  double second = 0.0, fourth = 0.0;
  for (const double a : squares) {
    second += a;
    fourth += a * a;
  }
  // Of A cos(ωt + φ) with a slow A the mean fourth power is 3/8 A⁴ and the mean square 1/2 A².
  result.kurtosis = 1.5 * fourth * double(squares.size()) / (second * second);
  const double memory = 1.0 / (2.0 * pi * frequency * std::max(damping, 1e-6));
  result.independent = duration / std::max(seconds, memory);
  return result;
}

bool is_harmonic(const Narrowband& band, double damping) {
  if (damping > largest_harmonic_damping || band.kurtosis > half_way) return false;
  // The kurtosis of n independent Gaussian envelopes scatters by 3/√n about 3.
  return damping < no_damping || band.kurtosis < 3.0 - 2.5 * 3.0 / std::sqrt(band.independent);
}

Stops fast_stops(const std::vector<Eigen::MatrixXd>& signals, double dt, double frequency, double damping,
                 const Eigen::VectorXcd& along) {
  const double memory = 1.0 / (2.0 * pi * std::max(damping, 1e-6));  // cycles
  const double cycles = std::clamp(short_of_memory * memory, least_stop_cycles, most_stop_cycles);
  const auto window = Eigen::Index(std::ceil(cycles / (frequency * dt)));
  const double left = std::exp(-0.5 * double(lag) * cycles / memory), omega = 2.0 * pi * frequency * dt;
  std::vector<Step> steps;
  for (const Eigen::MatrixXd& x : signals)
    for (const Step& step : steps_of(envelopes(x * along.conjugate(), omega, window), left)) steps.push_back(step);
  Stops stops;
  if (steps.empty()) return stops;
  double mean = 0.0;
  std::vector<double> unforeseen;
  for (const Step& step : steps) {
    mean += step.before / double(steps.size());
    unforeseen.push_back(step.unforeseen);
  }
  // What a Gaussian excitation adds in that time; or more where other motions hide the mode (an exponential
  // distribution's median is ln 2 of its mean).
  const double usual = std::max(mean * (1.0 - left * left), median_of(unforeseen) / std::numbers::ln2);
  double lost = 0.0, lost_fast = 0.0;
  bool stopping = false;
  for (const Step& step : steps) {
    const bool stop = step.unforeseen > surprise * usual && step.after < fallen * fallen * left * left * step.before;
    stops.count += stop && !stopping;
    stopping = stop;
    const double loss = std::max(0.0, step.before - step.after);
    lost += loss;
    if (stop) lost_fast += loss;
  }
  stops.share = lost > 0.0 ? lost_fast / lost : 0.0;
  return stops;
}

bool is_intermittent(const Stops& stops) {
  return stops.count >= least_stops && stops.share > most_lost;
}

}  // namespace voussoir
