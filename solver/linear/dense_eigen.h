// Eigenvalues of dense symmetric matrices with Eigen. They are compiled in one place because each file that
// instantiates them needs up to half a minute more compile time.
#pragma once
#include <Eigen/Dense>

#include "solver/linear/unknowns.h"

namespace voussoir {

/// Solution of A x = λ x, or K x = λ M x: values ascending, one vector in each column.
template <class Matrix>
struct EigenSolution {
  Eigen::VectorXd values;
  Matrix vectors;
};

/// For symmetric or Hermitian matrices, of which the lower half is read; vectors have length one.
EigenSolution<Eigen::MatrixXd> eigen_solution(const Eigen::MatrixXd& a);
EigenSolution<Eigen::MatrixXcd> eigen_solution(const Eigen::MatrixXcd& a);
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& a);

/// For symmetric `k` and symmetric positive definite `m`; vectors have xᵀ M x = 1.
EigenSolution<Eigen::MatrixXd> eigen_solution(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m);
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m);

double largest_eigenvalue(const Mat3& a);
double largest_eigenvalue(const Mat3& k, const Mat3& m);
double largest_eigenvalue(const Matrix6& k, const Matrix6& m);

}  // namespace voussoir
