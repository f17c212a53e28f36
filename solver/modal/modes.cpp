#include "solver/modal/modes.h"

#include <fmt/format.h>

#include <Eigen/Cholesky>
#include <chrono>

#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/linear/loose.h"

namespace voussoir {

namespace {

void check_mass(const Assembly& assembly, const Model& model, const BlockMatrix& m, const Unknowns& unknowns) {
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const Matrix6& block = m.diagonal(std::int32_t(i));
    if (!unknowns.any(i) || (block.allFinite() && block.llt().info() == Eigen::Success)) continue;
    throw InputError("the mass matrix of {} is singular: its mass is {} kg. Give its material a density above 0.",
                     block_label(assembly, model.block_of_body[i]), model.bodies[i].inertial_mass);
  }
}

/// The eigenvector as motions of blocks and nodes, scaled to a largest displacement of 1.
void set_motions(const Model& model, const Unknowns& unknowns, const Eigen::VectorXd& vector, Mode& mode) {
  mode.shape = BlockMotions::Zero(Eigen::Index(model.bodies.size()), 6);
  mode.nodes = NodeMotions::Zero(Eigen::Index(model.fill.nodes.size()), 3);
  double largest = 0.0, most = 0.0, sign = 1.0;
  for (std::size_t i = 0; i < model.sites(); ++i) {
    const Vector6 part = part_of(vector, unknowns, i);
    if (i < model.bodies.size())
      mode.shape.row(model.block_of_body[i]) = part;
    else
      mode.nodes.row(model.fill.mesh_node[i - model.bodies.size()]) = part.head<3>();
    largest = std::max(largest, part.head<3>().norm());
    for (int c = 0; c < 3; ++c)
      if (std::abs(part[c]) > (1.0 + 1e-6) * most) most = std::abs(part[c]), sign = part[c] < 0.0 ? -1.0 : 1.0;
  }
  if (largest == 0.0) largest = vector.cwiseAbs().maxCoeff();  // nothing but turns
  mode.shape *= sign / largest;
  mode.nodes *= sign / largest;
}

/// kg: φᵀ M φ of the shape, and the effective masses.
void weigh(const BlockMatrix& m, const Model& model, Mode& mode) {
  Vec3 excitation = Vec3::Zero();
  mode.modal_mass = 0.0;
  for (std::size_t i = 0; i < model.bodies.size(); ++i) {
    const Vector6 part = mode.shape.row(model.block_of_body[i]);
    const Vector6 momentum = m.diagonal(std::int32_t(i)) * part;
    mode.modal_mass += part.dot(momentum);
    excitation += momentum.head<3>();
  }
  for (std::size_t i = 0; i < model.fill.nodes.size(); ++i) {
    const Vec3 u = mode.nodes.row(model.fill.mesh_node[i]);
    mode.modal_mass += model.fill.inertial[i] * u.squaredNorm();
    excitation += model.fill.inertial[i] * u;
  }
  mode.participation = excitation / mode.modal_mass;
  mode.effective = excitation.cwiseAbs2() / mode.modal_mass;
}

double residual(const SparseMatrix& k, const SparseMatrix& m, double value, const Eigen::VectorXd& vector) {
  const Eigen::VectorXd mass = m.selfadjointView<Eigen::Lower>() * vector;
  const Eigen::VectorXd left = k.selfadjointView<Eigen::Lower>() * vector - value * mass;
  const Eigen::ArrayXd scale = m.diagonal().array();
  return std::sqrt((left.array().square() / scale).sum() / ((value * mass).array().square() / scale).sum());
}

std::vector<std::int64_t> blocks_of(const Model& model, const std::vector<std::int32_t>& bodies) {
  std::vector<std::int64_t> blocks;
  for (std::int32_t body : bodies)  // the sites after them are nodes of the fill
    if (std::size_t(body) < model.bodies.size()) blocks.push_back(model.block_of_body[std::size_t(body)]);
  std::sort(blocks.begin(), blocks.end());
  return blocks;
}

void check_count(int count, std::int32_t unknowns, std::size_t adrift, int held) {
  if (count < 1) throw InputError("the number of modes is {}. It must be at least 1.", count);
  if (count <= unknowns) return;
  const std::string left =
      adrift > 0 || held > 0
          ? fmt::format(" (without {} and {} of other blocks that nothing holds)", counted(adrift, "block"),
                        counted(held, "degree of freedom", "degrees of freedom"))
          : "";
  throw InputError("the number of modes is {}, but the model has {}{}. Choose at most {}.", count,
                   counted(unknowns, "unknown"), left, unknowns);
}

}  // namespace

Modes find_modes(const Assembly& assembly, const Model& model, const State& state, int count, PatchTangent tangent,
                 const Array<double>* wrenches, int extra) {
  const auto start = std::chrono::steady_clock::now();
  const Unknowns all = number_unknowns(model);
  check_count(count, all.count, 0, 0);
  const BlockMatrix m = mass_blocks(model, state, all);
  check_mass(assembly, model, m, all);
  BlockMatrix k = stiffness_blocks(model, state, tangent);
  const Loose loose = find_loose(k, m, all);
  const Unknowns unknowns = without(all, loose.adrift);
  BlockMatrix firm = k;
  const int ways = hold_free_ways(firm, m, unknowns, loose);
  if (wrenches)
    for (BlockMatrix* matrix : {&k, &firm}) add_geometric_stiffness(*matrix, model, state, *wrenches);
  const SparseMatrix plain = k.over(unknowns), mass = m.over(unknowns);
  check_count(count, unknowns.count - ways, loose.bodies.size(), ways);
  count = std::min(count + extra, unknowns.count - ways);
  const SparseMatrix held = firm.over(unknowns);

  Modes result;
  result.adrift = blocks_of(model, loose.bodies);
  result.partly = blocks_of(model, loose.partly);
  for (std::size_t i = 0; i < model.bodies.size(); ++i)
    if (all.any(i)) result.mass += model.bodies[i].inertial_mass;
  for (const double each : model.fill.inertial) result.mass += each;
  result.report.unknowns = unknowns.count;
  result.report.assembly_seconds = std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
  result.report.solution = lowest_eigenpairs(held, mass, count);
  Eigenpairs& found = result.report.solution;
  for (int i = 0; i < count; ++i) {
    Mode mode;
    mode.eigenvalue = found.values[i];
    const bool zero = std::abs(mode.eigenvalue) <= found.zero;
    if (!zero && mode.eigenvalue > 0.0) mode.frequency = std::sqrt(mode.eigenvalue) / (2.0 * EIGEN_PI);
    if (!zero) mode.residual = residual(plain, mass, mode.eigenvalue, found.vectors.col(i));
    set_motions(model, unknowns, found.vectors.col(i), mode);
    weigh(m, model, mode);
    mode.words = mode_words(assembly, mode);
    result.modes.push_back(std::move(mode));
  }
  found.vectors.resize(0, 0);
  return result;
}

}  // namespace voussoir
