#include "solver/identify/spectra.h"

#include <cmath>
#include <unsupported/Eigen/FFT>

#include "solver/base/constants.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

constexpr int batch = 16;  // windows whose products are summed by one matrix product per line

Eigen::VectorXd hann(int n) {
  Eigen::VectorXd w(n);
  for (int i = 0; i < n; ++i) w[i] = 0.5 - 0.5 * std::cos(2.0 * pi * i / n);
  return w;
}

/// Spectra of up to `batch` windows, a line each: channels × windows.
class Windows {
 public:
  Windows(int window, std::size_t lines, Eigen::Index channels)
      : shape_(hann(window)), spectra_(lines, Eigen::MatrixXcd(channels, batch)) {
    fft_.SetFlag(Eigen::FFT<double>::HalfSpectrum);
  }
  void take(const Eigen::MatrixXd& signal, Eigen::Index start) {
    const Eigen::Index n = shape_.size();
    for (Eigen::Index c = 0; c < signal.cols(); ++c) {
      const auto part = signal.col(c).segment(start, n);
      const Eigen::VectorXd tapered = (part.array() - part.mean()) * shape_.array();
      fft_.fwd(spectrum_, tapered);
      for (std::size_t k = 0; k < spectra_.size(); ++k) spectra_[k](c, held_) = spectrum_[Eigen::Index(k)];
    }
    ++held_;
  }
  bool full() const { return held_ == batch; }
  void add_to(std::vector<Eigen::MatrixXcd>& sums) {
    for (std::size_t k = 0; held_ > 0 && k < sums.size(); ++k) {
      const auto x = spectra_[k].leftCols(held_);
      sums[k].noalias() += x * x.adjoint();
    }
    held_ = 0;
  }
  double energy() const { return shape_.squaredNorm(); }

 private:
  Eigen::VectorXd shape_;
  std::vector<Eigen::MatrixXcd> spectra_;
  Eigen::FFT<double> fft_;
  Eigen::VectorXcd spectrum_;
  Eigen::Index held_ = 0;
};

/// Hann windows that overlap by a half have correlated periodograms: 2 (1/6)² more variance (Welch 1967).
double independent(int windows) {
  return windows > 1 ? windows / (1.0 + (1.0 - 1.0 / windows) / 18.0) : windows;
}

}  // namespace

int power_of_two_below(double x) {
  int n = 2;
  while (2.0 * n <= x) n *= 2;
  return n;
}

CrossSpectra cross_spectra(const std::vector<Eigen::MatrixXd>& signals, double dt, int window, double highest) {
  CrossSpectra result;
  result.step = 1.0 / (dt * window);
  const auto lines = std::size_t(std::min(std::floor(highest / result.step + 1e-9), window / 2.0)) + 1;
  const Eigen::Index channels = signals.empty() ? 0 : signals.front().cols();
  result.density.assign(lines, Eigen::MatrixXcd::Zero(channels, channels));
  Windows windows(window, lines, channels);
  int count = 0;
  for (const Eigen::MatrixXd& signal : signals) {
    int here = 0;
    for (Eigen::Index start = 0; start + window <= signal.rows(); start += window / 2, ++here) {
      windows.take(signal, start);
      if (windows.full()) windows.add_to(result.density);
    }
    count += here;
    result.averages += independent(here);
  }
  windows.add_to(result.density);
  if (count == 0)
    throw InputError("spectra: no recording is as long as the window of {} s. Choose a shorter window.", dt * window);
  const double scale = 2.0 * dt / (windows.energy() * count);
  for (std::size_t k = 0; k < lines; ++k) {
    const bool alone = k == 0 || 2 * k == std::size_t(window);  // no line of negative frequency to add
    result.density[k] *= alone ? 0.5 * scale : scale;
  }
  return result;
}

double median_of(std::vector<double> values) {
  const auto middle = values.begin() + std::ptrdiff_t(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace voussoir
