#include "solver/diagnosis/response.h"

#include <cmath>

#include "solver/effects/parts.h"

namespace voussoir {

namespace {

/// Forces on the unknowns, a column an axis, when a block moves without turning and these stiffnesses join it to
/// others: −K e.
Eigen::MatrixXd pull_of(std::int64_t base, const std::vector<Derivative::Pair>& pairs, const Unknowns& unknowns) {
  Eigen::MatrixXd pull = Eigen::MatrixXd::Zero(unknowns.count, 3);
  for (const Derivative::Pair& pair : pairs) {
    if (pair.a != base && pair.b != base) continue;
    const bool first = pair.a == base;
    const auto other = std::size_t(first ? pair.b : pair.a);
    for (int axis = 0; axis < 3; ++axis) {
      Eigen::VectorXd column = pull.col(axis);
      const Vector6 force = first ? pair.k.block<6, 1>(6, axis) : pair.k.block<6, 1>(0, 6 + axis);
      set_part(column, unknowns, other, part_of(column, unknowns, other) - force);
      pull.col(axis) = column;
    }
  }
  return pull;
}

Eigen::MatrixXd translations(const Assembly& assembly, const Unknowns& unknowns) {
  Eigen::MatrixXd r = Eigen::MatrixXd::Zero(unknowns.count, 3);
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::VectorXd column = r.col(axis);
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i) set_part(column, unknowns, i, Vector6::Unit(axis));
    r.col(axis) = column;
  }
  return r;
}

GroundForces ground_forces(const Assembly& assembly, const LinearModel& model) {
  GroundForces ground;
  ground.inertia = model.m.selfadjointView<Eigen::Lower>() * translations(assembly, model.unknowns);
  for (const std::string& support : supports(assembly)) {
    const std::int64_t base = base_of(assembly, support);
    std::vector<Derivative::Pair> pairs;
    for (const Joint& joint : assembly.joints)
      if (joint.a == base || joint.b == base) pairs.push_back({joint.a, joint.b, pair_stiffness(assembly, joint)});
    ground.bases.push_back(base);
    ground.pull.push_back(pull_of(base, pairs, model.unknowns));
  }
  return ground;
}

/// Γ = φᵀ M r, and of one support φᵀ M r_k with r_k = K⁻¹ pull, which is φᵀ pull/λ (Clough and Penzien 1993, §27-1).
void add_participation(Response& r) {
  const Eigen::RowVectorXd over = r.eigenvalues.cwiseInverse().transpose();
  r.participation = r.ground.inertia.transpose() * r.vectors;
  for (const Eigen::MatrixXd& pull : r.ground.pull)
    r.at_support.push_back((pull.transpose() * r.vectors).array().rowwise() * over.array());
}

/// The same of derivatives: of vectors `moved`, with `d` of K and M.
void add_participation(const Assembly& assembly, const Response& r, const LinearModel& model, const Derivative& d,
                       const Eigen::MatrixXd& moved, ModalData& result) {
  const Eigen::MatrixXd r3 = translations(assembly, model.unknowns);
  const Eigen::RowVectorXd over = r.eigenvalues.cwiseInverse().transpose();
  result.participation = r.ground.inertia.transpose() * moved;
  for (int axis = 0; axis < 3; ++axis)
    result.participation.row(axis) += times_mass(d, model.unknowns, r3.col(axis)).transpose() * r.vectors;
  for (std::size_t k = 0; k < r.ground.bases.size(); ++k) {
    const Eigen::MatrixXd pull = pull_of(r.ground.bases[k], d.pairs, model.unknowns);
    const Eigen::MatrixXd work = r.ground.pull[k].transpose() * moved + pull.transpose() * r.vectors;
    result.at_support.push_back(work.array().rowwise() * over.array() -
                                r.at_support[k].array().rowwise() * (2.0 * result.log_frequency.transpose().array()));
  }
}

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
                  EigenMemory& memory, bool driven) {
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
  if (driven) {
    r.ground = ground_forces(assembly, model);
    add_participation(r);
  }
  return r;
}

ModalData response_derivative(const Assembly& assembly, const Response& r, const LinearModel& model,
                              const Derivative& d, const std::vector<Sensor>& sensors, const EigenMemory& memory,
                              const std::vector<bool>& wanted) {
  const Eigen::Index count = r.vectors.cols();
  ModalData result;
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
  const bool driven = r.participation.size() > 0;
  if (sensors.empty() && !driven) return result;
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
  if (driven) add_participation(assembly, r, model, d, rest + r.vectors * shares, result);
  return result;
}

Eigen::MatrixXd follow_support(const Assembly& assembly, const Response& r, const LinearModel& model,
                               std::size_t support, const std::vector<Sensor>& sensors, const EigenMemory& memory) {
  const Eigen::MatrixXd& pull = r.ground.pull.at(support);
  // The factor is that of K − σ M: modes that are known are put right.
  const Eigen::VectorXd missing = r.eigenvalues.cwiseInverse() - (r.eigenvalues.array() - r.shift).inverse().matrix();
  const Eigen::MatrixXd u = memory.factor.solve(pull) + r.vectors * missing.asDiagonal() * r.vectors.transpose() * pull;
  return at_sensors(assembly, model.unknowns, sensors, u);
}

}  // namespace voussoir
