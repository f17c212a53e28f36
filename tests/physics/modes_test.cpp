// Eigenvalue analysis (closed forms of chains and columns: tools/ladder).
#include "solver/base/error.h"
#include "solver/linear/dense_eigen.h"
#include "solver/linear/loose.h"
#include "solver/modal/damped_mode.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

Assembly elastic_wall(int length, int courses) {
  Assembly assembly = generated("wall", {{"length_blocks", length}, {"courses", courses}, {"kn", 4e9}, {"ks", 1.6e9}});
  set_law(assembly, elastic_law());
  return assembly;
}

TEST(Modes, OfTheSparseWayAreThoseOfTheDenseOne) {
  const Bench bench(elastic_wall(10, 10));
  const DenseSystem system = dense_system(bench);
  ASSERT_GT(system.k.rows(), 600) << "small problems are solved densely anyway";
  const Eigen::VectorXd dense = eigenvalues(system.k, system.m);
  const Modes modes = find_modes(bench.assembly, bench.model, bench.state, 20, PatchTangent::intact);
  EXPECT_GT(modes.report.solution.factor_entries, 0.0);
  for (int i = 0; i < 20; ++i) {
    EXPECT_NEAR(modes.modes[i].eigenvalue, dense[i], 1e-8 * dense[i]) << i;
    EXPECT_LT(modes.modes[i].residual, 1e-8) << i;
  }
}

/// One vector's Krylov space holds one vector of a double eigenvalue: both bending modes of a square column must come.
TEST(Modes, OfASquareColumnComeInPairs) {
  const Bench bench(bending_column_of(100));
  const std::vector<Mode> modes = modes_of(bench, 8);
  for (int i : {0, 2}) EXPECT_NEAR(modes[i + 1].frequency, modes[i].frequency, 1e-8 * modes[i].frequency) << i;
  const DenseSystem system = dense_system(bench);
  const Eigen::VectorXd dense = eigenvalues(system.k, system.m);
  for (int i = 0; i < 8; ++i) EXPECT_NEAR(modes[i].eigenvalue, dense[i], 1e-7 * dense[i]) << i;
}

TEST(Modes, AreOrthogonalAndTheirMassesAddUp) {
  const Bench bench(axial_chain_of(10));
  const Modes all = find_modes(bench.assembly, bench.model, bench.state, 60, PatchTangent::intact);
  Vec3 sum = Vec3::Zero();
  for (const Mode& mode : all.modes) sum += mode.effective;
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], all.mass, 1e-9 * all.mass) << "xyz"[c];
  EXPECT_NEAR(all.mass, 10 * 800.0, 1e-9);
  const Eigen::MatrixXd mac =
      assurance(all.modes, all.modes,
                pair_blocks(block_places(bench.assembly, bench.model), block_places(bench.assembly, bench.model)));
  for (Eigen::Index i = 0; i < 60; ++i) EXPECT_NEAR(mac(i, i), 1.0, 1e-12);
  for (std::size_t i = 0; i < 60; ++i)
    for (std::size_t j = 0; j < i; ++j) {
      double product = 0.0;  // φᵀ M ψ
      for (std::size_t block = 0; block < bench.assembly.blocks.size(); ++block) {
        const Vector6 one = all.modes[i].shape.row(Eigen::Index(block)),
                      other = all.modes[j].shape.row(Eigen::Index(block));
        product += one.dot(body_mass(bench.model, bench.state, std::size_t(bench.body(std::int64_t(block)))) * other);
      }
      EXPECT_LT(std::abs(product), 1e-8 * std::sqrt(all.modes[i].modal_mass * all.modes[j].modal_mass))
          << i << " " << j;
    }
}

/// Six motions without frequency, whichever way they are found.
TEST(Modes, OfAnUnsupportedAssemblyBeginWithSixRigidMotions) {
  for (int courses : {3, 12}) {
    Assembly assembly = elastic_wall(8, courses);
    for (Block& block : assembly.blocks) block.fixed = false;
    const Bench bench(joined(std::move(assembly), 4e9, 1.6e9, elastic_law()));
    const Modes modes = find_modes(bench.assembly, bench.model, bench.state, 8, PatchTangent::intact);
    for (int i = 0; i < 6; ++i) {
      EXPECT_EQ(modes.modes[i].frequency, 0.0) << i;
      EXPECT_EQ(modes.modes[i].words.text(), "rigid motion");
    }
    EXPECT_GT(modes.modes[6].frequency, 1.0);
    EXPECT_TRUE(modes.adrift.empty());
  }
}

/// A wall on a base, a stone beside it that touches nothing, and another that touches on one edge alone.
TEST(Modes, NameWhatIsLoose) {
  Assembly assembly = elastic_wall(4, 4);
  const Bench whole(assembly);
  const std::vector<Mode> expected = modes_of(whole, 5);
  const auto loose = std::int64_t(assembly.blocks.size());
  add_box(assembly, {50, 0, 0}, {51, 1, 1});
  finish_blocks(assembly);
  const Bench bench(assembly);
  const Modes modes = find_modes(bench.assembly, bench.model, bench.state, 5, PatchTangent::intact);
  EXPECT_EQ(modes.adrift, std::vector<std::int64_t>{loose});
  EXPECT_TRUE(modes.partly.empty());
  for (int i = 0; i < 5; ++i)
    EXPECT_NEAR(modes.modes[i].eigenvalue, expected[i].eigenvalue, 1e-9 * expected[i].eigenvalue) << i;
}

/// A block that stands on an edge may turn about it. With that held, the other modes stay what they are.
TEST(Modes, HoldWhatCanTurnOnItsOwn) {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, -1}, {3, 1, 0}, true);
  add_box(assembly, {0, 0, 0}, {1, 1, 1});
  add_box(assembly, {2, 0, 0}, {3, 1, 1});
  SolverSettings settings = undamped();
  settings.step.intact_shortcut = false;
  Bench bench(joined(std::move(assembly), 1e9, 4e8, dry_law(0.6)), settings);
  const double angle = 1e-6;  // about its lower edge x = 2, pressed down so that it alone is closed
  bench.turn_about(2, {2, 0.5, 0}, Eigen::Quaterniond(Eigen::AngleAxisd(-angle, Vec3::UnitY())));
  bench.pose(2)[2] -= 1e-8;
  bench.place(1, {0, 0, -1e-6}, Eigen::Quaterniond::Identity());
  bench.stepper.patches_only();
  const Modes modes = find_modes(bench.assembly, bench.model, bench.state, 11, PatchTangent::present);
  EXPECT_EQ(modes.partly, std::vector<std::int64_t>{2});
  const DenseSystem system = dense_system(bench, PatchTangent::present);
  const Eigen::VectorXd dense = eigenvalues(system.k, system.m);
  const double highest = dense.maxCoeff();
  EXPECT_LT(std::abs(dense[0]), 1e-9 * highest);
  for (int i = 0; i < 11; ++i) EXPECT_NEAR(modes.modes[i].eigenvalue, dense[i + 1], 1e-9 * highest) << i;
}

/// Two stones tied to each other and to nothing else that stands: a mechanism of more than one block is a mode of no
/// frequency, and says what moves.
TEST(Modes, OfAMechanismHaveNoFrequency) {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, -1}, {2, 1, 0}, true);
  add_box(assembly, {0, 0, 0}, {1, 1, 1});
  add_box(assembly, {0, 0, 1}, {1, 1, 2});
  assembly = joined(std::move(assembly), 1e9, 4e8, elastic_law());
  assembly.joints[0].ks = 1e-3;  // slides and turns on its base
  const Bench bench(assembly);
  const std::vector<Mode> modes = modes_of(bench, 4);
  for (int i = 0; i < 3; ++i) {
    EXPECT_EQ(modes[i].frequency, 0.0) << i;
    EXPECT_EQ(modes[i].words.text(), "mechanism, block") << i;
  }
  EXPECT_GT(modes[3].frequency, 10.0);
}

TEST(Modes, AskedWronglySayWhatIsRight) {
  const auto message = [](const Assembly& assembly, int count) -> std::string {
    const Bench bench(assembly);
    try {
      find_modes(bench.assembly, bench.model, bench.state, count, PatchTangent::intact);
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_EQ(message(axial_chain_of(2), 13),
            "the number of modes is 13, but the model has 12 unknowns. Choose at most 12.");
  EXPECT_EQ(message(axial_chain_of(2), 0), "the number of modes is 0. It must be at least 1.");
  Assembly massless = axial_chain_of(2);
  massless.blocks[1].mass = 0.0;
  massless.blocks[1].inertia.setZero();
  EXPECT_NE(message(massless, 3).find("the mass matrix of block 1 (block, part 0) is singular"), std::string::npos)
      << message(massless, 3);
}

/// −dF/du of the explicit forces about a loaded placement is K with the geometric stiffness, by central differences.
TEST(Modes, GeometricStiffnessIsThatOfTheExplicitForces) {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, 0}, {2, 1, 0.5}, true);
  add_box(assembly, {0.1, 0, 0.5}, {0.9, 1, 1.2});
  add_box(assembly, {0.9, 0, 0.5}, {1.8, 1, 1.2});
  add_box(assembly, {0.3, 0.2, 1.2}, {1.5, 0.8, 1.6});
  SolverSettings settings = undamped({5.0, -3.0, -10.0});  // what is left out grows with the square of the strains
  Bench bench(joined(std::move(assembly), 2e8, 7e7, elastic_law()), settings);
  ASSERT_TRUE(bench.balance(1e-12).converged);
  bench.stepper.patches_only();
  const Eigen::MatrixXd material = dense_system(bench).k,
                        k = dense_system(bench, PatchTangent::intact, &bench.stepper.wrenches).k;
  const Unknowns unknowns = number_unknowns(bench.model);
  const Array<double> rest = bench.state.pose;
  std::mt19937 random(5);
  for (int repeat = 0; repeat < 5; ++repeat) {
    Eigen::VectorXd u = Eigen::VectorXd::Zero(unknowns.count);
    for (Eigen::Index i = 0; i < u.size(); ++i) u[i] = random_vector(1e-5, random).x();
    Eigen::VectorXd force[2];
    for (int way : {0, 1}) {
      bench.state.pose = rest;
      for (std::size_t i = 0; i < bench.model.bodies.size(); ++i) {
        const Vector6 part = (way ? 1.0 : -1.0) * part_of(u, unknowns, i);
        double* p = &bench.state.pose[pose_width * i];
        for (int c = 0; c < 3; ++c) p[c] += part[c];
        const Vec3 turn = part.tail<3>();
        const Eigen::Quaterniond q = Eigen::Quaterniond(Eigen::AngleAxisd(turn.norm(), turn.normalized())) *
                                     Eigen::Quaterniond(p[3], p[4], p[5], p[6]);
        if (turn.norm() > 0.0) p[3] = q.w(), p[4] = q.x(), p[5] = q.y(), p[6] = q.z();
      }
      force[way] = out_of_balance(bench.stepper, unknowns).force;
    }
    const Eigen::VectorXd difference = 0.5 * (force[0] - force[1]);
    EXPECT_LT((difference - k * u).norm(), 1e-8 * difference.norm());
    EXPECT_GT((difference - material * u).norm(), 1e-5 * difference.norm()) << "the material part alone is not enough";
  }
}

/// A stone of weight W on a joint that can hardly shear tips over when W times the height of its centroid passes the
/// joint's stiffness against turning, kn I.
TEST(Modes, GeometricStiffnessTipsOverWhatIsTooHeavy) {
  const double kn = 1e8, inertia = 1.0 / 12.0, height = 0.5;
  const double critical = kn * inertia / (2000.0 * height);  // m/s2
  for (double share : {0.5, 0.9, 1.5}) {
    Assembly assembly = stone(2000.0);
    add_box(assembly, {0, 0, -1}, {1, 1, 0}, true);
    add_box(assembly, {0, 0, 0}, {1, 1, 1});
    Bench bench(joined(std::move(assembly), kn, 1e4 * kn, elastic_law()), undamped({0, 0, -share * critical}));
    ASSERT_TRUE(bench.balance().converged);
    bench.stepper.patches_only();
    const Modes modes =
        find_modes(bench.assembly, bench.model, bench.state, 1, PatchTangent::intact, &bench.stepper.wrenches);
    // It turns about the middle of the closing joint.
    const double weight = 2000.0 * share * critical, arm = height - 0.5 * weight / kn;
    const double expected = (kn * inertia - weight * arm) / (2000.0 * (1.0 / 6.0 + arm * arm));
    EXPECT_NEAR(modes.modes[0].eigenvalue, expected, 1e-3 * kn * inertia / 2000.0) << share;
    EXPECT_EQ(modes.modes[0].words.direction == "unstable", expected < 0.0) << share;
  }
}

TEST(DampedMode, IsThePoleOfTheDampedOscillator) {
  DampingSettings damping;
  for (double frequency : {0.7, 3.125, 10.0}) {
    const DampedMode mode = damped_mode(damping, frequency);
    const MaxwellFit fit = fit_maxwell(damping.ratio, damping.band, damping.branches);
    const std::complex<double> s(-mode.ratio, std::sqrt(1.0 - mode.ratio * mode.ratio));
    const double size = 2 * pi * mode.frequency / s.imag(), omega = 2 * pi * frequency;
    std::complex<double> factor = 1.0;
    for (std::size_t j = 0; j < fit.stiffness.size(); ++j)
      factor += fit.stiffness[j] * size * s / (size * s + 2 * pi * fit.frequency[j]);
    EXPECT_LT(std::abs(size * size * s * s + omega * omega * factor), 1e-10 * omega * omega);
  }
  EXPECT_NEAR(damped_mode(damping, 3.125).frequency / 3.125, 1.0446, 1e-3);  // an independent fit's
  damping.kind = DampingSettings::Kind::rayleigh;
  EXPECT_NEAR(damped_mode(damping, 0.5).ratio, 0.02, 1e-12);
  EXPECT_NEAR(damped_mode(damping, 12.0).ratio, 0.02, 1e-12);
  EXPECT_NEAR(damped_mode(damping, 12.0).frequency, 12.0 * std::sqrt(1.0 - 0.0004), 1e-12);
  damping.kind = DampingSettings::Kind::none;
  EXPECT_EQ(damped_mode(damping, 3.0).frequency, 3.0);
  EXPECT_EQ(damped_mode(damping, 0.0).frequency, 0.0);
}

TEST(DampedMode, OfWeakLocalDampingIsItsCoefficientOverPi) {
  DampingSettings damping;
  damping.kind = DampingSettings::Kind::local;
  damping.coefficient = 0.1;
  const DampedMode mode = damped_mode(damping, 2.0);
  EXPECT_NEAR(mode.ratio, 0.1 / pi, 5e-3 * mode.ratio);
  EXPECT_NEAR(mode.frequency, 2.0, 0.01);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
