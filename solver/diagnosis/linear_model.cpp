#include "solver/diagnosis/linear_model.h"

#include <tuple>

#include "solver/base/error.h"
#include "solver/linear/loose.h"
#include "solver/linear/stiffness.h"
#include "solver/model/quadrature.h"

namespace voussoir {

namespace {

using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix6x12 = Eigen::Matrix<double, 6, 12>;

Matrix6 block_mass(const Block& block) {
  Matrix6 m = Matrix6::Zero();
  m.topLeftCorner<3, 3>() = block.mass * Mat3::Identity();
  m.bottomRightCorner<3, 3>() = block.inertia;
  return m;
}

Unknowns number_blocks(const Assembly& assembly) {
  Unknowns unknowns;
  for (const Block& block : assembly.blocks) {
    auto& of = unknowns.of.emplace_back();
    for (int c = 0; c < 6; ++c) of[c] = block.fixed ? -1 : unknowns.count++;
  }
  return unknowns;
}

auto key(const Joint& j) {
  return std::tuple(j.a, j.b, j.cell_a, j.cell_b, j.face_a, j.face_b);
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

Derivative derivative(const Assembly& low, const Assembly& high, double apart) {
  if (low.blocks.size() != high.blocks.size())
    throw InputError("the two assemblies have {} and {} blocks: K and M cannot be compared", low.blocks.size(),
                     high.blocks.size());
  Derivative d;
  const auto add = [&](const Assembly& of, const Joint& joint, double factor) {
    d.pairs.push_back({joint.a, joint.b, factor * pair_stiffness(of, joint)});
  };
  Joint difference;
  auto l = low.joints.begin(), h = high.joints.begin();
  while (l != low.joints.end() || h != high.joints.end()) {
    const bool only_low = h == high.joints.end() || (l != low.joints.end() && key(*l) < key(*h));
    const bool only_high = !only_low && (l == low.joints.end() || key(*h) < key(*l));
    if (only_low) {
      add(low, *l++, -1.0 / apart);
    } else if (only_high) {
      add(high, *h++, 1.0 / apart);
    } else {
      if (l->polygon != h->polygon) {
        add(high, *h, 1.0 / apart);
        d.pairs.back().k -= pair_stiffness(low, *l) / apart;
      } else if (l->kn != h->kn || l->ks != h->ks) {  // the stiffness is linear in both
        difference = *h;
        difference.kn -= l->kn, difference.ks -= l->ks;
        add(high, difference, 1.0 / apart);
      }
      ++l, ++h;
    }
  }
  for (std::size_t i = 0; i < low.blocks.size(); ++i) {
    const Block &a = low.blocks[i], &b = high.blocks[i];
    if (!a.fixed && (a.mass != b.mass || a.inertia != b.inertia))
      d.blocks.push_back({std::int64_t(i), (block_mass(b) - block_mass(a)) / apart});
  }
  return d;
}

Eigen::VectorXd times_stiffness(const Derivative& d, const Unknowns& unknowns, const Eigen::VectorXd& x) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(x.size());
  for (const Derivative::Pair& pair : d.pairs) {
    const auto a = std::size_t(pair.a), b = std::size_t(pair.b);
    Vector12 u;
    u.head<6>() = part_of(x, unknowns, a);
    u.tail<6>() = part_of(x, unknowns, b);
    const Vector12 f = pair.k * u;
    set_part(y, unknowns, a, part_of(y, unknowns, a) + f.head<6>());
    set_part(y, unknowns, b, part_of(y, unknowns, b) + f.tail<6>());
  }
  return y;
}

Eigen::VectorXd times_mass(const Derivative& d, const Unknowns& unknowns, const Eigen::VectorXd& x) {
  Eigen::VectorXd y = Eigen::VectorXd::Zero(x.size());
  for (const Derivative::Own& own : d.blocks)
    set_part(y, unknowns, std::size_t(own.block), own.m * part_of(x, unknowns, std::size_t(own.block)));
  return y;
}

}  // namespace voussoir
