#include "solver/linear/dense_solve.h"

namespace voussoir {

using Eigen::MatrixXd, Eigen::VectorXd;

VectorXd solve_symmetric(const MatrixXd& a, const VectorXd& b) {
  return a.ldlt().solve(b);
}
MatrixXd solve_symmetric(const MatrixXd& a, const MatrixXd& b) {
  return a.ldlt().solve(b);
}

VectorXd pivots_of(const MatrixXd& a) {
  return a.ldlt().vectorD();
}

MatrixXd inverse_of(const MatrixXd& a) {
  return a.inverse();
}

MatrixXd whitening_of(const MatrixXd& a) {
  return a.llt().matrixL().solve(MatrixXd::Identity(a.rows(), a.cols()));
}

MatrixXd lower_factor(const MatrixXd& a) {
  return a.llt().matrixL();
}

VectorXd least_squares(const MatrixXd& a, const VectorXd& b) {
  return a.colPivHouseholderQr().solve(b);
}

MatrixXd shortest_least_squares(const MatrixXd& a, const MatrixXd& b) {
  return a.completeOrthogonalDecomposition().solve(b);
}

}  // namespace voussoir
