#include "solver/diagnosis/linear_model.h"

#include "solver/base/error.h"
#include "solver/linear/loose.h"
#include "solver/linear/stiffness.h"
#include "solver/model/quadrature.h"

namespace voussoir {

namespace {

using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix6x12 = Eigen::Matrix<double, 6, 12>;

Unknowns number_blocks(const Assembly& assembly) {
  Unknowns unknowns;
  for (const Block& block : assembly.blocks) {
    auto& of = unknowns.of.emplace_back();
    for (int c = 0; c < 6; ++c) of[c] = block.fixed ? -1 : unknowns.count++;
  }
  return unknowns;
}

}  // namespace

Matrix12 pair_stiffness(const Assembly& assembly, const Joint& joint) {
  const PatchShape shape = patch_shape(joint.polygon, joint.normal, 3);
  const Mat3 to_local = shape.frame.transpose();
  Matrix6x12 rows = Matrix6x12::Zero();
  rows.block<3, 3>(0, 0) = rows.block<3, 3>(3, 3) = -to_local;
  rows.block<3, 3>(0, 6) = rows.block<3, 3>(3, 9) = to_local;
  rows.block<3, 3>(0, 3) = to_local * skew(shape.centroid - assembly.blocks[std::size_t(joint.a)].centroid);
  rows.block<3, 3>(0, 9) = -to_local * skew(shape.centroid - assembly.blocks[std::size_t(joint.b)].centroid);
  Vector6 local;
  local << joint.kn * shape.area, joint.ks * shape.area, joint.ks * shape.area, joint.ks * (shape.ss + shape.tt),
      joint.kn * shape.tt, joint.kn * shape.ss;
  return rows.transpose() * local.asDiagonal() * rows;
}

Matrix6 block_mass(const Block& block) {
  Matrix6 m = Matrix6::Zero();
  m.topLeftCorner<3, 3>() = block.mass * Mat3::Identity();
  m.bottomRightCorner<3, 3>() = block.inertia;
  return m;
}

LinearModel linear_model(const Assembly& assembly) {
  std::vector<std::pair<std::int32_t, std::int32_t>> coupled;
  for (const Joint& joint : assembly.joints) coupled.emplace_back(joint.a, joint.b);
  BlockMatrix k(assembly.blocks.size(), coupled), m(assembly.blocks.size(), {});
  for (const Joint& joint : assembly.joints) {
    const Matrix12 pair = pair_stiffness(assembly, joint);
    const auto a = std::int32_t(joint.a), b = std::int32_t(joint.b);
    k.add(a, a, pair.topLeftCorner<6, 6>());
    k.add(b, b, pair.bottomRightCorner<6, 6>());
    k.add(b, a, pair.bottomLeftCorner<6, 6>());
  }
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    if (!assembly.blocks[i].fixed) m.diagonal(std::int32_t(i)) = block_mass(assembly.blocks[i]);
  LinearModel model;
  const Unknowns all = number_blocks(assembly);
  const Loose loose = find_loose(k, m, all);
  model.unknowns = without(all, loose.adrift);
  if (model.unknowns.count == 0) throw InputError("nothing in this assembly is held together: it has no modes");
  hold_free_ways(k, m, model.unknowns, loose);
  model.k = k.over(model.unknowns);
  model.m = m.over(model.unknowns);
  return model;
}

}  // namespace voussoir
