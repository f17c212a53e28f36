// Stones and fill together: the assembled stiffness is the derivative of the step's forces, modes and equilibrium.
#include "solver/linear/dense_eigen.h"
#include "tests/solver/models.h"
#include "tools/ladder/fill_models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Two free stones on fill in a trough of fixed ones; the interface bonded, so that everything is elastic.
Assembly bonded_trough() {
  Assembly assembly = stone();
  add_box(assembly, {-1, -1, -1}, {3, 3, 0}, true);
  add_box(assembly, {-1, 0, 0}, {0, 2, 1.5}, true);
  add_box(assembly, {0, 0, 1}, {1.2, 2, 1.5}, false);
  add_box(assembly, {1.2, 0, 1}, {2, 2, 1.5}, false);
  FillMesh mesh = box_mesh({0, 0, 0}, {2, 2, 1}, 3, 4, 2);
  return filled(std::move(assembly), std::move(mesh), elastic_fill(1500.0, 266e6, 160e6), 2e9, 0.8e9, elastic_law());
}

/// Puts bodies and nodes where `x` says, by small motions from the reference placement.
void displace_all(Bench& bench, const Unknowns& unknowns, const Eigen::VectorXd& x) {
  for (std::size_t i = 0; i < bench.model.bodies.size(); ++i) {
    const Vector6 part = part_of(x, unknowns, i);
    const Vec3 turn = 0.5 * part.tail<3>();
    const Eigen::Quaterniond q = Eigen::Quaterniond(1.0, turn.x(), turn.y(), turn.z()).normalized();
    bench.place(bench.model.block_of_body[i], part.head<3>(), q);
  }
  for (std::size_t i = 0; i < bench.model.fill.nodes.size(); ++i)
    move_node(bench.state, i, part_of(x, unknowns, bench.model.bodies.size() + i).head<3>());
}

TEST(FillStiffness, IsTheDerivativeOfTheForces) {
  Bench bench(bonded_trough());
  const Unknowns unknowns = number_unknowns(bench.model);
  const SparseMatrix lower = assemble_stiffness(bench.model, bench.state, unknowns, PatchTangent::intact);
  const Eigen::MatrixXd k = Eigen::MatrixXd(lower).selfadjointView<Eigen::Lower>();
  std::mt19937 random(4);
  std::normal_distribution<double> normal;
  for (int i = 0; i < 5; ++i) {
    Eigen::VectorXd x(unknowns.count);
    for (double& value : x) value = 1e-8 * normal(random);
    Eigen::VectorXd forces[2];
    for (const int up : {0, 1}) {
      displace_all(bench, unknowns, up ? x : Eigen::VectorXd(-x));
      forces[up] = out_of_balance(bench.stepper, unknowns).force;
    }
    const Eigen::VectorXd slope = 0.5 * (forces[0] - forces[1]);
    EXPECT_LT((slope - k * x).norm(), 1e-6 * (k * x).norm());
  }
  EXPECT_GT(eigenvalues(k)[0], 0.0);
}

/// A column of fill that stands on a stone: (2n − 1) c / 4 L with its mass lumped, sideways held, and the interface's
/// stiffness in series.
TEST(FillStiffness, ModesOfAColumn) {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, -1}, {0.5, 0.5, 0}, true);
  FillMesh mesh = box_mesh({0, 0, 0}, {0.5, 0.5, 8}, 1, 1, 40);
  Bench bench(filled(std::move(assembly), std::move(mesh), elastic_fill(1500.0, 800e6 / 3.0, 160e6), 1e14, 1e14,
                     elastic_law()));
  for (std::uint8_t& held : bench.model.fill.held) held = 3;
  std::vector<Mode> modes = modes_of(bench, 3);
  const double speed = std::sqrt(480e6 / 1500.0);
  for (int n = 0; n < 3; ++n) {
    EXPECT_NEAR(modes[std::size_t(n)].frequency, (2 * n + 1) * speed / 32.0, 5e-3 * (2 * n + 1) * speed / 32.0);
    EXPECT_EQ(modes[std::size_t(n)].words.direction, "vertical");
  }
  EXPECT_NEAR(modes[0].effective.z(), 8.0 / (pi * pi) * 1500.0 * 2.0, 0.01 * 3000.0);
}

TEST(FillStiffness, NewtonFindsTheWeight) {
  Bench bench(bonded_trough(), undamped({0, 0, -9.81}));
  const Equilibrium e = bench.balance(1e-9);
  EXPECT_TRUE(e.converged) << e.account;
  EXPECT_LE(e.iterations, 4);
  // All the weight of the free stones and the fill goes into the fixed ones.
  const BodyPass pass = bench.stepper.body_pass();
  double held = 0.0;
  for (std::int64_t block : {0, 1}) {
    const Triple<double> f = pass.update(std::size_t(bench.body(block))).force;
    held += f.z;
  }
  EXPECT_NEAR(held, -9.81 * (2000.0 * 2.0 + 1500.0 * 4.0), 1e-6 * 1e5);
}

TEST(FillStiffness, RelaxationEndsWhereNewtonDoes) {
  Bench newton(bonded_trough(), undamped({0, 0, -9.81})), relaxed(bonded_trough(), undamped({0, 0, -9.81}));
  ASSERT_TRUE(newton.balance(1e-9).converged);
  const Equilibrium e = relax(relaxed.stepper, 1e-7, {}, nullptr, nullptr);
  EXPECT_TRUE(e.converged) << e.account;
  for (std::size_t i = 0; i < newton.model.fill.nodes.size(); ++i)
    for (std::size_t c = 0; c < 3; ++c)
      EXPECT_NEAR(newton.state.fill.pose[node_width * i + c], relaxed.state.fill.pose[node_width * i + c], 1e-9);
}

/// Soil that flows under one stone and beside the other, without dilation, so that its tangent is not symmetric.
TEST(FillStiffness, NewtonIsConsistentWithFlow) {
  Assembly assembly = bonded_trough();
  Material& soil = assembly.materials.back();
  soil.cohesion = 2e3, soil.tensile_strength = 1e3;
  soil.friction_angle = 0.5, soil.dilation_angle = 0.0;
  Bench bench(std::move(assembly), undamped({0, 0, -9.81}));
  std::vector<double> residuals;
  const Equilibrium e =
      newton_equilibrium(bench.stepper, 1e-10, nullptr, [&](int, double residual) { residuals.push_back(residual); });
  ASSERT_TRUE(e.converged) << e.account;
  EXPECT_LE(e.iterations, 12);
  const auto flowing = std::count_if(bench.state.fill.yield.begin(), bench.state.fill.yield.end(),
                                     [](std::uint8_t y) { return (y & yields_in_shear) != 0; });
  EXPECT_GT(flowing, 10);
  // At the end each iteration leaves less than a hundredth of what the one before left: linear systems are solved to a
  // thousandth.
  for (std::size_t i = residuals.size() - 2; i < residuals.size(); ++i)
    EXPECT_LT(residuals[i], 1e-2 * residuals[i - 1]) << i;
  double held = 0.0;
  for (std::int64_t block : {0, 1}) held += bench.stepper.body_pass().update(std::size_t(bench.body(block))).force.z;
  EXPECT_NEAR(held, -9.81 * (2000.0 * 2.0 + 1500.0 * 4.0), 1e-6 * 1e5);
}

TEST(FillStiffness, TheCriticalStepIsThatOfTheMixedModel) {
  Bench bench(bonded_trough());
  const DenseSystem system = dense_system(bench);
  const double exact = 2.0 / std::sqrt(eigenvalues(system.k, system.m).maxCoeff());
  EXPECT_NEAR(critical_step(bench.model, bench.state).step, exact, 3e-3 * exact);
}

/// Points that are open by dilation alone are pressed: their tangent is that of the intact joint.
TEST(FillStiffness, OfAPatchThatHasDilatedIsThatOfAClosedOne) {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, -1}, {1, 1, 0}, true);
  Bench bench(filled(std::move(assembly), box_mesh({0, 0, 0}, {1, 1, 1}, 1, 1, 1), elastic_fill(1500.0, 266e6, 160e6),
                     2e9, 0.8e9, dry_law(0.6)));
  for (std::size_t i = 0; i < bench.model.fill.nodes.size(); ++i) move_node(bench.state, i, {0, 0, 1e-3});
  const Unknowns unknowns = number_unknowns(bench.model);
  const auto stiffness = [&](PatchTangent kind) {
    return Eigen::MatrixXd(assemble_stiffness(bench.model, bench.state, unknowns, kind));
  };
  const Eigen::MatrixXd closed = stiffness(PatchTangent::intact);
  EXPECT_GT((stiffness(PatchTangent::present) - closed).norm(), 0.1 * closed.norm()) << "open";
  const Interface& interface = bench.state.interface;
  for (std::size_t slot = 0; slot < interface.patches.size(); ++slot)
    for (std::size_t i = 0; i < interface.patches[slot].points.size(); ++i)
      bench.state.interface_memory.point_rest[interface.point_index(slot, i, 2, 0)] = 1.1e-3;
  EXPECT_LT((stiffness(PatchTangent::present) - closed).norm(), 1e-9 * closed.norm());
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
