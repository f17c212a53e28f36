#include "solver/identify/subspace.h"

#include <Eigen/Eigenvalues>
#include <algorithm>
#include <cmath>

#include "solver/base/constants.h"
#include "solver/linear/dense_eigen.h"

namespace voussoir {

namespace {

constexpr double ridge = 1e-3;  // of a variance: what is less of a signal is not whitened

/// Σ over the `count` instants from `start` of y(t + k) yref(t)ᵀ, for all lags k from 1.
Eigen::MatrixXd products_of(const Eigen::MatrixXd& signal, const Eigen::MatrixXd& reference, Eigen::Index start,
                            Eigen::Index count, int lags) {
  const Eigen::Index channels = signal.cols();
  Eigen::MatrixXd sums(lags * channels, reference.cols());
  const auto past = reference.middleRows(start, count);
  for (int k = 1; k <= lags; ++k)
    sums.middleRows((k - 1) * channels, channels).noalias() = signal.middleRows(start + k, count).transpose() * past;
  return sums;
}

/// Cov(y(t + k), y(t)) for k from 0 to lags − 1.
std::vector<Eigen::MatrixXd> autocovariances(const std::vector<Eigen::MatrixXd>& signals, int lags) {
  const Eigen::Index channels = signals.front().cols();
  std::vector<Eigen::MatrixXd> r(std::size_t(lags), Eigen::MatrixXd::Zero(channels, channels));
  double samples = 0.0;
  for (const Eigen::MatrixXd& x : signals) {
    const Eigen::Index n = x.rows() - lags;
    if (n <= 0) continue;
    for (int k = 0; k < lags; ++k) r[std::size_t(k)].noalias() += x.middleRows(k, n).transpose() * x.topRows(n);
    samples += double(n);
  }
  for (Eigen::MatrixXd& block : r) block /= samples;
  return r;
}

/// Factor of the block Toeplitz matrix with blocks r_(i−j), or r_(j−i) where time runs backwards.
Eigen::MatrixXd factor(const std::vector<Eigen::MatrixXd>& r, bool backwards) {
  const auto rows = Eigen::Index(r.size()), n = r.front().rows();
  Eigen::MatrixXd t(rows * n, rows * n);
  for (Eigen::Index i = 0; i < rows; ++i)
    for (Eigen::Index j = 0; j <= i; ++j) {
      if (backwards)
        t.block(i * n, j * n, n, n) = r[std::size_t(i - j)].transpose();
      else
        t.block(i * n, j * n, n, n) = r[std::size_t(i - j)];
    }
  // Estimates from finite recordings need not be positive definite.
  for (double added = ridge;; added *= 10.0) {
    t.diagonal().array() += added;
    const Eigen::LLT<Eigen::MatrixXd> cholesky(t);
    if (cholesky.info() == Eigen::Success || added > 1e6) return cholesky.matrixL();
  }
}

/// An orthonormal basis of the `count` strongest directions of the columns of h. By the eigenvectors of the smaller
/// product of h with itself: what falls below 1e-8 of the largest singular value is lost, and noise lies far above.
Eigen::MatrixXd strongest_columns(const Eigen::MatrixXd& h, Eigen::Index count) {
  const bool wide = h.cols() > h.rows();
  const Eigen::Index n = wide ? h.rows() : h.cols();
  Eigen::MatrixXd product = Eigen::MatrixXd::Zero(n, n);
  if (wide)
    product.selfadjointView<Eigen::Lower>().rankUpdate(h);
  else
    product.selfadjointView<Eigen::Lower>().rankUpdate(h.transpose());
  const EigenSolution<Eigen::MatrixXd> solution = eigen_solution(product);
  const Eigen::VectorXd values = solution.values.reverse();
  Eigen::Index kept = 0;
  while (kept < std::min(count, n) && values[kept] > 1e-15 * values[0]) ++kept;
  const Eigen::MatrixXd vectors = solution.vectors.rowwise().reverse().leftCols(kept);
  if (wide) return vectors;
  return h * vectors * values.head(kept).cwiseSqrt().cwiseInverse().asDiagonal();
}

}  // namespace

LaggedProducts lagged_products(const std::vector<Eigen::MatrixXd>& signals, const std::vector<int>& references,
                               int lags, int segments) {
  LaggedProducts result;
  result.lags = lags;
  Eigen::Index total = 0;
  for (const Eigen::MatrixXd& x : signals) total += std::max<Eigen::Index>(0, x.rows() - lags);
  for (const Eigen::MatrixXd& x : signals) {
    const Eigen::Index n = x.rows() - lags;
    if (n <= 0) continue;
    const auto share = double(segments) * double(n) / double(total);
    const auto parts = std::clamp<Eigen::Index>(std::llround(share), 1, n);
    const Eigen::MatrixXd reference = x(Eigen::all, references);
    for (Eigen::Index part = 0; part < parts; ++part) {
      const Eigen::Index start = part * n / parts, count = (part + 1) * n / parts - start;
      result.samples.push_back(double(count));
      result.sums.push_back(products_of(x, reference, start, count, lags));
    }
  }
  return result;
}

Eigen::MatrixXd covariances(const LaggedProducts& products, const std::vector<bool>& left_out) {
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(products.sums.front().rows(), products.sums.front().cols());
  double samples = 0.0;
  for (std::size_t s = 0; s < products.sums.size(); ++s) {
    if (!left_out.empty() && left_out[s]) continue;
    sum += products.sums[s];
    samples += products.samples[s];
  }
  return sum / samples;
}

CanonicalWeights canonical_weights(const std::vector<Eigen::MatrixXd>& signals, const std::vector<int>& references,
                                   int block_rows) {
  std::vector<Eigen::MatrixXd> r = autocovariances(signals, block_rows);
  CanonicalWeights weights;
  weights.future = factor(r, false);
  for (Eigen::MatrixXd& block : r) block = Eigen::MatrixXd(block(references, references));
  weights.past = factor(r, true);
  return weights;
}

Eigen::MatrixXd hankel(const Eigen::MatrixXd& covariances, int channels, int block_rows) {
  const Eigen::Index rows = Eigen::Index(block_rows) * channels, references = covariances.cols();
  Eigen::MatrixXd h(rows, block_rows * references);
  for (int j = 0; j < block_rows; ++j)
    h.middleCols(j * references, references) = covariances.middleRows(Eigen::Index(j) * channels, rows);
  return h;
}

double Pole::frequency() const {
  return std::abs(lambda) / (2.0 * pi);
}

double Pole::damping() const {
  return -lambda.real() / std::abs(lambda);
}

Subspace::Subspace(const Eigen::MatrixXd& covariances, const CanonicalWeights& weights, int channels, int block_rows,
                   int largest_order) {
  Eigen::MatrixXd h = hankel(covariances, channels, block_rows);
  weights.past.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(h);
  weights.future.triangularView<Eigen::Lower>().solveInPlace(h);
  const Eigen::MatrixXd space = weights.future.triangularView<Eigen::Lower>() * strongest_columns(h, largest_order);
  const Eigen::Index rows = space.rows() - channels, n = std::min(space.cols(), rows);
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(space.topLeftCorner(rows, n));
  triangle_ = qr.matrixQR().topRows(n).triangularView<Eigen::Upper>();
  const Eigen::MatrixXd down = qr.householderQ().adjoint() * space.bottomLeftCorner(rows, n);
  shifted_ = down.topRows(n);
  first_ = space.topLeftCorner(channels, n);
}

std::vector<Pole> Subspace::poles(int order, double dt, double highest, const Eigen::VectorXd& scale) const {
  // Least squares of the first `order` columns alone: their triangle is the leading part of the whole one.
  const Eigen::MatrixXd transition =
      triangle_.topLeftCorner(order, order).triangularView<Eigen::Upper>().solve(shifted_.topLeftCorner(order, order));
  return poles_of(transition, first_.leftCols(order), dt, highest, scale);
}

std::vector<Pole> poles_of(const Eigen::MatrixXd& transition, const Eigen::MatrixXd& first, double dt, double highest,
                           const Eigen::VectorXd& scale) {
  std::vector<Pole> poles;
  if (!transition.allFinite()) return poles;
  const Eigen::EigenSolver<Eigen::MatrixXd> solver(transition);
  if (solver.info() != Eigen::Success) return poles;
  const Eigen::MatrixXcd vectors = solver.eigenvectors();
  for (Eigen::Index i = 0; i < transition.cols(); ++i) {
    const std::complex<double> mu = solver.eigenvalues()[i];
    if (!(mu.imag() > 0.0)) continue;
    Pole pole;
    pole.order = int(transition.cols());
    pole.lambda = std::log(mu) / dt;
    if (pole.frequency() > highest) continue;
    pole.shape = scale.asDiagonal() * (first * vectors.col(i));
    normalise(pole.shape);
    if (pole.shape.allFinite()) poles.push_back(std::move(pole));
  }
  std::stable_sort(poles.begin(), poles.end(),
                   [](const Pole& a, const Pole& b) { return a.frequency() < b.frequency(); });
  return poles;
}

double assurance(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b) {
  return std::norm(a.dot(b)) / (a.squaredNorm() * b.squaredNorm());
}

double distance(const Pole& a, const Pole& b) {
  return std::abs(a.lambda - b.lambda) / std::max(std::abs(a.lambda), std::abs(b.lambda)) + 1.0 -
         assurance(a.shape, b.shape);
}

int nearest(const std::vector<Pole>& poles, const Pole& pole) {
  int best = -1;
  double least = 0.0;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    const double d = distance(poles[i], pole);
    if (best < 0 || d < least) {
      best = int(i);
      least = d;
    }
  }
  return best;
}

int medoid(const std::vector<Pole>& poles) {
  int best = -1;
  double least = 0.0;
  for (std::size_t i = 0; i < poles.size(); ++i) {
    double sum = 0.0;
    for (const Pole& other : poles) sum += distance(poles[i], other);
    if (best < 0 || sum < least) {
      best = int(i);
      least = sum;
    }
  }
  return best;
}

void normalise(Eigen::VectorXcd& shape) {
  Eigen::Index largest = 0;
  shape.cwiseAbs().maxCoeff(&largest);
  shape /= std::complex<double>(shape[largest]);
}

}  // namespace voussoir
