// Cross-spectral densities by Welch's method (1967).
#pragma once
#include <Eigen/Dense>
#include <vector>

namespace voussoir {

struct CrossSpectra {
  double step = 0.0;      // Hz, between lines; line k is at k · step
  double averages = 0.0;  // number of independent averages, with windows that overlap by a half (Welch 1967)
  std::vector<Eigen::MatrixXcd>
      density;  // a line each: one-sided G_ij = E[X_i conj X_j], channels × channels, units²/Hz
  double frequency(std::size_t line) const { return step * double(line); }  // Hz
};

/// The signals are samples × channels, one matrix for each recording. The method uses Hann windows of `window` samples
/// (even) that overlap by a half, each minus its mean, and lines up to `highest` (Hz). Recordings shorter than a window
/// are ignored. Throws InputError if all are shorter.
CrossSpectra cross_spectra(const std::vector<Eigen::MatrixXd>& signals, double dt, int window, double highest);

/// The largest power of two not above x, at least 2.
int power_of_two_below(double x);

/// The median; for an even number of values, the upper of the two middle ones. There must be at least one value.
double median_of(std::vector<double> values);

}  // namespace voussoir
