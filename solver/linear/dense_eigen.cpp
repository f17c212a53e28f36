#include "solver/linear/dense_eigen.h"

#include <Eigen/Eigenvalues>

namespace voussoir {

namespace {

using Eigen::EigenvaluesOnly;
template <class M>
using Of = Eigen::SelfAdjointEigenSolver<M>;
template <class M>
using OfPair = Eigen::GeneralizedSelfAdjointEigenSolver<M>;

template <class M, class Solver>
EigenSolution<M> whole(const Solver& solver) {
  return {solver.eigenvalues(), solver.eigenvectors()};
}

}  // namespace

EigenSolution<Eigen::MatrixXd> eigen_solution(const Eigen::MatrixXd& a) {
  return whole<Eigen::MatrixXd>(Of<Eigen::MatrixXd>(a));
}
EigenSolution<Eigen::MatrixXcd> eigen_solution(const Eigen::MatrixXcd& a) {
  return whole<Eigen::MatrixXcd>(Of<Eigen::MatrixXcd>(a));
}
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& a) {
  return Of<Eigen::MatrixXd>(a, EigenvaluesOnly).eigenvalues();
}

EigenSolution<Eigen::MatrixXd> eigen_solution(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m) {
  return whole<Eigen::MatrixXd>(OfPair<Eigen::MatrixXd>(k, m));
}
Eigen::VectorXd eigenvalues(const Eigen::MatrixXd& k, const Eigen::MatrixXd& m) {
  return OfPair<Eigen::MatrixXd>(k, m, EigenvaluesOnly).eigenvalues();
}

double largest_eigenvalue(const Mat3& a) {
  return Of<Mat3>(a, EigenvaluesOnly).eigenvalues().maxCoeff();
}
double largest_eigenvalue(const Mat3& k, const Mat3& m) {
  return OfPair<Mat3>(k, m, EigenvaluesOnly).eigenvalues().maxCoeff();
}
double largest_eigenvalue(const Matrix6& k, const Matrix6& m) {
  return OfPair<Matrix6>(k, m, EigenvaluesOnly).eigenvalues().maxCoeff();
}

}  // namespace voussoir
