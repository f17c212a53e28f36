// Diagnosis: derivatives against finite differences, evidence and assignment against closed forms, names on small
// bridges.
#include <algorithm>
#include <numeric>

#include "solver/base/error.h"
#include "solver/diagnosis/assignment.h"
#include "solver/diagnosis/diagnose.h"
#include "solver/diagnosis/locate.h"
#include "solver/linear/dense_solve.h"
#include "tests/folder.h"
#include "tests/physics/measured_bridge.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

void expect_modes_of_the_model_for_runs(const Assembly& assembly) {
  EigenMemory memory;
  const Response r = response(assembly, linear_model(assembly), {}, 6, memory);
  const std::vector<Mode> modes = modes_of(Bench(assembly), 6);
  for (int i = 0; i < 6; ++i) {
    const double f = modes[std::size_t(i)].frequency;
    EXPECT_NEAR(std::exp(r.log_frequency[i]), f, 1e-9 * f) << i;
    EXPECT_EQ(r.words[std::size_t(i)].text(), modes[std::size_t(i)].words.text());
  }
}

TEST(LinearModel, HasTheModesOfTheModelForRuns) {
  expect_modes_of_the_model_for_runs(bridge());
}

TEST(LinearModel, HasTiesAlongTheirAxesAlone) {
  expect_modes_of_the_model_for_runs(with(bridge(), "retrofit_ties", "all", {{"axial_stiffness", 2e9}}));
}

class LinearModelWithFill : public testing::TestWithParam<std::string> {};

TEST_P(LinearModelWithFill, HasTheModesOfTheModelForRuns) {
  const Assembly assembly = small_bridge(GetParam(), 4.0, 2.0);
  ASSERT_FALSE(assembly.fill.empty());
  expect_modes_of_the_model_for_runs(assembly);
}
INSTANTIATE_TEST_SUITE_P(All, LinearModelWithFill, testing::Values("cs1", "cs2"),
                         [](const auto& i) { return i.param; });

TEST(LinearModel, RefusesNodesOfTheFillWithoutElements) {
  Assembly assembly = small_bridge("cs2", 4.0, 2.0);
  assembly.fill.nodes.push_back(Vec3::Zero());
  EXPECT_NE(message_of<InputError>([&] { linear_model(assembly); }).find("belongs to no tetrahedron"),
            std::string::npos);
}

class EachCandidate : public testing::TestWithParam<std::string> {};

/// K′ and M′ of every parameter of every effect, and what follows of them, against models solved a step to either side.
TEST_P(EachCandidate, DerivativesAreThoseOfFiniteDifferences) {
  const Assembly base = GetParam() == "ring_separation" ? bridge_of_two_rings() : bridge();
  DiagnosisProblem problem = measured(base, base, 4, true);
  problem.modes = 40;  // derivatives of vectors lack a share λ/λ_n of what further modes would add
  std::vector<Candidate> all = candidates(base, problem.features.sensors, {true, true, true, {}});
  std::erase_if(all, [](const Candidate& c) { return c.name != GetParam(); });
  ASSERT_FALSE(all.empty());
  const Candidate& candidate = all.back();
  Hypothesis hypothesis;
  hypothesis.materials = calibrations(base);
  hypothesis.effects = {candidate};
  const auto materials = Eigen::Index(hypothesis.materials.size());
  Eigen::VectorXd x = Eigen::VectorXd::Constant(Eigen::Index(hypothesis.size()), 0.3);
  for (std::size_t i = 0; i < candidate.starts[0].size(); ++i)
    x[materials + Eigen::Index(i)] = candidate.starts[0][i] - 0.1;

  // K and M themselves, along vectors of no meaning, with steps five times as long as those of the program.
  const auto assembly = [&](Eigen::Index index, double step) {
    Eigen::VectorXd moved = x;
    moved[index] += step;
    return hypothesis.assembly(problem.base, moved);
  };
  for (Eigen::Index p = materials; p < x.size() && candidate.kind == Candidate::Kind::effect; ++p) {
    const Contributions d = derivative(assembly(p, -1e-3), assembly(p, 1e-3), 2e-3);
    EXPECT_FALSE(d.pairs.empty() && d.blocks.empty()) << p;
    const LinearModel low = linear_model(assembly(p, -5e-3)), high = linear_model(assembly(p, 5e-3));
    Eigen::VectorXd v(low.unknowns.count);
    for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = std::sin(1.0 + 0.7 * double(i));
    const Eigen::VectorXd k = times_stiffness(d, low.unknowns, v), m = times_mass(d, low.unknowns, v);
    const Eigen::VectorXd dk =
        (high.k.selfadjointView<Eigen::Lower>() * v - low.k.selfadjointView<Eigen::Lower>() * v) / 1e-2;
    const Eigen::VectorXd dm =
        (high.m.selfadjointView<Eigen::Lower>() * v - low.m.selfadjointView<Eigen::Lower>() * v) / 1e-2;
    // Rounding of K, whose largest entries do not change, over the step.
    const double rounding = 1e-13 * (low.k.selfadjointView<Eigen::Lower>() * v).norm() / 1e-2;
    EXPECT_LT((k - dk).norm(), 1e-4 * dk.norm() + rounding) << p;
    EXPECT_LT((m - dm).norm(), 1e-4 * dm.norm() + 1e-13 * (low.m.selfadjointView<Eigen::Lower>() * v).norm() / 1e-2)
        << p;
  }

  // And the residuals, through eigenvalues and vectors.
  const std::vector<ResidualRow> rows = residual_rows(problem);
  const Origin origin(hypothesis.assembly(base, x), problem.features.sensors, problem.modes, true);
  const Question question = question_of(problem, origin.response());
  ModelFamily family(origin, problem.base, hypothesis, question, x, ModelFamily::Use::often);
  family.append(material_vectors(origin, problem.base, hypothesis, x, question.wanted));
  family.converge(x + Eigen::VectorXd::Constant(x.size(), 1e-2), 1e-6);
  const ModelFamily::Member member = family.member(x);
  const Evaluation at = evaluate(problem, rows, hypothesis, family, member);
  const Eigen::MatrixXd j = jacobian(problem, rows, hypothesis, family, member, at);
  const double step = 1e-3;
  for (Eigen::Index p = 0; p < x.size(); ++p) {
    const auto moved = [&](double by) {
      Eigen::VectorXd y = x;
      y[p] += by;
      EigenMemory own;
      const Evaluation e = evaluate(problem, rows, hypothesis, y, own);
      // The pairs of the middle: where two modes cross, the derivative is that of each.
      return residuals(problem, rows, at.pairing, hypothesis.observe(e.response, 0.02, y));
    };
    const Eigen::VectorXd expected = (moved(step) - moved(-step)) / (2.0 * step);
    for (std::size_t i = 0; i < rows.size(); ++i) {
      using Kind = ResidualRow::Kind;
      const double tolerance = rows[i].kind == Kind::frequency || rows[i].kind == Kind::damping ? 1e-4 : 0.02;
      const double size = std::max(expected.cwiseAbs().maxCoeff(), 1e-6);
      ASSERT_NEAR(j(Eigen::Index(i), p), expected[Eigen::Index(i)], tolerance * size)
          << "parameter " << p << " row " << i;
    }
  }
}

std::vector<std::string> names() {
  std::vector<std::string> all;
  for (const Effect& effect : effects())
    if (effect.weight > 0.0) all.push_back(effect.name);
  return all;
}
INSTANTIATE_TEST_SUITE_P(All, EachCandidate, testing::ValuesIn(names()), [](const auto& i) { return i.param; });

/// For residuals linear in x, the integral over x is a normal density of covariance 1 + J Jᵀ.
TEST(Evidence, OfALinearModelIsThatOfItsNormalDistribution) {
  Eigen::MatrixXd j(5, 2);
  j << 1.0, 0.2, -0.4, 2.0, 0.0, 0.7, 3.0, -1.0, 0.5, 0.5;
  Eigen::VectorXd r0(5);
  r0 << 1.0, -2.0, 0.5, 0.3, 4.0;
  const Eigen::MatrixXd hessian = Eigen::MatrixXd::Identity(2, 2) + j.transpose() * j;
  const Eigen::VectorXd x = -inverse_of(hessian) * j.transpose() * r0;
  const Eigen::MatrixXd covariance = Eigen::MatrixXd::Identity(5, 5) + j * j.transpose();
  const double expected = -0.5 * r0.dot(inverse_of(covariance) * r0) - 0.5 * std::log(covariance.determinant());
  EXPECT_NEAR(log_evidence(r0 + j * x, j, x), expected, 1e-10);
  // A prior ten times as wide costs ln 10 a parameter that the data fix.
  EXPECT_NEAR(
      log_evidence(Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Constant(1, 1, 1e6), Eigen::VectorXd::Zero(1)) -
          log_evidence(Eigen::VectorXd::Zero(1), Eigen::MatrixXd::Constant(1, 1, 1e7), Eigen::VectorXd::Zero(1)),
      std::log(10.0), 1e-9);
}

TEST(Evidence, TailOfChiSquareIsThatOfTables) {
  EXPECT_NEAR(chi_square_tail(3.841, 1), 0.05, 0.01);
  EXPECT_NEAR(chi_square_tail(18.307, 10), 0.05, 5e-4);
  EXPECT_NEAR(chi_square_tail(135.807, 100), 0.01, 2e-4);
}

TEST(Assignment, IsTheBestOfAllPermutations) {
  std::uint64_t bits = 3;
  for (int trial = 0; trial < 20; ++trial) {
    Eigen::MatrixXd cost(4, 6);
    for (double& c : cost.reshaped()) {
      bits = 6364136223846793005u * bits + 1442695040888963407u;
      c = double(bits >> 40);
    }
    std::vector<int> columns(6);
    std::iota(columns.begin(), columns.end(), 0);
    double least = 1e300;
    do {
      double sum = 0.0;
      for (int row = 0; row < 4; ++row) sum += cost(row, columns[std::size_t(row)]);
      least = std::min(least, sum);
    } while (std::next_permutation(columns.begin(), columns.end()));
    double found = 0.0, transposed = 0.0;
    const std::vector<int> partner = least_cost_assignment(cost), back = least_cost_assignment(cost.transpose());
    for (int row = 0; row < 4; ++row) found += cost(row, partner[std::size_t(row)]);
    for (int column = 0; column < 6; ++column)
      if (back[std::size_t(column)] >= 0) transposed += cost(back[std::size_t(column)], column);
    EXPECT_EQ(found, least);
    EXPECT_EQ(transposed, least);
  }
}

TEST(Diagnosis, OfARightModelIsConsistent) {
  const Assembly base = bridge();
  const Diagnosis d = diagnose(measured(base, base, 5), quick(2), [](const std::string&) {});
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::consistent);
  EXPECT_LT(d.plain.gap, 1e-3);
  EXPECT_TRUE(d.best.hypothesis.effects.empty());
}

TEST(Diagnosis, NamesTheRestraintOfTheAbutmentsTheSameForAnyThreads) {
  const Assembly base = bridge();
  const DiagnosisProblem problem =
      measured(base, with(bridge(), "abutment_restraint", "both", {{"stiffness_share", 0.5}}), 5);
  const Diagnosis one = diagnose(problem, quick(1), [](const std::string&) {});
  ASSERT_EQ(one.verdict, Diagnosis::Verdict::found);
  ASSERT_EQ(one.best.hypothesis.effects.size(), 1u);
  EXPECT_EQ(one.best.hypothesis.effects[0].text(), "abutment_restraint at both");
  const double share = one.best.hypothesis.effects[0].parameters[0].value(one.best.best.x.tail(1)[0]);
  EXPECT_NEAR(share, 0.5, 0.1);
  EXPECT_LT(one.best.gap, 0.3);
  EXPECT_GT(one.plain.gap, 3.0);
  const Diagnosis two = diagnose(problem, quick(2), [](const std::string&) {});
  EXPECT_EQ(two.best.log_evidence, one.best.log_evidence);
  EXPECT_EQ(two.rounds[0].trials[1].probability, one.rounds[0].trials[1].probability);
  EXPECT_EQ(two.best.best.x, one.best.best.x);
}

TEST(Diagnosis, WithoutTheEffectInItsLibraryNamesNothing) {
  const Assembly base = bridge();
  const DiagnosisProblem problem =
      measured(base, with(bridge(), "abutment_restraint", "left", {{"stiffness_share", 0.6}}), 5);
  DiagnosisSettings settings = quick(2);
  for (const Effect& effect : effects())
    if (effect.name != "fill_stiffness") settings.without.push_back(effect.name);
  const Diagnosis d = diagnose(problem, settings, [](const std::string&) {});
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::unexplained);
  EXPECT_TRUE(d.best.hypothesis.effects.empty());
  ASSERT_FALSE(d.nameless_best.hypothesis.effects.empty());
  EXPECT_NE(d.nameless_best.hypothesis.effects[0].where.find("abutment left"), std::string::npos)
      << d.nameless_best.hypothesis.effects[0].text();
  const Location where = locate(problem, d.plain.best);
  double sum = 0.0;
  for (const PartResidual& part : where.parts) sum += part.share;
  EXPECT_NEAR(sum, 1.0, 1e-9);
}

TEST(Diagnosis, ReversedChannelsAreFaultsOfTheMeasurement) {
  const Assembly base = bridge();
  DiagnosisProblem problem = measured(base, base, 5);
  for (MeasuredFeature& mode : problem.features.modes) mode.shape[4] *= -1.0;
  const Diagnosis d = diagnose(problem, quick(2), [](const std::string&) {});
  ASSERT_EQ(d.verdict, Diagnosis::Verdict::found);
  EXPECT_EQ(d.best.hypothesis.effects[0].text(), "sensor_fault at channel keystone 1y");
}

/// Sensitivities of all parts together: f ~ √(k/m).
TEST(Localisation, SensitivitiesOfAllPartsAddUp) {
  const Assembly base = bridge();
  const DiagnosisProblem problem = measured(base, base, 3);
  EigenMemory memory;
  const Evaluation e = evaluate(problem, residual_rows(problem), {}, Eigen::VectorXd(0), memory);
  double stiffness = 0.0, mass = 0.0;
  for (const PartSensitivity& s : sensitivities(e, 0)) stiffness += s.stiffness, mass += s.mass;
  EXPECT_NEAR(stiffness, 0.5, 1e-6);
  EXPECT_NEAR(mass, -0.5, 1e-9);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
