// Diagnosis from recordings with the ground's motion: participation of modes against closed forms, supports that move
// otherwise, clocks that are late.
#include <complex>

#include "tests/physics/measured_bridge.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

const std::vector<std::string> axes = {"x", "y", "z"};

/// All supports together are the ground: Σ Γ_k = φᵀ M r, and the bridge follows as one rigid body.
TEST(Participation, OfAllSupportsIsThatOfTheGround) {
  const Assembly assembly = bridge();
  const std::vector<Sensor> sensors = sensors_on(assembly);
  EigenMemory memory;
  const LinearModel model = linear_model(assembly);
  const Response r = response(assembly, model, sensors, 12, memory, true);
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(3, 12), follow = Eigen::MatrixXd::Zero(Eigen::Index(sensors.size()), 3);
  for (std::size_t k = 0; k < r.at_support.size(); ++k) {
    sum += r.at_support[k];
    follow += follow_support(assembly, r, model, k, sensors, memory);
  }
  ASSERT_EQ(r.at_support.size(), 5u);
  EXPECT_LT((sum - r.participation).cwiseAbs().maxCoeff(), 1e-6 * r.participation.cwiseAbs().maxCoeff());
  for (std::size_t s = 0; s < sensors.size(); ++s)
    for (int axis = 0; axis < 3; ++axis)
      EXPECT_NEAR(follow(Eigen::Index(s), axis), sensors[s].direction[axis], 1e-6) << sensors[s].id << axes[axis];
}

/// The effective masses of all modes are the mass of what is free.
TEST(Participation, SquaredAndSummedIsTheMass) {
  const Assembly assembly = bridge(6.0);
  EigenMemory memory;
  const LinearModel model = linear_model(assembly);
  const Response r = response(assembly, model, {}, int(model.unknowns.count), memory, true);
  double mass = 0.0;
  for (const Block& block : assembly.blocks) mass += block.fixed ? 0.0 : block.mass;
  for (int axis = 0; axis < 3; ++axis) EXPECT_NEAR(r.participation.row(axis).squaredNorm(), mass, 1e-6 * mass);
}

/// The measured participation of a bridge one of whose supports moves otherwise.
void move_support(DiagnosisProblem& problem, std::size_t support, double factor, double delay) {
  EigenMemory memory;
  const Response r = response(problem.base, linear_model(problem.base), problem.features.sensors,
                              int(problem.features.modes.size()), memory, true);
  for (std::size_t m = 0; m < problem.features.modes.size(); ++m) {
    MeasuredFeature& mode = problem.features.modes[m];
    const std::complex<double> turn = std::polar(factor, double(-2.0 * EIGEN_PI) * mode.frequency * delay);
    mode.participation += (turn - 1.0) * r.at_support[support].col(Eigen::Index(m));
  }
}

TEST(DrivenDiagnosis, NamesTheSupportThatMovesOtherwise) {
  const Assembly base = bridge();
  DiagnosisProblem problem = measured(base, base, 8, true);
  move_support(problem, 0, 0.4, 0.03);  // an abutment: it carries more of the deck than a pier
  const Diagnosis d = diagnose(problem, quick(2), [](const std::string&) {});
  ASSERT_EQ(d.verdict, Diagnosis::Verdict::found);
  ASSERT_EQ(d.best.hypothesis.effects.size(), 1u);
  const Candidate& found = d.best.hypothesis.effects[0];
  EXPECT_EQ(found.text(), "support_motion at " + supports(base)[0]);
  EXPECT_NEAR(found.parameters[0].value(d.best.best.x.tail(2)[0]), 0.4, 0.1);
  EXPECT_NEAR(found.parameters[1].value(d.best.best.x.tail(2)[1]), 0.03, 0.01);
}

TEST(DrivenDiagnosis, OfARightModelIsConsistent) {
  const Assembly base = bridge();
  const Diagnosis d = diagnose(measured(base, base, 6, true), quick(2), [](const std::string&) {});
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::consistent);
  EXPECT_LT(d.plain.gap, 1e-3);
}

TEST(DrivenDiagnosis, FindsTheClockThatIsLate) {
  const Assembly base = bridge();
  DiagnosisProblem problem = measured(base, base, 5, true);
  constexpr Eigen::Index channel = 4;
  constexpr double delay = 0.012;
  for (MeasuredFeature& mode : problem.features.modes) {
    const double turn = 2.0 * EIGEN_PI * mode.frequency * delay, true_value = mode.shape[channel];
    mode.shape[channel] = true_value * std::cos(turn);
    mode.quadrature[channel] = -true_value * std::sin(turn);
  }
  const Diagnosis d = diagnose(problem, quick(2), [](const std::string&) {});
  ASSERT_EQ(d.verdict, Diagnosis::Verdict::found);
  const Candidate& found = d.best.hypothesis.effects[0];
  EXPECT_EQ(found.kind, Candidate::Kind::clock);
  EXPECT_EQ(found.where, "channel keystone 1y");
  EXPECT_NEAR(found.parameters[0].value(d.best.best.x.tail(1)[0]), delay, 0.002);
}

/// The ground behind the ends changes what drives the modes as well as the modes.
TEST(DrivenDiagnosis, NamesTheRestraintOfTheAbutments) {
  const Assembly base = bridge();
  const DiagnosisProblem problem =
      measured(base, with(bridge(), "abutment_restraint", "both", {{"stiffness_share", 0.5}}), 5, true);
  const Diagnosis d = diagnose(problem, quick(2), [](const std::string&) {});
  ASSERT_EQ(d.verdict, Diagnosis::Verdict::found);
  EXPECT_EQ(d.best.hypothesis.effects[0].text(), "abutment_restraint at both");
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
