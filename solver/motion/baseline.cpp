#include "solver/motion/baseline.h"

#include <Eigen/Dense>

namespace voussoir {

std::vector<double> integrate(const std::vector<double>& samples, double dt) {
  std::vector<double> sum(samples.size(), 0.0);
  for (std::size_t i = 1; i < samples.size(); ++i) sum[i] = sum[i - 1] + 0.5 * dt * (samples[i - 1] + samples[i]);
  return sum;
}

namespace {

constexpr int terms = 3;

/// One component: least squares with the end velocity as a Lagrange condition. The basis velocities are integrated by
/// the same rule as the record, so that the end velocity is zero to rounding.
void correct(std::vector<double>& acceleration, double dt) {
  const std::size_t n = acceleration.size();
  const std::vector<double> velocity = integrate(acceleration, dt);
  std::array<std::vector<double>, terms> basis, basis_velocity;
  for (int k = 0; k < terms; ++k) {
    basis[k].resize(n);
    for (std::size_t i = 0; i < n; ++i) basis[k][i] = std::pow(double(i) / double(n - 1), k);
    basis_velocity[k] = integrate(basis[k], dt);
  }
  Eigen::Matrix<double, terms + 1, terms + 1> matrix = decltype(matrix)::Zero();
  Eigen::Matrix<double, terms + 1, 1> right = decltype(right)::Zero();
  for (int j = 0; j < terms; ++j) {
    for (std::size_t i = 0; i < n; ++i) {
      right[j] += basis_velocity[j][i] * velocity[i];
      for (int k = 0; k < terms; ++k) matrix(j, k) += basis_velocity[j][i] * basis_velocity[k][i];
    }
    matrix(j, terms) = matrix(terms, j) = basis_velocity[j][n - 1];
  }
  right[terms] = velocity[n - 1];
  const Eigen::Matrix<double, terms + 1, 1> c = matrix.fullPivLu().solve(right);
  for (int k = 0; k < terms; ++k)
    for (std::size_t i = 0; i < n; ++i) acceleration[i] -= c[k] * basis[k][i];
}

}  // namespace

GroundMotion correct_baseline(const GroundMotion& motion) {
  GroundMotion corrected = motion;
  const std::size_t n = motion.acceleration.size();
  if (n < 5) return corrected;
  for (int axis = 0; axis < 3; ++axis) {
    std::vector<double> component(n);
    for (std::size_t i = 0; i < n; ++i) component[i] = motion.acceleration[i][axis];
    correct(component, motion.dt);
    for (std::size_t i = 0; i < n; ++i) corrected.acceleration[i][axis] = component[i];
  }
  return corrected;
}

}  // namespace voussoir
