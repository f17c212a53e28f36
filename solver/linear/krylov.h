// Linear systems whose matrix is given only by its products with vectors. The solver is the GMRES method (Saad &
// Schultz 1986) of Eigen, following its documentation of matrix-free solvers.
#pragma once
#include <Eigen/Sparse>
#include <functional>
#include <unsupported/Eigen/IterativeSolvers>

namespace voussoir {

using LinearMap = std::function<Eigen::VectorXd(const Eigen::VectorXd&)>;

class ProductMatrix;

}  // namespace voussoir

template <>
struct Eigen::internal::traits<voussoir::ProductMatrix> : Eigen::internal::traits<Eigen::SparseMatrix<double>> {};

namespace voussoir {

/// A square matrix that is used only for products.
class ProductMatrix : public Eigen::EigenBase<ProductMatrix> {
 public:
  using Scalar = double;
  using RealScalar = double;
  using StorageIndex = int;
  enum { ColsAtCompileTime = Eigen::Dynamic, MaxColsAtCompileTime = Eigen::Dynamic, IsRowMajor = false };

  ProductMatrix(Eigen::Index size, LinearMap map) : apply(std::move(map)), size_(size) {}
  Eigen::Index rows() const { return size_; }
  Eigen::Index cols() const { return size_; }
  template <class Right>
  Eigen::Product<ProductMatrix, Right, Eigen::AliasFreeProduct> operator*(const Eigen::MatrixBase<Right>& x) const {
    return {*this, x.derived()};
  }

  LinearMap apply;

 private:
  Eigen::Index size_;
};

/// The approximate inverse as preconditioner.
class MapPreconditioner {
 public:
  template <class Matrix>
  MapPreconditioner& analyzePattern(const Matrix&) {
    return *this;
  }
  template <class Matrix>
  MapPreconditioner& factorize(const Matrix&) {
    return *this;
  }
  template <class Matrix>
  MapPreconditioner& compute(const Matrix&) {
    return *this;
  }
  Eigen::ComputationInfo info() const { return Eigen::Success; }
  template <class Right>
  Eigen::VectorXd solve(const Right& b) const {
    return apply(b);
  }

  LinearMap apply;
};

}  // namespace voussoir

template <class Right>
struct Eigen::internal::generic_product_impl<voussoir::ProductMatrix, Right, Eigen::SparseShape, Eigen::DenseShape,
                                             Eigen::GemvProduct>
    : Eigen::internal::generic_product_impl_base<voussoir::ProductMatrix, Right,
                                                 generic_product_impl<voussoir::ProductMatrix, Right>> {
  template <class To>
  static void scaleAndAddTo(To& to, const voussoir::ProductMatrix& matrix, const Right& x, const double& factor) {
    to += factor * matrix.apply(x);
  }
};

namespace voussoir {

/// Solves A x = b to a relative residual of `tolerance` with at most `most` products. Returns the best approximation if
/// that is not sufficient.
inline Eigen::VectorXd solve_by_products(const LinearMap& product, const LinearMap& approximate_inverse,
                                         const Eigen::VectorXd& b, double tolerance, int most) {
  const ProductMatrix matrix(b.size(), product);
  Eigen::GMRES<ProductMatrix, MapPreconditioner> gmres;
  gmres.preconditioner().apply = approximate_inverse;
  gmres.setTolerance(tolerance);
  gmres.setMaxIterations(most);
  gmres.set_restart(most);
  gmres.compute(matrix);
  return gmres.solve(b);
}

}  // namespace voussoir
