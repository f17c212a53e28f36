// Shift-invert Lanczos (Ericsson and Ruhe 1980) on θ = 1/(λ − σ), by Spectra's implicitly restarted iteration in the
// inner product of M, with CHOLMOD's supernodal factor of K − σ M. σ lies just below zero, so that the factor exists
// for an unsupported assembly too and its rigid motions come first.
#include "solver/linear/eigenpairs.h"

#include <Spectra/SymGEigsShiftSolver.h>

#include <Eigen/Dense>
#include <chrono>

#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/base/timed.h"
#include "solver/linear/dense_eigen.h"

namespace voussoir {

namespace {

constexpr Eigen::Index dense_below = 400;  // unknowns
constexpr Eigen::Index dense_most = 6000;  // unknowns: nearly 1 GiB of matrices

/// Spectra's operators: x → (K − σ M)⁻¹ x less what lies along the columns of `known`, and x → M x.
class Inverse {
 public:
  using Scalar = double;
  Inverse(const Factor& factor, const SparseMatrix& m, const Eigen::MatrixXd& known, int& solves)
      : factor_(&factor), m_(&m), known_(&known), solves_(&solves) {}
  Eigen::Index rows() const { return m_->rows(); }
  Eigen::Index cols() const { return m_->cols(); }
  void set_shift(double) {}  // the factor has it
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Eigen::VectorXd> result(y, rows());
    result = factor_->solve(Eigen::Map<const Eigen::VectorXd>(x, rows()));
    if (known_->cols() > 0) {
      const Eigen::VectorXd mass = m_->selfadjointView<Eigen::Lower>() * result;
      const Eigen::VectorXd along = known_->transpose() * mass;
      result -= *known_ * along;
    }
    ++*solves_;
  }

 private:
  const Factor* factor_;
  const SparseMatrix* m_;
  const Eigen::MatrixXd* known_;
  int* solves_;
};

class Mass {
 public:
  using Scalar = double;
  explicit Mass(const SparseMatrix& m) : m_(&m) {}
  Eigen::Index rows() const { return m_->rows(); }
  Eigen::Index cols() const { return m_->cols(); }
  void perform_op(const double* x, double* y) const {
    Eigen::Map<Eigen::VectorXd>(y, rows()) =
        m_->selfadjointView<Eigen::Lower>() * Eigen::Map<const Eigen::VectorXd>(x, rows());
  }

 private:
  const SparseMatrix* m_;
};

struct Found {
  Eigen::VectorXd values;
  Eigen::MatrixXd vectors;
};

Found search(const Factor& factor, const SparseMatrix& m, double shift, const Eigen::MatrixXd& known, int count,
             double tolerance, const Eigen::VectorXd& start, int& solves) {
  Inverse inverse(factor, m, known, solves);
  Mass mass(m);
  const int basis = int(std::min<Eigen::Index>(m.rows(), std::max(2 * count + 2, 16)));
  Spectra::SymGEigsShiftSolver<Inverse, Mass, Spectra::GEigsMode::ShiftInvert> solver(inverse, mass, count, basis,
                                                                                      shift);
  if (start.size() == m.rows())
    solver.init(start.data());
  else
    solver.init();
  solver.compute(Spectra::SortRule::LargestMagn, 1000, tolerance);
  if (solver.info() != Spectra::CompInfo::Successful)
    throw RunError("the eigenvalue iteration did not converge. Choose more or fewer modes.");
  return {solver.eigenvalues(), solver.eigenvectors()};
}

/// Keeps both sets, ascending, M-normalised.
void merge(Found& all, const Found& more, const SparseMatrix& m) {
  const Eigen::Index n = all.values.size() + more.values.size();
  Eigen::VectorXd values(n);
  Eigen::MatrixXd vectors(m.rows(), n);
  values << all.values, more.values;
  if (all.values.size() > 0) vectors.leftCols(all.values.size()) = all.vectors;
  vectors.rightCols(more.values.size()) = more.vectors;
  std::vector<Eigen::Index> order(static_cast<std::size_t>(n));
  for (Eigen::Index i = 0; i < n; ++i) order[std::size_t(i)] = i;
  std::stable_sort(order.begin(), order.end(), [&](auto i, auto j) { return values[i] < values[j]; });
  all.values.resize(n);
  all.vectors.resize(m.rows(), n);
  for (Eigen::Index i = 0; i < n; ++i) {
    const auto column = vectors.col(order[std::size_t(i)]);
    const Eigen::VectorXd mass = m.selfadjointView<Eigen::Lower>() * column;
    all.values[i] = values[order[std::size_t(i)]];
    all.vectors.col(i) = column / std::sqrt(column.dot(mass));
  }
}

double largest_ratio(const SparseMatrix& k, const SparseMatrix& m) {
  return (k.diagonal().array() / m.diagonal().array()).maxCoeff();
}

Eigenpairs dense(const SparseMatrix& k, const SparseMatrix& m, int count) {
  const auto start = std::chrono::steady_clock::now();
  const Eigen::MatrixXd stiffness = k, mass = m;
  const EigenSolution<Eigen::MatrixXd> all = eigen_solution(stiffness, mass);
  Eigenpairs pairs;
  pairs.values = all.values.head(count);
  pairs.vectors = all.vectors.leftCols(count);
  pairs.iteration_seconds = seconds_since(start);
  return pairs;
}

/// Two hundred times further down at each try: a state that its own weight makes unstable has λ < 0.
double factorize(Factor& factor, const SparseMatrix& k, const SparseMatrix& m) {
  double shift = -1e-9 * largest_ratio(k, m);
  for (int tries = 0; !factor.compute(k - shift * m); ++tries, shift *= 200.0) {
    if (factor.lacked_memory())
      throw RunError(
          "there is not enough memory to factor the matrix of {} unknowns. Use fewer blocks (a larger block_scale for "
          "a generated assembly).",
          k.rows());
    if (tries == 6) throw RunError("the stiffness matrix cannot be factored: it has no finite values");
  }
  return shift;
}

Eigenpairs iterated(const SparseMatrix& k, const SparseMatrix& m, int count, EigenMemory& memory) {
  auto start = std::chrono::steady_clock::now();
  Eigenpairs pairs;
  Factor& factor = memory.factor;
  pairs.shift = factorize(factor, k, m);
  pairs.factor_entries = factor.entries();
  pairs.factor_bytes = factor.bytes();
  pairs.factor_seconds = seconds_since(start);
  start = std::chrono::steady_clock::now();
  Found all;
  merge(
      all,
      search(factor, m, pairs.shift, Eigen::MatrixXd(m.rows(), 0), count, memory.tolerance, memory.start, pairs.solves),
      m);
  // One vector's Krylov space holds one vector of each eigenspace: look for what it left out.
  while (memory.repeated && all.values.size() < m.rows()) {
    const Eigen::MatrixXd known = all.vectors;
    const double last = all.values[count - 1];
    if (search(factor, m, pairs.shift, known, 1, 1e-4, {}, pairs.solves).values[0] > last) break;
    const int more = int(std::min<Eigen::Index>(6, m.rows() - all.values.size()));
    merge(all, search(factor, m, pairs.shift, known, more, 1e-12, {}, pairs.solves), m);
  }
  pairs.values = all.values.head(count);
  pairs.vectors = all.vectors.leftCols(count);
  pairs.iteration_seconds = seconds_since(start);
  return pairs;
}

bool is_small(const SparseMatrix& m, int count) {
  // Lanczos needs room for a basis; and what is small is done sooner, and whole, by reduction to tridiagonal form.
  const bool small = m.rows() <= dense_below || 3 * count > m.rows();
  if (small && m.rows() > dense_most)
    throw InputError("{} too many for {} unknowns. Choose at most {}.", counted(count, "mode is", "modes are"),
                     m.rows(), m.rows() / 3);
  return small;
}

/// The sum of the vectors, and a tenth as much of everything: a mode of a symmetry that none of them has would not be
/// found from them alone.
Eigen::VectorXd beginning(const Eigen::MatrixXd& vectors) {
  Eigen::VectorXd start = vectors.rowwise().sum();
  const double size = 0.1 * std::sqrt(start.squaredNorm() / double(start.size()));
  std::uint64_t bits = 1;
  for (double& x : start) {
    bits = 6364136223846793005u * bits + 1442695040888963407u;  // Knuth (1998), §3.3.4
    x += size * (2.0 * double(bits >> 11) * 0x1p-53 - 1.0);
  }
  return start;
}

}  // namespace

Eigenpairs lowest_eigenpairs(const SparseMatrix& k, const SparseMatrix& m, int count) {
  EigenMemory memory;
  Eigenpairs pairs = is_small(m, count) ? dense(k, m, count) : iterated(k, m, count, memory);
  pairs.zero = 1e-10 * largest_ratio(k, m);
  return pairs;
}

Eigenpairs lowest_eigenpairs(const SparseMatrix& k, const SparseMatrix& m, int count, EigenMemory& memory) {
  Eigenpairs pairs;
  if (is_small(m, count)) {
    pairs = dense(k, m, count);
    pairs.shift = factorize(memory.factor, k, m);
  } else {
    pairs = iterated(k, m, count, memory);
  }
  memory.start = beginning(pairs.vectors);
  pairs.zero = 1e-10 * largest_ratio(k, m);
  return pairs;
}

}  // namespace voussoir
