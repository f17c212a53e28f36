// An oscillator with Maxwell damping rings at the frequency and with the ratio that its branches give.
#include <complex>

#include "tools/ladder/decay.h"
#include "tools/ladder/rung.h"

namespace voussoir::ladder {

namespace {

/// Root of s²/ω0² + 1 + Σ α s/(s + ω_j) = 0 near iω0, by Newton: ring-down of the exact Maxwell oscillator.
Decay exact_maxwell(double frequency) {
  const MaxwellFit fit = fit_maxwell(0.02, {0.5, 12.0}, 3);
  const double w0 = 2 * pi * frequency;
  const auto f = [&](std::complex<double> s) {
    std::complex<double> sum = s * s / (w0 * w0) + 1.0;
    for (int j = 0; j < 3; ++j) sum += fit.stiffness[std::size_t(j)] * s / (s + 2 * pi * fit.frequency[std::size_t(j)]);
    return sum;
  };
  std::complex<double> s(0.0, w0);
  for (int i = 0; i < 50; ++i) s -= f(s) * 1e-4 / (f(s + 1e-4) - f(s));
  return {s.imag() / (2 * pi), -s.real() / std::abs(s)};
}

/// Largest relative errors against the exact oscillator.
struct Errors {
  double frequency = 0.0, ratio = 0.0;
  void take(const Decay& got, const Decay& exact) {
    frequency = std::max(frequency, std::abs(got.frequency / exact.frequency - 1.0));
    ratio = std::max(ratio, std::abs(got.ratio / exact.ratio - 1.0));
  }
};

/// Undamped 3.125 Hz rings at 1.0446 times that with 2.028 %.
std::vector<Finding> published(bool shortcut, Errors& errors) {
  const Decay got = ring(DampingSettings{}, 3.125, 1e-3, shortcut);
  errors.take(got, exact_maxwell(3.125));
  const std::string path = shortcut ? ", shortcut" : ", points";
  return {near("frequency of 3.125 Hz" + path, 1.0446 * 3.125, got.frequency, 0.003, "Hz",
               "independent least-squares fit: × 1.0446"),
          near("ratio of 3.125 Hz" + path, 0.02028, got.ratio, 0.03, "-", "independent least-squares fit")};
}

std::vector<Finding> climb_maxwell_ring(int) {
  Errors middle, band;
  std::vector<Finding> findings = published(true, middle);
  for (Finding& finding : published(false, middle)) findings.push_back(std::move(finding));
  for (double frequency : {0.7, 1.5, 6.0, 10.0})
    band.take(ring(DampingSettings{}, frequency, 0.002 / frequency, true), exact_maxwell(frequency));
  const std::string source = "root of the fitted model";
  findings.push_back(nothing("error of frequency, 3.125 Hz", middle.frequency, 1e-3, "-", source));
  findings.push_back(nothing("error of ratio, 3.125 Hz", middle.ratio, 0.01, "-", source));
  findings.push_back(nothing("error of frequency, 0.7 to 10 Hz", band.frequency, 1e-3, "-", source));
  findings.push_back(nothing("error of ratio, 0.7 to 10 Hz", band.ratio, 0.02, "-", source));
  return findings;
}

}  // namespace

Rung maxwell_ring() {
  return {.name = "maxwell-ring",
          .help = "frequency and ratio of an oscillator with Maxwell damping",
          .climb = climb_maxwell_ring};
}

}  // namespace voussoir::ladder
