// Errors of the model that have a structure, channels that do not read what they should, and what data could show.
#include "geometry/nearest_block.h"
#include "solver/linear/dense_solve.h"
#include "tests/physics/measured_bridge.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// The small bridge with one key more than usual by so much.
Assembly with_key(const std::string& key, double more) {
  const Generator& generator = find_generator("cs1");
  GeneratorInput input = default_input(generator);
  input.choices.at("abutments") = "free";
  input.values.at("block_scale") = 4.0;
  input.values.at("abutment_leaf_length") = 1.5;
  input.values.at(key) += more;
  Assembly assembly = generator.build(input);
  assembly.generator = "cs1";
  return assembly;
}

std::vector<Nuisance> nuisances_of(const Assembly& base) {
  std::vector<Nuisance> all = part_nuisances(base);
  for (const char* key : {"spandrel_thickness_top", "width", "fill_over_crown"})
    all.push_back({key, "m", 0.02, 1e-3, [key](const Assembly&, double more) { return with_key(key, more); }});
  return all;
}

/// Every nuisance, against bridges that are solved a step to either side.
TEST(Sensitivities, AreThoseOfModelsSolvedToEitherSide) {
  const Assembly base = bridge();
  const std::vector<Sensor> sensors = sensors_on(base);
  const int wanted = 5;
  const Origin origin(base, sensors, 20, true);
  const Sensitivities of(origin, sensors, wanted);
  int said = 0;
  for (const Nuisance& nuisance : nuisances_of(base)) {
    const Sensitivity s = of.of(nuisance, base, {}, {});
    ASSERT_TRUE(s.why.empty()) << nuisance.name << ": " << s.why;
    ++said;
    const auto moved = [&](double by) {
      const Assembly assembly = nuisance.with(base, by);
      EigenMemory memory;
      Response r = response(assembly, linear_model(assembly), sensors, wanted, memory, true);
      for (Eigen::Index i = 0; i < wanted; ++i)  // the sign of a vector is free
        if (r.sensors.col(i).dot(origin.response().sensors.col(i)) < 0.0)
          r.sensors.col(i) *= -1.0, r.participation.col(i) *= -1.0;
      return r;
    };
    const double step = nuisance.step;
    const Response low = moved(-step), high = moved(step);
    const Eigen::VectorXd frequency = nuisance.spread * (high.log_frequency - low.log_frequency) / (2.0 * step);
    const Eigen::MatrixXd shapes = nuisance.spread * (high.sensors - low.sensors) / (2.0 * step),
                          driven = nuisance.spread * (high.participation - low.participation) / (2.0 * step);
    EXPECT_LT((s.modes.log_frequency.head(wanted) - frequency).cwiseAbs().maxCoeff(),
              (nuisance.unit == "m" ? 0.05 : 0.01) * frequency.cwiseAbs().maxCoeff() + 1e-7)
        << nuisance.name;
    // Modes that are not among the twenty answer statically: less than a share λ/λ_n of them is missing.
    EXPECT_LT((s.modes.sensors.leftCols(wanted) - shapes).norm(), 0.1 * shapes.norm() + 1e-8) << nuisance.name;
    EXPECT_LT((s.modes.participation.leftCols(wanted) - driven).norm(), 0.1 * driven.norm() + 1e-3) << nuisance.name;
  }
  EXPECT_GT(said, 20);
}

/// What a bridge differs by that is within the nuisances is noise, and is not without them.
TEST(Covariance, HoldsWhatPartsAreOffBy) {
  const Assembly base = bridge();
  Assembly truth = with_key("fill_over_crown", 0.02);
  scale_inside(truth, masonry_part(truth, "pier 1"), 1.16);
  scale_inside(truth, masonry_part(truth, "spandrel y-"), 0.88);
  scale_inside(truth, masonry_part(truth, "arch 0"), 0.88);
  DiagnosisProblem problem = measured(base, truth, 5);
  for (MeasuredFeature& mode : problem.features.modes) mode.frequency_std = 1e-3, mode.shape_std *= 0.1;
  problem.error.frequency = problem.error.shape = 1e-3, problem.error.mixing = 0.0;
  const auto misfit = [&](const std::vector<Nuisance>& nuisances) {
    problem.nuisances = nuisances;
    set_covariance(problem);
    return fit(problem, {}, Eigen::VectorXd(), 0).gap;
  };
  const double without = misfit({}), with = misfit(nuisances_of(base));
  EXPECT_GT(without, 1.3);
  EXPECT_LT(with, 0.5 * without);
}

/// Conditional normal distributions: e = d_i − C_ij C_jj⁻¹ d_j, of the covariance C_ii − C_ij C_jj⁻¹ C_ji.
TEST(Covariance, LeavesOutASensorAsAConditionalDistributionDoes) {
  const Assembly base = bridge();
  DiagnosisProblem problem = measured(base, with(base, "scour", "pier 0 y-", {{"lost_share", 0.4}}), 4);
  problem.nuisances = nuisances_of(base);
  set_covariance(problem);
  const Hypothesis materials = {calibrations(base), {}};
  const Fit f = fit(problem, materials, Eigen::VectorXd::Zero(Eigen::Index(materials.size())), 4);
  const std::vector<LeftOutSensor> left = leave_out_sensors(problem, f);
  const std::vector<ResidualRow> rows = residual_rows(problem);
  const Eigen::MatrixXd j = problem.colouring * f.jacobian;
  const Eigen::MatrixXd c = problem.covariance.at(f.scale) + j * j.transpose();
  const Eigen::VectorXd d = f.best.differences - j * f.best.x;
  for (std::size_t s : {std::size_t(0), std::size_t(7)}) {
    std::vector<int> own, others;
    for (std::size_t i = 0; i < rows.size(); ++i)
      (rows[i].kind == ResidualRow::Kind::shape && rows[i].sensor == int(s) ? own : others).push_back(int(i));
    const Eigen::MatrixXd across = c(own, others) * inverse_of(c(others, others));
    const Eigen::VectorXd e = d(own) - across * d(others);
    const Eigen::MatrixXd covariance = c(own, own) - across * c(others, own);
    EXPECT_EQ(left[s].rows, int(own.size()));
    EXPECT_NEAR(left[s].misfit, e.dot(solve_symmetric(covariance, e)), 1e-6 * (1.0 + left[s].misfit));
  }
}

struct Fault {
  std::string name;
  double gain, turn, tilt;
  bool effect = false;  // beside an effect
};
class EachFault : public testing::TestWithParam<Fault> {};

/// A channel that reads something else is put right, and before anything else where nothing else is wrong.
TEST_P(EachFault, IsSetRightFirst) {
  const Fault& fault = GetParam();
  const Assembly base = bridge();
  Assembly truth = base;
  scale_inside(truth, masonry_part(truth, "pier 1"), 1.08);
  if (fault.effect) truth = with(truth, "abutment_restraint", "both", {{"stiffness_share", 0.3}});
  std::vector<Sensor> wrong = sensors_on(truth);
  Sensor& channel = wrong[4];  // along y
  if (fault.turn != 0.0 || fault.tilt != 0.0) channel.direction = mounted(channel.direction, fault.turn, fault.tilt);
  channel.direction *= fault.gain;
  DiagnosisProblem problem = measured(base, truth, 5);
  EigenMemory memory;
  const Response r = response(truth, linear_model(truth), wrong, 5, memory);
  for (std::size_t m = 0; m < 5; ++m) problem.features.modes[m].shape = r.sensors.col(Eigen::Index(m));
  problem.nuisances = part_nuisances(base);
  set_covariance(problem);
  DiagnosisSettings settings = quick(2);
  settings.effects = 1;
  settings.detectable = false;
  const Diagnosis d = diagnose(problem, settings, [](const std::string&) {});
  const std::vector<Candidate>& found = d.best.hypothesis.effects;
  ASSERT_EQ(found.size(), fault.effect ? 2u : 1u);
  // Beside an effect it may be too far off to be certain before the effect is known.
  const std::size_t own = found[0].of_sensors() ? 0 : 1;
  EXPECT_EQ(found[own].text(), "sensor_fault at channel " + channel.id);
  if (fault.effect) {
    EXPECT_EQ(found[1 - own].text(), "abutment_restraint at both");
  }
  const std::vector<EffectSetting> settings_said = d.best.hypothesis.settings(d.best.best.x);
  const auto at = std::find_if(settings_said.begin(), settings_said.end(),
                               [](const EffectSetting& e) { return e.name == "sensor_fault"; });
  ASSERT_NE(at, settings_said.end());
  const EffectSetting& said = *at;
  EXPECT_NEAR(said.values.at("gain"), fault.gain, 0.1 * std::abs(fault.gain));
  EXPECT_EQ(said.values.at("turn"), fault.turn);
  EXPECT_EQ(said.values.at("tilt"), fault.tilt);
}

INSTANTIATE_TEST_SUITE_P(All, EachFault,
                         testing::Values(Fault{"Reversed", -1.0, 0.0, 0.0},
                                         Fault{"ReversedBesideAnEffect", -1.0, 0.0, 0.0, true},
                                         Fault{"Dead", 0.0, 0.0, 0.0}, Fault{"Gain", 2.5, 0.0, 0.0},
                                         Fault{"OnAnotherAxis", 1.0, 90.0, 0.0}, Fault{"Askew", 1.0, -45.0, 0.0},
                                         Fault{"Upright", 1.0, 0.0, 90.0}),
                         [](const auto& i) { return i.param.name; });

/// What is said to be found is found at somewhat more, and is not at a third of it.
TEST(LeastAmounts, AreWhatADiagnosisFinds) {
  const Assembly base = bridge();
  DiagnosisProblem problem = measured(base, base, 5);
  problem.nuisances = part_nuisances(base);
  set_covariance(problem);
  DiagnosisSettings settings = quick(2);
  const Diagnosis none = diagnose(problem, settings, [](const std::string&) {});
  ASSERT_EQ(none.verdict, Diagnosis::Verdict::consistent);
  // What all supports have shows about as soon as what one has, though materials can do more of it.
  double all = 0.0, single = 0.0;
  for (const Detectable& least : none.detection.least)
    if (least.name == "foundation_flexibility" && std::isfinite(least.below))
      (least.where == "all" ? all : single) = std::max(least.where == "all" ? all : single, least.below);
  EXPECT_GT(single, 0.0);
  EXPECT_GT(all, 0.3 * single);
  settings.detectable = false;
  int checked = 0;
  for (const Detectable& least : none.detection.least) {
    const bool chosen = (least.name == "joint_softening" && least.where == "pier 1") ||
                        (least.name == "added_mass" && least.where == "deck") ||
                        (least.name == "scour" && least.where == "pier 1 y-");
    if (!chosen) continue;
    const double value = std::isfinite(least.below) ? least.below : least.above;
    ASSERT_TRUE(std::isfinite(value)) << least.name;
    const auto share = [&](double s) {
      return least.neutral > 0.0 ? least.neutral * std::pow(value / least.neutral, s) : s * value;
    };
    const auto finds = [&](double s) {
      DiagnosisProblem own = measured(base, with(base, least.name, least.where, {{least.parameter, share(s)}}), 5);
      own.nuisances = problem.nuisances;
      set_covariance(own);
      const Diagnosis d = diagnose(own, settings, [](const std::string&) {});
      return !d.best.hypothesis.effects.empty() && d.best.hypothesis.effects[0].name == least.name &&
             d.best.hypothesis.effects[0].where == least.where;
    };
    EXPECT_TRUE(finds(1.3)) << least.name << " " << value;
    EXPECT_FALSE(finds(0.33)) << least.name << " " << value;
    ++checked;
  }
  EXPECT_EQ(checked, 3);
}

/// Alone, restraint of both ends explains more than that of one; beside the soft foundation of a pier it does not.
TEST(TwoEffects, AnEffectGivesWayToItsNeighbourBesideALaterOne) {
  const Assembly base = bridge();
  const Assembly truth = with(with(base, "foundation_flexibility", "pier 1", {{"soil_shear_modulus", 1e7}}),
                              "abutment_restraint", "right", {{"stiffness_share", 0.5}});
  DiagnosisProblem problem = measured(base, truth, 6);
  problem.nuisances = part_nuisances(base);
  set_covariance(problem);
  DiagnosisSettings settings = quick(2);
  settings.fits = 8;
  settings.detectable = false;
  std::string said;
  const Diagnosis d = diagnose(problem, settings, [&](const std::string& line) { said += line + "\n"; });
  EXPECT_EQ(d.verdict, Diagnosis::Verdict::found) << said;
  std::vector<std::string> names;
  for (const Candidate& c : d.best.hypothesis.effects) names.push_back(c.text());
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{"abutment_restraint at right", "foundation_flexibility at pier 1"}))
      << said;
  EXPECT_NE(said.find("abutment_restraint at right replaces"), std::string::npos) << said;
}

/// What is promised of a channel is what a measurement that has it would show.
TEST(FurtherMeasurements, LowerLeastAmountsByWhatTheyPromise) {
  const Assembly base = bridge();
  DiagnosisProblem problem = measured(base, base, 5);
  problem.nuisances = part_nuisances(base);
  set_covariance(problem);
  const auto least_of = [](const Detection& d, const Addition::Helped& h) {
    for (const Detectable& least : d.least)
      if (least.name == h.name && least.where == h.where)
        return std::pair(least.neutral, h.above ? least.above : least.below);
    return std::pair(0.0, std::nan(""));
  };
  const Hypothesis materials = {calibrations(base), {}};
  Fit as_it_is;
  as_it_is.hypothesis = materials;
  as_it_is.best.x = Eigen::VectorXd::Zero(Eigen::Index(materials.size()));
  const auto detect = [&](const DiagnosisProblem& p, int further) {
    const Origin origin(base, p.features.sensors, p.modes);
    const Vectors shared =
        material_vectors(origin, base, materials, as_it_is.best.x, question_of(p, origin.response()).wanted);
    CandidateChoice choice;
    return detection(p, as_it_is, origin, shared, candidates(base, p.features.sensors, choice), {3.0, further, 2});
  };
  const Detection before = detect(problem, 3);
  ASSERT_EQ(before.further.size(), 6u);
  for (const std::size_t i : {1, 2, 4, 5}) EXPECT_LE(before.further[i].factor, before.further[i - 1].factor);
  // The same bridge, measured with the first sensor as well.
  const Addition& sensor = before.further[0];
  ASSERT_FALSE(sensor.sensor.empty());
  double x = 0.0, y = 0.0, z = 0.0;
  char axis = ' ';
  ASSERT_EQ(std::sscanf(sensor.sensor.c_str(), "%lf,%lf,%lf,%c", &x, &y, &z, &axis), 4) << sensor.sensor;
  DiagnosisProblem more = problem;
  more.features.sensors.push_back(
      {"new", Vec3(x, y, z), Vec3::Unit(axis - 'x'), nearest_block(base, Vec3(x, y, z)).block});
  EigenMemory memory;
  const Response r = response(base, linear_model(base), more.features.sensors, 5, memory);
  for (Eigen::Index m = 0; m < 5; ++m) {
    MeasuredFeature& mode = more.features.modes[std::size_t(m)];
    const double largest = unit_of(mode), scale = largest / r.sensors.col(m).head(15).cwiseAbs().maxCoeff();
    mode.shape = scale * r.sensors.col(m);
    mode.shape_std = Eigen::VectorXd::Constant(16, 0.02 * largest);
    mode.unit = largest;
  }
  set_covariance(more);
  const auto keeps_its_promise = [&](const Addition& promised, const Detection& after) {
    int checked = 0;
    for (const Addition::Helped& h : promised.most) {
      const auto [neutral, had] = least_of(before, h);
      const double has = least_of(after, h).second;
      if (!std::isfinite(had) || !std::isfinite(has)) continue;
      const double fell = neutral > 0.0 ? std::log(has / neutral) / std::log(had / neutral) : has / had;
      EXPECT_NEAR(fell, h.factor, 0.1 * h.factor) << h.name << " " << h.where << " " << had << " " << has;
      ++checked;
    }
    EXPECT_GE(checked, 1) << promised.text;
  };
  keeps_its_promise(sensor, detect(more, 0));
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
