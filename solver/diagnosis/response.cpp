#include "solver/diagnosis/response.h"

#include <cmath>

#include "solver/effects/parts.h"

namespace voussoir {

namespace {

/// pull −= push, rows of a site.
void take(Eigen::MatrixXd& pull, const Unknowns& unknowns, std::size_t site, const Eigen::MatrixXd& push) {
  for (Eigen::Index c = 0; c < push.rows(); ++c)
    if (const std::int32_t at = unknowns.of[site][std::size_t(c)]; at >= 0) pull.row(at) -= push.row(c);
}

/// Forces on the unknowns, a column an axis, when a block moves without turning: −K e of what joins it to others.
Eigen::MatrixXd pull_of(const Assembly& assembly, std::int64_t base, const Unknowns& unknowns) {
  Eigen::MatrixXd pull = Eigen::MatrixXd::Zero(unknowns.count, 3);
  for (const Joint& joint : assembly.joints) {
    if (joint.a != base && joint.b != base) continue;
    const Matrix12 k = pair_stiffness(assembly, joint);
    if (joint.a == base)
      take(pull, unknowns, std::size_t(joint.b), k.block<6, 3>(6, 0));
    else
      take(pull, unknowns, std::size_t(joint.a), k.block<6, 3>(0, 6));
  }
  for (const FillJoint& patch : assembly.fill_joints) {
    if (patch.block != base) continue;
    const Matrix15 k = patch_stiffness(assembly, patch);
    const auto& nodes = assembly.fill.triangles[std::size_t(patch.triangle)];
    for (std::size_t i = 0; i < 3; ++i)
      take(pull, unknowns, unknowns.bodies + std::size_t(nodes[i]), k.block<3, 3>(Eigen::Index(6 + 3 * i), 0));
  }
  return pull;
}

}  // namespace

Eigen::MatrixXd translations(const Unknowns& unknowns) {
  Eigen::MatrixXd r = Eigen::MatrixXd::Zero(unknowns.count, 3);
  for (int axis = 0; axis < 3; ++axis) {
    Eigen::VectorXd column = r.col(axis);
    for (std::size_t i = 0; i < unknowns.of.size(); ++i) set_part(column, unknowns, i, Vector6::Unit(axis));
    r.col(axis) = column;
  }
  return r;
}

GroundForces ground_forces(const Assembly& assembly, const Unknowns& unknowns, const Eigen::MatrixXd& inertia) {
  GroundForces ground;
  ground.inertia = inertia;
  for (const std::string& support : supports(assembly)) {
    const std::int64_t base = base_of(assembly, support);
    ground.bases.push_back(base);
    ground.pull.push_back(pull_of(assembly, base, unknowns));
  }
  return ground;
}

namespace {

/// Γ = φᵀ M r, and of one support φᵀ M r_k with r_k = K⁻¹ pull, which is φᵀ pull/λ (Clough and Penzien 1993, §27-1).
void add_participation(Response& r) {
  const Eigen::RowVectorXd over = r.eigenvalues.cwiseInverse().transpose();
  r.participation = r.ground.inertia.transpose() * r.vectors;
  for (const Eigen::MatrixXd& pull : r.ground.pull)
    r.at_support.push_back((pull.transpose() * r.vectors).array().rowwise() * over.array());
}

}  // namespace

ModeWords words_of(const Assembly& assembly, const Unknowns& unknowns, double eigenvalue,
                   const Eigen::VectorXd& vector) {
  Mode mode;
  mode.eigenvalue = eigenvalue;
  mode.frequency = eigenvalue > 0.0 ? std::sqrt(eigenvalue) / (2.0 * EIGEN_PI) : 0.0;
  mode.shape = BlockMotions::Zero(Eigen::Index(assembly.blocks.size()), 6);
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    mode.shape.row(Eigen::Index(i)) = part_of(vector, unknowns, i);
  mode.nodes = NodeMotions::Zero(Eigen::Index(assembly.fill.nodes.size()), 3);
  for (std::size_t i = 0; i < assembly.fill.nodes.size(); ++i)
    mode.nodes.row(Eigen::Index(i)) = part_of(vector, unknowns, unknowns.bodies + i).head<3>();
  mode.modal_mass = 1.0;
  return mode_words(assembly, mode);
}

namespace {

/// What a sensor reads is a sum over the six unknowns of its block: direction · (u + θ × arm).
template <class Matrix>
Eigen::MatrixXd read(const Assembly& assembly, const Unknowns& unknowns, const std::vector<Sensor>& sensors,
                     const Matrix& vectors) {
  Eigen::MatrixXd seen = Eigen::MatrixXd::Zero(Eigen::Index(sensors.size()), vectors.cols());
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    const auto block = std::size_t(sensors[s].block);
    const Vec3 arm = sensors[s].position - assembly.blocks[block].centroid;
    Vector6 way;
    way << sensors[s].direction, arm.cross(sensors[s].direction);
    for (int c = 0; c < 6; ++c)
      if (const std::int32_t at = unknowns.of[block][std::size_t(c)]; at >= 0)
        seen.row(Eigen::Index(s)) += way[c] * vectors.row(at);
  }
  return seen;
}

}  // namespace

Eigen::MatrixXd at_sensors(const Assembly& assembly, const Unknowns& unknowns, const std::vector<Sensor>& sensors,
                           const Eigen::MatrixXd& vectors) {
  return read(assembly, unknowns, sensors, vectors);
}

Eigen::MatrixXd at_sensors(const Assembly& assembly, const Unknowns& unknowns, const std::vector<Sensor>& sensors,
                           const Basis& vectors) {
  return read(assembly, unknowns, sensors, vectors);
}

std::vector<Sensor> along_axes(const std::vector<Sensor>& sensors) {
  std::vector<Sensor> all;
  for (const Sensor& sensor : sensors)
    for (int axis = 0; axis < 3; ++axis) {
      all.push_back(sensor);
      all.back().direction = Vec3::Unit(axis);
    }
  return all;
}

Eigen::MatrixXd motions_at(const Assembly& assembly, const Unknowns& unknowns, const std::vector<Sensor>& sensors,
                           const Eigen::MatrixXd& vectors) {
  return at_sensors(assembly, unknowns, along_axes(sensors), vectors);
}

Eigen::MatrixXd sensor_loads(const Assembly& assembly, const Unknowns& unknowns, const std::vector<Sensor>& sensors) {
  Eigen::MatrixXd loads(unknowns.count, Eigen::Index(sensors.size()));
  for (std::size_t s = 0; s < sensors.size(); ++s) {
    const auto block = std::size_t(sensors[s].block);
    const Vec3 arm = sensors[s].position - assembly.blocks[block].centroid;
    Vector6 load;
    load << sensors[s].direction, arm.cross(sensors[s].direction);
    Eigen::VectorXd column = Eigen::VectorXd::Zero(unknowns.count);
    set_part(column, unknowns, block, load);
    loads.col(Eigen::Index(s)) = column;
  }
  return loads;
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
  r.motions = motions_at(assembly, model.unknowns, sensors, r.vectors);
  for (int i = 0; i < count; ++i)
    r.words.push_back(words_of(assembly, model.unknowns, pairs.values[i], r.vectors.col(i)));
  if (driven) {
    const Eigen::MatrixXd inertia = model.m.selfadjointView<Eigen::Lower>() * translations(model.unknowns);
    r.ground = ground_forces(assembly, model.unknowns, inertia);
    add_participation(r);
  }
  return r;
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
