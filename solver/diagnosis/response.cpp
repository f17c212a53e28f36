#include "solver/diagnosis/response.h"

#include <cmath>

namespace voussoir {

namespace {

/// A mode as mode_words() wants it.
Mode as_mode(const Assembly& assembly, const LinearModel& model, double eigenvalue, const Eigen::VectorXd& vector) {
  Mode mode;
  mode.eigenvalue = eigenvalue;
  mode.frequency = eigenvalue > 0.0 ? std::sqrt(eigenvalue) / (2.0 * EIGEN_PI) : 0.0;
  mode.shape = BlockMotions::Zero(Eigen::Index(assembly.blocks.size()), 6);
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    mode.shape.row(Eigen::Index(i)) = part_of(vector, model.unknowns, i);
  mode.modal_mass = 1.0;
  return mode;
}

}  // namespace

Eigen::MatrixXd at_sensors(const Assembly& assembly, const Unknowns& unknowns, const std::vector<Sensor>& sensors,
                           const Eigen::MatrixXd& vectors) {
  Eigen::MatrixXd seen(Eigen::Index(sensors.size()), vectors.cols());
  for (Eigen::Index mode = 0; mode < vectors.cols(); ++mode) {
    const Eigen::VectorXd vector = vectors.col(mode);
    for (std::size_t s = 0; s < sensors.size(); ++s) {
      const auto block = std::size_t(sensors[s].block);
      const Vector6 motion = part_of(vector, unknowns, block);
      const Vec3 arm = sensors[s].position - assembly.blocks[block].centroid;
      seen(Eigen::Index(s), mode) = sensors[s].direction.dot(motion.head<3>() + Vec3(motion.tail<3>()).cross(arm));
    }
  }
  return seen;
}

Response response(const Assembly& assembly, const LinearModel& model, const std::vector<Sensor>& sensors, int count,
                  EigenMemory& memory) {
  count = std::min(count, int(model.unknowns.count));
  const Eigenpairs pairs = lowest_eigenpairs(model.k, model.m, count, memory);
  Response r;
  r.eigenvalues = pairs.values.cwiseMax(pairs.zero);
  r.log_frequency = (r.eigenvalues.cwiseSqrt() / (2.0 * EIGEN_PI)).array().log();
  r.vectors = pairs.vectors;
  r.shift = pairs.shift;
  r.sensors = at_sensors(assembly, model.unknowns, sensors, r.vectors);
  for (int i = 0; i < count; ++i)
    r.words.push_back(mode_words(assembly, as_mode(assembly, model, pairs.values[i], r.vectors.col(i))));
  return r;
}

ResponseDerivative response_derivative(const Assembly& assembly, const Response& r, const LinearModel& model,
                                       const Derivative& d, const std::vector<Sensor>& sensors,
                                       const EigenMemory& memory, const std::vector<bool>& wanted) {
  const Eigen::Index count = r.vectors.cols();
  ResponseDerivative result;
  result.log_frequency = Eigen::VectorXd::Zero(count);
  Eigen::MatrixXd forces = Eigen::MatrixXd::Zero(r.vectors.rows(), count);  // −(K′ − λ M′) φ
  Eigen::VectorXd stretch = Eigen::VectorXd::Zero(count);                   // −½ φᵀ M′ φ
  for (Eigen::Index i = 0; i < count; ++i) {
    if (!wanted[std::size_t(i)]) continue;
    const Eigen::VectorXd phi = r.vectors.col(i);
    const Eigen::VectorXd mass = times_mass(d, model.unknowns, phi);
    forces.col(i) = r.eigenvalues[i] * mass - times_stiffness(d, model.unknowns, phi);
    result.log_frequency[i] = -0.5 * phi.dot(forces.col(i)) / r.eigenvalues[i];
    stretch[i] = -0.5 * phi.dot(mass);
  }
  result.sensors = Eigen::MatrixXd::Zero(Eigen::Index(sensors.size()), count);
  if (sensors.empty()) return result;
  const Eigen::MatrixXd rest = memory.factor.solve(forces);
  const Eigen::MatrixXd along = r.vectors.transpose() * forces;  // mode j, of mode i
  Eigen::MatrixXd shares = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index i = 0; i < count; ++i) {
    if (!wanted[std::size_t(i)]) continue;
    for (Eigen::Index j = 0; j < count; ++j) {
      const double whole = 1.0 / (r.eigenvalues[j] - r.shift);  // what the static solution has of mode j
      if (j == i) {
        shares(j, i) = stretch[i] - along(j, i) * whole;
        continue;
      }
      // Modes that coincide are a plane: which two vectors of it the solver returns means nothing.
      double gap = r.eigenvalues[j] - r.eigenvalues[i];
      const double least = 1e-3 * r.eigenvalues[i];
      if (std::abs(gap) < least) gap = gap < 0.0 ? -least : least;
      shares(j, i) = along(j, i) * (1.0 / gap - whole);
    }
  }
  result.sensors = at_sensors(assembly, model.unknowns, sensors, rest) + r.sensors * shares;
  return result;
}

}  // namespace voussoir
