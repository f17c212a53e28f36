// Dense systems of equations with Eigen, compiled in one place as in dense_eigen.h, because every instantiated
// decomposition takes seconds of compile time.
#pragma once
#include <Eigen/Dense>

namespace voussoir {

/// x of A x = b for a symmetric A without negative eigenvalues, by LDLᵀ.
Eigen::VectorXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);
Eigen::MatrixXd solve_symmetric(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

/// D of A = Pᵀ L D Lᵀ P, symmetric A; the product of its entries is the determinant of A.
Eigen::VectorXd pivots_of(const Eigen::MatrixXd& a);

/// A⁻¹ by LU with partial pivoting.
Eigen::MatrixXd inverse_of(const Eigen::MatrixXd& a);

/// L⁻¹ of A = L Lᵀ, symmetric positive definite A: if x has the covariance A, L⁻¹ x has the unit matrix as covariance.
Eigen::MatrixXd whitening_of(const Eigen::MatrixXd& a);

/// L of A = L Lᵀ.
Eigen::MatrixXd lower_factor(const Eigen::MatrixXd& a);

/// x with the least |A x − b|, by QR with column pivoting; one of the solutions if the columns are dependent.
Eigen::VectorXd least_squares(const Eigen::MatrixXd& a, const Eigen::VectorXd& b);

/// The shortest x with the least |A x − b|, one for each column of b, for any rank of A: complete orthogonal
/// decomposition.
Eigen::MatrixXd shortest_least_squares(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b);

}  // namespace voussoir
