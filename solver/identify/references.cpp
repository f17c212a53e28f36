#include "solver/identify/references.h"

#include <Eigen/Dense>
#include <algorithm>
#include <numeric>

#include "solver/identify/spectra.h"
#include "solver/linear/dense_eigen.h"

namespace voussoir {

namespace {

/// Correlation of the channels, each line of the spectrum counting alike by its first singular vector: a mode that is
/// hardly excited counts as much as a strong one, and noise between the modes does not.
Eigen::MatrixXd correlation(const CrossSpectra& spectra) {
  const Eigen::Index n = spectra.density.front().rows();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(n, n);
  for (std::size_t k = 2; k < spectra.density.size(); ++k) {
    const double trace = spectra.density[k].trace().real();
    if (!(trace > 0.0)) continue;
    const EigenSolution<Eigen::MatrixXcd> solution = eigen_solution(spectra.density[k]);
    const Eigen::VectorXcd u = solution.vectors.col(n - 1);
    const double share = solution.values[n - 1] / trace;
    sum += share * share * (u * u.adjoint()).real();
  }
  return sum;
}

}  // namespace

std::vector<int> choose_references(const Prepared& prepared, int count) {
  const int channels = int(prepared.used.size());
  std::vector<int> chosen(static_cast<std::size_t>(channels));
  std::iota(chosen.begin(), chosen.end(), 0);
  if (channels <= count) return chosen;
  chosen.clear();
  const int window = std::clamp(power_of_two_below(double(prepared.samples()) / 30.0), 32, 256);
  Eigen::MatrixXd left = correlation(cross_spectra(prepared.signals, prepared.dt, window, prepared.highest_frequency));
  // Cholesky with pivots: what a chosen channel already sees is taken out of the others.
  while (int(chosen.size()) < count) {
    Eigen::Index next = 0;
    const double most = left.diagonal().maxCoeff(&next);
    if (!(most > 0.0)) break;
    chosen.push_back(int(next));
    const Eigen::VectorXd column = left.col(next) / std::sqrt(most);
    left -= column * column.transpose();
    left.row(next).setZero();
    left.col(next).setZero();
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

}  // namespace voussoir
