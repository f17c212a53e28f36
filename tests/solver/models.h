// What the tests of the solver share: the models of the validation ladder, and GoogleTest.
#pragma once
#include <gtest/gtest.h>

#include "geometry/stiffness.h"
#include "solver/effects/parts.h"
#include "solver/model/kernels.h"
#include "tools/ladder/models.h"

namespace voussoir::test {

using namespace ladder;

/// Whether the kernels at work are not those of the library, with which the plain serial loop is compiled. Such kernels
/// round differently, with fused multiply-add; the tests kernels_sse2 compare those of the library.
inline bool kernels_are_compiled_apart() {
  return &kernels() != usable_kernels().front();
}

/// Adds a bar from a point of block a to one of block b, not along z: E A, yield force and pretension in N.
inline void add_tie(Assembly& assembly, std::int64_t a, const Vec3& from, std::int64_t b, const Vec3& to, double axial,
                    double yield_force, double pretension) {
  const Vec3 side = 0.02 * (to - from).cross(Vec3::UnitZ()).normalized();
  const Polygon strip = {from - side, from + side, to + side, to - side};
  const double area = polygon_area(strip);
  JointLaw law;
  law.kind = JointLaw::Kind::tie;
  law.tension = yield_force / area;
  law.prestress = pretension / area;
  const double kn = axial / (to - from).norm() / area;
  add_joint(assembly, a, b, strip, polygon_normal(strip), kn, kn, law_index(assembly.laws, law));
}

/// Dense K and M over the unknowns (present placement).
struct DenseSystem {
  Eigen::MatrixXd k, m;
};
inline DenseSystem dense_system(const Bench& bench, PatchTangent kind = PatchTangent::intact,
                                const Array<double>* wrenches = nullptr) {
  const Unknowns unknowns = number_unknowns(bench.model);
  DenseSystem system;
  BlockMatrix blocks = stiffness_blocks(bench.model, bench.state, kind);
  if (wrenches) add_geometric_stiffness(blocks, bench.model, bench.state, *wrenches);
  const Eigen::MatrixXd lower = blocks.over(unknowns);
  system.k = lower.selfadjointView<Eigen::Lower>();
  system.m = Eigen::MatrixXd::Zero(unknowns.count, unknowns.count);
  for (std::size_t i = 0; i < bench.model.bodies.size(); ++i) {
    const Matrix6 m = body_mass(bench.model, bench.state, i);
    for (int r = 0; r < 6; ++r)
      for (int c = 0; c < 6; ++c)
        if (unknowns.of[i][r] >= 0 && unknowns.of[i][c] >= 0) system.m(unknowns.of[i][r], unknowns.of[i][c]) = m(r, c);
  }
  for (std::size_t i = 0; i < bench.model.fill.nodes.size(); ++i)
    for (const std::int32_t unknown : unknowns.of[bench.model.bodies.size() + i])
      if (unknown >= 0) system.m(unknown, unknown) = bench.model.fill.inertial[i];
  return system;
}

}  // namespace voussoir::test
