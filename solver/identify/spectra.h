// Cross-spectral densities by the method of Welch (1967).
#pragma once
#include <Eigen/Dense>
#include <vector>

namespace voussoir {

struct CrossSpectra {
  double step = 0.0;      // Hz, between lines; line k is at k · step
  double averages = 0.0;  // independent ones, windows overlapping by a half (Welch 1967)
  std::vector<Eigen::MatrixXcd>
      density;  // a line each: one-sided G_ij = E[X_i conj X_j], channels × channels, units²/Hz
  double frequency(std::size_t line) const { return step * double(line); }  // Hz
};

/// The signals are samples × channels, one matrix a recording; Hann windows of `window` samples (even) that overlap by
/// a half, each less its mean; lines up to `highest` (Hz). Recordings shorter than a window do not count. Throws
/// InputError when all are.
CrossSpectra cross_spectra(const std::vector<Eigen::MatrixXd>& signals, double dt, int window, double highest);

/// The largest power of two not above x, 2 at least.
int power_of_two_below(double x);

/// The upper one of the two in the middle of an even number of values; there must be one.
double median_of(std::vector<double> values);

}  // namespace voussoir
