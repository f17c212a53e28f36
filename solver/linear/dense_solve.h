// Dense systems of equations by Eigen, compiled in one place as dense_eigen.h is: every decomposition that a file
// instantiates itself takes the compiler seconds.
#pragma once
#include <Eigen/Dense>

namespace voussoir {

/// x of A x = b for a symmetric A without negative eigenvalues, by LDLᵀ.
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// D of A = P ᵀL D Lᵀ P, symmetric A; their product is its determinant.
Eigen::VectorXd pivots_of(const Eigen::MatrixXd& a);

/// A⁻¹ by LU with partial pivoting.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& a);

/// L⁻¹ of A = L Lᵀ, symmetric positive definite A: L⁻¹ x has the covariance 1 where x has A.
Eigen::MatrixXd whitening_of(const Eigen::MatrixXd& a);

/// L of A = L Lᵀ.
Eigen::MatrixXd lower_factor(const Eigen::MatrixXd& a);

/// x of least |A x − b|, by QR with pivoting of columns; one of them where the columns depend on each other.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// The shortest of the x of least |A x − b|, one a column of b, whatever the rank of A: complete orthogonal
/// decomposition.
Eigen::MatrixXd shortest_least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace voussoir
