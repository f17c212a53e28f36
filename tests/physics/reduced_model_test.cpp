// Modes in a basis of few vectors against those of the whole model, of every effect at every place.
#include "solver/diagnosis/reduced_model.h"

#include "solver/base/error.h"
#include "tests/physics/measured_bridge.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

constexpr int wanted = 8;

/// Squares of the cosines between a mode of the whole model and those of the basis whose frequencies are near, in the
/// displacements: a sum, because modes that nearly coincide are a plane.
double assurance(const Response& whole, const LinearModel& model, int i, const ReducedModel& reduced,
                 const ReducedModes& modes, std::size_t blocks) {
  const Eigen::VectorXd phi = whole.vectors.col(i);
  const Eigen::VectorXd momentum = model.m.selfadjointView<Eigen::Lower>() * phi;
  const Eigen::MatrixXd vectors = reduced.vectors(modes, wanted + 4);
  double sum = 0.0;
  for (Eigen::Index j = 0; j < vectors.cols(); ++j) {
    if (std::abs(std::log(modes.eigenvalues[j] / whole.eigenvalues[i])) > 0.02) continue;
    double along = 0.0;  // block by block: freed ones have other numbers
    for (std::size_t b = 0; b < blocks; ++b)
      along += part_of(momentum, model.unknowns, b).dot(part_of(vectors.col(j), reduced.unknowns(), b));
    sum += along * along;
  }
  return sum;
}

class InABasis : public testing::TestWithParam<std::string> {};

/// At 0.5, 1 and 2 deviations of the first parameter's prior to either side of its middle.
TEST_P(InABasis, EveryPlaceHasTheModesOfTheWholeModel) {
  int tried = 0;  // CS2 has no parapets
  for (const auto& [name, scale] : {std::pair("cs1", 5.0), {"cs2", 3.0}}) {
    GeneratorInput input = default_input(find_generator(name));
    input.values.at("block_scale") = scale;
    Assembly base = find_generator(name).build(input);
    base.generator = name;
    const Origin origin(base, {}, 20);
    for (const Candidate& candidate : candidates(base, {}, {false, false, false, {}})) {
      if (candidate.name != GetParam() || candidate.kind != Candidate::Kind::effect) continue;
      Hypothesis hypothesis;
      hypothesis.effects = {candidate};
      for (const double amount : {-2.0, -1.0, -0.5, 0.5, 1.0, 2.0}) {
        SCOPED_TRACE(fmt::format("{} {} {}", name, candidate.text(), amount));
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
          EXPECT_GT(assurance(whole, model, i, reduced, modes, changed.blocks.size()), 0.9999) << i;
        }
        ++tried;
      }
    }
  }
  EXPECT_GT(tried, 0);
}

std::vector<std::string> of_the_model() {
  std::vector<std::string> names;
  for (const Effect& effect : effects())
    if (effect.weight > 0.0 && effect.apply) names.push_back(effect.name);
  return names;
}
INSTANTIATE_TEST_SUITE_P(All, InABasis, testing::ValuesIn(of_the_model()), [](const auto& i) { return i.param; });

/// The same matrices whether what changes is taken class by class or joint by joint.
TEST(ReducedModel, ClassesAreTheSumOfTheirJoints) {
  const Assembly base = bridge(6.0);
  const Origin origin(base, {}, 10);
  Assembly changed = with(base, "calibration", "masonry", {{"stiffness", 0.7}, {"density", 1.1}});
  changed = with(changed, "joint_softening", "pier 0", {{"factor", 0.4}});
  changed = with(changed, "abutment_restraint", "left", {{"stiffness_share", 0.5}});
  ReducedModel one(origin, changed, {}), classes(origin, changed, find_classes(base, changed));
  EXPECT_GT(classes.classes().joints.size(), 2u);
  const auto a = one.matrices(find_change(base, one.classes(), changed)),
             b = classes.matrices(find_change(base, classes.classes(), changed));
  EXPECT_LT((a.k - b.k).norm(), 1e-12 * a.k.norm());
  EXPECT_LT((a.m - b.m).norm(), 1e-12 * a.m.norm());
}

TEST(ReducedModel, RefusesAnAssemblyOfFewerBlocks) {
  const Assembly base = bridge(6.0);
  Assembly fewer = base;
  fewer.blocks.pop_back();
  EXPECT_THROW(find_classes(base, fewer), InputError);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
