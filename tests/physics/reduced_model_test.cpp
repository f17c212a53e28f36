// Modes in a basis of few vectors against those of the whole model, of every effect at every place.
#include "solver/diagnosis/reduced_model.h"

#include <set>

#include "solver/base/error.h"
#include "tests/physics/measured_bridge.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

constexpr int wanted = 8;

/// Squares of the cosines between a mode of the whole model and those of the basis whose frequencies are near, in the
/// displacements: a sum, because modes that nearly coincide are a plane.
double assurance(const Response& whole, const LinearModel& model, int i, const ReducedModel& reduced,
                 const ReducedModes& modes) {
  const Eigen::VectorXd phi = whole.vectors.col(i);
  const Eigen::VectorXd momentum = model.m.selfadjointView<Eigen::Lower>() * phi;
  const Eigen::MatrixXd vectors = reduced.vectors(modes, wanted + 4);
  double sum = 0.0;
  for (Eigen::Index j = 0; j < vectors.cols(); ++j) {
    if (std::abs(std::log(modes.eigenvalues[j] / whole.eigenvalues[i])) > 0.02) continue;
    double along = 0.0;  // site by site: freed ones have other numbers
    for (std::size_t site = 0; site < model.unknowns.of.size(); ++site)
      along += part_of(momentum, model.unknowns, site).dot(part_of(vectors.col(j), reduced.unknowns(), site));
    sum += along * along;
  }
  return sum;
}

struct Small {
  std::string name;
  double block_scale = 1.0, edge = 0.0;  // m: of the fill's tetrahedra; 0: rigid blocks
  int spans = 0;
};
class InABasis : public testing::TestWithParam<std::tuple<std::string, Small>> {};

/// At 0.5, 1 and 2 deviations of the first parameter's prior to either side of its middle.
TEST_P(InABasis, EveryPlaceHasTheModesOfTheWholeModel) {
  const auto& [effect, small] = GetParam();
  const Assembly base = small_bridge(small.name, small.block_scale, small.edge, small.spans);
  const Origin origin(base, {}, 20);
  for (const Candidate& candidate : candidates(base, {}, {false, false, false, {}})) {
    if (candidate.name != effect || candidate.kind != Candidate::Kind::effect) continue;
    Hypothesis hypothesis;
    hypothesis.effects = {candidate};
    for (const double amount : {-2.0, -1.0, -0.5, 0.5, 1.0, 2.0}) {
      SCOPED_TRACE(fmt::format("{} {} {}", small.name, candidate.text(), amount));
      Eigen::VectorXd x = Eigen::VectorXd::Zero(Eigen::Index(hypothesis.size()));
      x[0] = amount;
      const Assembly changed = hypothesis.assembly(base, x);
      const LinearModel model = linear_model(changed);
      EigenMemory memory;
      const Response whole = response(changed, model, {}, wanted, memory);
      ReducedModel reduced(origin, changed, find_classes(base, changed));
      const Change change = find_change(base, reduced.classes(), changed);
      reduced.converge(change, wanted + 4, 1e-5, 12);
      const ReducedModes modes = reduced.modes(reduced.matrices(change));
      for (int i = 0; i < wanted; ++i) {
        EXPECT_NEAR(0.5 * std::log(modes.eigenvalues[i] / whole.eigenvalues[i]), 0.0, 1e-4) << i;
        EXPECT_GT(assurance(whole, model, i, reduced, modes), 0.9999) << i;
      }
    }
  }
}

std::vector<std::string> of_the_model() {
  std::vector<std::string> names;
  for (const Effect& effect : effects())
    if (effect.weight > 0.0 && effect.apply) names.push_back(effect.name);
  return names;
}
std::string words_of_case(const testing::TestParamInfo<InABasis::ParamType>& info) {
  const auto& [effect, small] = info.param;
  return effect + "_" + small.name + (small.edge > 0.0 ? "_filled" : "");
}
INSTANTIATE_TEST_SUITE_P(All, InABasis,
                         testing::Combine(testing::ValuesIn(of_the_model()),
                                          testing::Values(Small{"cs1", 5.0}, Small{"cs2", 3.0},
                                                          Small{"cs1", 5.0, 2.5, 2}, Small{"cs2", 3.0, 2.5, 2})),
                         words_of_case);

/// Every effect acts somewhere on one of them.
TEST(ReducedModel, EveryEffectIsTried) {
  std::set<std::string> acting;
  for (const Assembly& base : {small_bridge("cs1", 5.0), small_bridge("cs2", 3.0, 2.5), bridge_of_two_rings()})
    for (const Candidate& candidate : candidates(base, {}, {false, false, false, {}})) acting.insert(candidate.name);
  for (const std::string& name : of_the_model()) EXPECT_TRUE(acting.contains(name)) << name;
}

/// The same matrices whether what changes is taken class by class or joint by joint.
TEST(ReducedModel, ClassesAreTheSumOfTheirJoints) {
  const Assembly base = bridge(6.0);
  const Origin origin(base, {}, 10);
  Assembly changed = with(base, "calibration", "masonry", {{"stiffness", 0.7}, {"density", 1.1}});
  changed = with(changed, "joint_softening", "pier 0", {{"factor", 0.4}});
  changed = with(changed, "abutment_restraint", "left", {{"stiffness_share", 0.5}});
  ReducedModel one(origin, changed, {}), classes(origin, changed, find_classes(base, changed));
  EXPECT_GT(classes.classes().stiffness.size(), 2u);
  const auto a = one.matrices(find_change(base, one.classes(), changed)),
             b = classes.matrices(find_change(base, classes.classes(), changed));
  EXPECT_LT((a.k - b.k).norm(), 1e-12 * a.k.norm());
  EXPECT_LT((a.m - b.m).norm(), 1e-12 * a.m.norm());
}

/// K v and M v of an assembly's matrices.
Eigen::VectorXd stiffness_times(const Assembly& assembly, const Eigen::VectorXd& v) {
  return linear_model(assembly).k.selfadjointView<Eigen::Lower>() * v;
}
Eigen::VectorXd mass_times(const Assembly& assembly, const Eigen::VectorXd& v) {
  return linear_model(assembly).m.selfadjointView<Eigen::Lower>() * v;
}

/// Elements, patches and nodes of a fill, some of which change alike and some of which do not.
TEST(ReducedModel, ChangesOfAFillAreThoseOfItsMatrices) {
  const Assembly base = small_bridge("cs2", 4.0, 2.0);
  const Unknowns unknowns = linear_model(base).unknowns;
  Eigen::VectorXd v(unknowns.count);
  for (Eigen::Index i = 0; i < v.size(); ++i) v[i] = std::sin(1.0 + 0.7 * double(i));
  Assembly alike = with(base, "calibration", "backfill", {{"stiffness", 0.7}, {"density", 1.1}});
  alike = with(alike, "fill_interface", "spandrels", {{"factor", 0.2}});
  Assembly apart = with(alike, "added_mass", "deck", {{"mass_per_length", 9000.0}});
  Material stiff = apart.materials[std::size_t(apart.fill.material[0])];  // one half alone, and with another ratio
  stiff.youngs_modulus *= 1.7, stiff.shear_modulus *= 1.6;
  apart.materials.push_back(stiff);
  for (std::size_t i = 0; i < apart.fill.material.size() / 2; ++i)
    apart.fill.material[i] = std::int32_t(apart.materials.size()) - 1;
  apart.fill_joints[3].kn *= 2.0;
  const Classes classes = find_classes(base, alike);
  EXPECT_EQ(classes.stiffness.size(), 3u);  // joints, what is calibrated, patches of the walls
  const Contributions parts = contributions(base);
  for (const Assembly& changed : {alike, apart}) {
    const Change change = find_change(base, classes, changed);
    Vectors k = times_stiffness(change.others, unknowns, Vectors(v)),
            m = times_mass(change.others, unknowns, Vectors(v));
    for (std::size_t c = 0; c < classes.stiffness.size(); ++c)
      add_stiffness(parts, classes.stiffness[c], change.stiffness[c] - 1.0, unknowns, v, k);
    for (std::size_t c = 0; c < classes.mass.size(); ++c)
      add_mass(parts, classes.mass[c], change.mass[c] - 1.0, unknowns, v, m);
    const Eigen::VectorXd dk = stiffness_times(changed, v) - stiffness_times(base, v),
                          dm = mass_times(changed, v) - mass_times(base, v);
    EXPECT_LT((k.col(0) - dk).norm(), 1e-10 * dk.norm());
    EXPECT_LT((m.col(0) - dm).norm(), 1e-10 * dm.norm());
  }
  const Change change = find_change(base, classes, apart);
  EXPECT_FALSE(change.others.elements.empty() || change.others.rings.empty() || change.others.lumps.empty());
  EXPECT_EQ(change.others.patches.size(), 1u);
}

TEST(ReducedModel, RefusesAnotherMeshOfTheFill) {
  const Assembly base = small_bridge("cs2", 4.0, 2.0);
  Assembly other = base;
  std::swap(other.fill.tets[0], other.fill.tets[1]);
  EXPECT_THROW(find_classes(base, other), InputError);
}

TEST(ReducedModel, RefusesAnAssemblyOfFewerBlocks) {
  const Assembly base = bridge(6.0);
  Assembly fewer = base;
  fewer.blocks.pop_back();
  EXPECT_THROW(find_classes(base, fewer), InputError);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
