#include "solver/identify/fdd.h"

#include <Eigen/Dense>
#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/base/error.h"
#include "solver/identify/spectra.h"
#include "solver/identify/subspace.h"
#include "solver/linear/dense_eigen.h"

namespace voussoir {

namespace {

void decompose(const Prepared& p, const Eigen::MatrixXcd& density, std::size_t line, Fdd& fdd) {
  const EigenSolution<Eigen::MatrixXcd> solution = eigen_solution(density);
  const Eigen::Index n = density.rows(), kept = fdd.singular.cols();
  fdd.vectors[line].resize(Eigen::Index(p.channels.size()), kept);
  for (Eigen::Index i = 0; i < kept; ++i) {
    fdd.singular(Eigen::Index(line), i) = std::max(0.0, solution.values[n - 1 - i]);
    fdd.vectors[line].col(i) = over_all_channels(p, solution.vectors.col(n - 1 - i));
  }
}

/// Channels that both vectors have.
std::vector<Eigen::Index> in_both(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  std::vector<Eigen::Index> both;
  for (Eigen::Index i = 0; i < a.size(); ++i)
    if (!std::isnan(a[i].real()) && !std::isnan(b[i].real())) both.push_back(i);
  return both;
}

/// The highest local maximum of a curve about a frequency: the line, −1 when there is none.
Eigen::Index highest_peak(const Fdd& fdd, const Eigen::VectorXd& curve, double frequency, double reach) {
  const double step = fdd.frequencies[1] - fdd.frequencies[0], wide = std::max(reach * frequency, 2.0 * step);
  Eigen::Index best = -1;
  for (Eigen::Index k = 1; k + 1 < curve.size(); ++k) {
    const bool peak = curve[k] > 0.0 && curve[k] >= curve[k - 1] && curve[k] >= curve[k + 1];
    if (!peak || std::abs(fdd.frequencies[k] - frequency) > wide) continue;
    if (best < 0 || curve[k] > curve[best]) best = k;
  }
  return best;
}

/// From the line to the top of the parabola through the logarithms of three lines, in lines.
double to_the_top(const Eigen::VectorXd& curve, Eigen::Index k) {
  const double before = std::log(std::max(curve[k - 1], 1e-300)), here = std::log(curve[k]),
               after = std::log(std::max(curve[k + 1], 1e-300));
  const double bend = before - 2.0 * here + after;
  return bend < 0.0 ? std::clamp(0.5 * (before - after) / bend, -0.5, 0.5) : 0.0;
}

FddPeak peak_of(const Fdd& fdd, const Eigen::VectorXd& curve, double frequency, double reach) {
  FddPeak peak;
  const Eigen::Index k = highest_peak(fdd, curve, frequency, reach);
  if (k < 0) return peak;
  peak.found = true;
  peak.frequency = fdd.frequencies[k] + to_the_top(curve, k) * (fdd.frequencies[1] - fdd.frequencies[0]);
  peak.height = curve[k];
  peak.shape = fdd.vectors[std::size_t(k)].col(0);
  return peak;
}

/// normalise() of what is measured.
void normalise_measured(Eigen::VectorXcd& shape) {
  const std::vector<Eigen::Index> measured = in_both(shape, shape);
  Eigen::VectorXcd part = shape(measured);
  normalise(part);
  for (std::size_t i = 0; i < measured.size(); ++i) shape[measured[i]] = part[Eigen::Index(i)];
}

/// Σ σ |uᴴ φ|² / |φ|² over the singular vectors kept: the spectrum of the motion along φ.
double along(const Fdd& fdd, Eigen::Index line, const Eigen::VectorXcd& shape,
             const std::vector<Eigen::Index>& channels) {
  const Eigen::VectorXcd wanted = shape(channels);
  double sum = 0.0;
  for (Eigen::Index i = 0; i < fdd.singular.cols(); ++i) {
    const Eigen::VectorXcd u = fdd.vectors[std::size_t(line)].col(i)(channels);
    sum += fdd.singular(line, i) * std::norm(u.dot(wanted));
  }
  return sum / wanted.squaredNorm();
}

}  // namespace

Fdd decompose_spectra(const std::vector<Recording>& recordings, const FddSettings& settings) {
  if (settings.singular_values < 1)
    throw InputError("spectra: the number of singular values is {}. It must be at least 1.", settings.singular_values);
  const Prepared p = prepare(recordings, settings.highest_frequency);
  const int window = window_samples(p, settings.window, 20.0, "spectra");
  const CrossSpectra spectra = cross_spectra(p.signals, p.dt, window, p.highest_frequency);
  Fdd fdd;
  fdd.channels = p.channels;
  fdd.poor = p.poor;
  fdd.window = p.dt * window;
  fdd.averages = spectra.averages;
  const auto lines = Eigen::Index(spectra.density.size());
  fdd.frequencies = spectra.step * Eigen::VectorXd::LinSpaced(lines, 0.0, double(lines - 1));
  fdd.singular.resize(lines, std::min<Eigen::Index>(settings.singular_values, Eigen::Index(p.used.size())));
  fdd.vectors.resize(spectra.density.size());
  for (std::size_t k = 0; k < spectra.density.size(); ++k) decompose(p, spectra.density[k], k, fdd);
  return fdd;
}

FddPeak peak_near(const Fdd& fdd, double frequency, double reach) {
  FddPeak peak = peak_of(fdd, fdd.singular.col(0), frequency, reach);
  if (peak.found) normalise_measured(peak.shape);
  return peak;
}

FddPeak peak_near(const Fdd& fdd, double frequency, const Eigen::VectorXcd& shape, double reach) {
  if (shape.size() != Eigen::Index(fdd.channels.size()))
    throw InputError(
        "spectra: the shape has {} components, but the recordings have {} channels. Give one component for each "
        "channel.",
        shape.size(), fdd.channels.size());
  const std::vector<Eigen::Index> channels = in_both(shape, fdd.vectors.front().col(0));
  if (channels.empty()) return {};
  Eigen::VectorXd curve(fdd.frequencies.size());
  for (Eigen::Index k = 0; k < curve.size(); ++k) curve[k] = along(fdd, k, shape, channels);
  FddPeak peak = peak_of(fdd, curve, frequency, reach);
  if (!peak.found) return peak;
  const auto line = highest_peak(fdd, curve, frequency, reach);
  const Eigen::MatrixXcd& candidates = fdd.vectors[std::size_t(line)];
  for (Eigen::Index i = 0; i < candidates.cols(); ++i) {
    const double likeness = assurance(Eigen::VectorXcd(candidates.col(i)(channels)), Eigen::VectorXcd(shape(channels)));
    if (likeness <= peak.assurance) continue;
    peak.assurance = likeness;
    peak.shape = candidates.col(i);
  }
  normalise_measured(peak.shape);
  return peak;
}

}  // namespace voussoir
