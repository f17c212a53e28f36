// Eigenvalues of dense symmetric matrices by Eigen, compiled in one place: a file that does so itself takes the
// compiler up to half a minute more.
#pragma once
#include <Eigen/Dense>

#include "solver/linear/unknowns.h"

namespace voussoir {

/// Of A x = λ x, or K x = λ M x: values ascending, one vector a column.
template <class Matrix>
struct EigenSolution {
  Eigen::VectorXd values;
  Matrix vectors;
};

/// Symmetric or Hermitian matrices, of which the lower half is read; vectors of length one.
EigenSolution<Eigen::MatrixXd> eigen_solution(const Eigen::MatrixXd& a);
EigenSolution<Eigen::MatrixXcd> eigen_solution(const Eigen::MatrixXcd& a);
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& a);

/// Symmetric `k` and `m`, the latter positive definite; vectors with xᵀ M x = 1.
EigenSolution<Eigen::MatrixXd> eigen_solution(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m);
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m);

double largest_eigenvalue(const Mat3& a);
double largest_eigenvalue(const Mat3& k, const Mat3& m);
double largest_eigenvalue(const Matrix6& k, const Matrix6& m);

}  // namespace voussoir
