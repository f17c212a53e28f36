// The rule that draws blind suites, and what the copies of measurements leave as it is.
#include <gtest/gtest.h>

#include <algorithm>
#include <map>

#include "io/case/case.h"
#include "io/measured/measured.h"
#include "solver/base/error.h"
#include "tests/folder.h"
#include "tools/blind/invariance.h"
#include "tools/blind/score.h"
#include "tools/hide/loosening.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::Folder;

const std::string drawn[] = {"second", "third"};

TEST(BlindSuite, HasTheSortsThatItShould) {
  EXPECT_EQ(find_suite("first").trials.size(), 61u);
  for (const std::string& name : drawn) {
    std::map<TrialKind, int> counts;
    for (const BlindTrial& t : find_suite(name).trials) ++counts[kind_of(t)];
    EXPECT_EQ(counts[TrialKind::nothing], 12);
    EXPECT_EQ(counts[TrialKind::one], 30);
    EXPECT_EQ(counts[TrialKind::two], 10);
    EXPECT_EQ(counts[TrialKind::outside], 8);
    EXPECT_EQ(counts[TrialKind::fault], 8);
  }
  EXPECT_THROW(find_suite("fourth"), InputError);
}

TEST(BlindSuite, IsTheSameEachTimeAndAnotherForAnotherSeed) {
  const auto text = [](const std::vector<BlindTrial>& suite) {
    std::string all;
    for (const BlindTrial& t : suite)
      all += fmt::format("{} {} {} {} {}\n", t.bridge, t.sensors, t.seed, hidden_text(t, t.effects), truth_text(t));
    return all;
  };
  EXPECT_EQ(text(drawn_suite(5)), text(drawn_suite(5)));
  EXPECT_NE(text(drawn_suite(5)), text(drawn_suite(6)));
}

/// What is drawn can be hidden: effects, places and amounts that there are, on the bridge of the trial.
TEST(BlindSuite, DrawsWhatTheBridgesHave) {
  std::map<std::string, Assembly> bridges;
  for (const std::string bridge : {"cs1", "cs2"})
    bridges[bridge] =
        make_assembly(parse_case("[bridge]\ngenerator = \"" + bridge + "\"\nabutments = \"free\"\nblock_scale = 3.0\n",
                                 "c.toml", CaseUse::geometry));
  for (const std::string& name : drawn)
    for (const BlindTrial& t : find_suite(name).trials) {
      Assembly bridge = bridges.at(t.bridge);
      for (const std::string& text : t.effects) {
        if (text.starts_with("sensor_fault")) continue;
        EffectSetting setting;
        std::istringstream words(text);
        words >> setting.name;
        for (std::string word; words >> word;)
          if (const std::size_t at = word.find('='); at != std::string::npos)
            setting.values[word.substr(0, at)] = std::stod(word.substr(at + 1));
          else
            setting.where += (setting.where.empty() ? "" : " ") + word;
        EXPECT_FALSE(setting.values.empty()) << text;
        EXPECT_NO_THROW(complete(setting)) << text;
        EXPECT_NO_THROW(apply_effect(bridge, setting)) << text;
      }
      for (const std::string& text : t.loosened) EXPECT_NO_THROW(loosen(bridge, parse_loosening(text))) << text;
      EXPECT_GE(t.mesh, 0.7);
      EXPECT_LE(t.mesh, 1.6);
      EXPECT_NO_THROW(parse_case(case_of(t), "c.toml", CaseUse::geometry));
    }
}

TEST(BlindSuite, NamesChannelsByWhereTheyStandInAPlan) {
  const std::string plan = "id,x,y,z,direction\na,1,2,3,y\nb,1,2,3,z\nc,5,2,3,y\nd,5,2,4,-z\n";
  const auto named = [&](const std::string& text) { return with_channels(text, plan); };
  EXPECT_EQ(named("sensor_fault channel {any 0.6} gain=-1"), "sensor_fault channel c gain=-1");
  EXPECT_EQ(named("sensor_fault channel {any 1}"), "sensor_fault channel d");
  EXPECT_EQ(named("sensor_fault channel {flat 0.6} turn=90"), "sensor_fault channel c turn=90");
  EXPECT_EQ(named("sensor_fault channel {upright 0.6}"), "sensor_fault channel d");
  EXPECT_EQ(named("sensor_fault channels {pair 0.9}"), "sensor_fault channels a b");
  EXPECT_EQ(named("scour pier 0 x-"), "scour pier 0 x-");
  EXPECT_THROW(with_channels("sensor_fault channels {pair 0.9}", "id,x,y,z,direction\na,1,2,3,y\n"), RunError);
}

Measured small_measurement(bool recorded) {
  Measured m;
  m.sensors = {{"a", {1, 2, 3}, Vec3::UnitX()}, {"b", {1, 2, 3}, Vec3::UnitY()}, {"c", {4, 2, 3}, Vec3::UnitZ()}};
  if (recorded) {
    Recording r;
    r.name = "records/x.csv";
    r.dt = 0.01;
    r.channels = {"a", "b", "c", "base_x"};
    r.values.resize(120, 4);
    for (Eigen::Index i = 0; i < 120; ++i)
      for (Eigen::Index c = 0; c < 4; ++c) r.values(i, c) = 0.123456789 * std::sin(0.3 * double(i) + double(c));
    m.records = {r};
    return m;
  }
  for (int i = 0; i < 2; ++i) {
    MeasuredMode mode;
    mode.name = std::to_string(i + 1);
    mode.period = 0.3123456789 / (i + 1), mode.period_std = 0.003;
    mode.damping = 0.0212345, mode.damping_std = 0.002;
    mode.direction = "transverse";
    mode.shape = {{0, 0.111111111, 0.02}, {1, -1.0, 0.02}, {2, 0.123456789, 0.02}};
    m.modes.push_back(mode);
  }
  return m;
}

TEST(BlindCopies, OfModesSayTheSame) {
  const Folder folder;
  const Measured m = small_measurement(false);
  write_measured(m, folder / "m");
  const auto copy = [&](Copy c) {
    write_copy(folder / "m", c, folder / "copy");
    return read_measured(folder / "copy");
  };
  const Measured rounded = copy(Copy::rounded);
  EXPECT_EQ(rounded.modes[0].period, 0.3123);
  EXPECT_EQ(rounded.modes[1].shape[2].value, 0.1235);
  EXPECT_EQ(rounded.sensors[0].position, m.sensors[0].position);
  const Measured scaled = copy(Copy::scaled);
  EXPECT_NEAR(scaled.modes[0].shape[0].value, 111.111111, 1e-9);
  EXPECT_NEAR(scaled.modes[0].shape[0].std, 20.0, 1e-9);
  EXPECT_EQ(scaled.modes[0].period, m.modes[0].period);
  const Measured reordered = copy(Copy::reordered);
  EXPECT_EQ(reordered.sensors[0].id, "c");
  EXPECT_EQ(reordered.modes[0].name, "2");
  for (const MeasuredValue& v : reordered.modes[1].shape)
    if (reordered.sensors[v.sensor].id == "a") {
      EXPECT_EQ(v.value, m.modes[0].shape[0].value);
    }
  const Measured hertz = copy(Copy::other_unit);
  EXPECT_NEAR(hertz.modes[0].period, m.modes[0].period, 1e-15);
  EXPECT_NEAR(hertz.modes[0].period_std, m.modes[0].period_std, 1e-15);
}

TEST(BlindCopies, OfRecordingsSayTheSame) {
  const Folder folder;
  const Measured m = small_measurement(true);
  write_measured(m, folder / "m");
  const auto copy = [&](Copy c) {
    write_copy(folder / "m", c, folder / "copy");
    return read_measured(folder / "copy").records.at(0);
  };
  EXPECT_LT((copy(Copy::rounded).values - m.records[0].values).cwiseAbs().maxCoeff(), 0.6e-4);
  EXPECT_LT((copy(Copy::scaled).values - 1000.0 * m.records[0].values).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((copy(Copy::other_unit).values - m.records[0].values).cwiseAbs().maxCoeff(), 1e-12);
  const Recording reordered = copy(Copy::reordered);
  EXPECT_EQ(reordered.channels, (std::vector<std::string>{"base_x", "c", "b", "a"}));
  EXPECT_EQ(reordered.values.col(3), m.records[0].values.col(0));
}

nlohmann::json effect(const std::string& name, const std::string& where, const std::string& parameter, double value,
                      double std) {
  return {{"name", name},
          {"where", where},
          {"probability", 0.95},
          {"parameters", {{parameter, {{"value", value}, {"std", std}}}}}};
}
nlohmann::json diagnosis(const std::string& verdict, const std::vector<nlohmann::json>& effects) {
  return {{"verdict", verdict},
          {"effects", nlohmann::json(effects)},
          {"ties", nlohmann::json::array()},
          {"gap", {{"fit", {{"before", 3.0}, {"after", 1.0}}}, {"held_back", {{"after", 1.0}}}}}};
}
Outcome scored(const BlindTrial& trial, const nlohmann::json& d) {
  Outcome o;
  o.trial = &trial;
  score({trial.effects, d, 100.0, "log"}, 0.8, o);
  return o;
}

TEST(BlindScore, CountsNamesPlacesValuesAndFaults) {
  BlindTrial t;
  t.mesh = 0.5;
  t.effects = {"abutment_restraint both stiffness_share=0.3", "sensor_fault channel a turn=90"};
  const nlohmann::json restraint = effect("abutment_restraint", "both", "stiffness_share", 0.58, 0.02);
  const Outcome half = scored(t, diagnosis("found", {restraint}));
  EXPECT_EQ(half.score, 0.5);
  EXPECT_EQ(half.values, 1);
  EXPECT_EQ(half.values_right, 1) << "0.3 of joints twice as stiff";
  EXPECT_EQ(half.faults, 1);
  EXPECT_EQ(half.faults_right, 0);
  const Outcome both =
      scored(t, diagnosis("found", {restraint, effect("sensor_fault", "channel a", "turn", 90.0, 0.0)}));
  EXPECT_EQ(both.score, 1.0);
  EXPECT_EQ(both.faults_right, 1);
  const Outcome other = scored(t, diagnosis("found", {effect("sensor_fault", "channel a", "gain", -1.0, 0.0)}));
  EXPECT_EQ(other.score, 0.0);
  EXPECT_TRUE(other.wrong);
}

TEST(BlindScore, OutOfTheLibraryAsksForThePlace) {
  BlindTrial t;
  t.loosened = {"part=arch 1 factor=0.02"};
  t.where = "arch 1";
  EXPECT_EQ(scored(t, diagnosis("found", {effect("joint_softening", "arch 1", "factor", 0.4, 0.1)})).score, 1.0);
  EXPECT_TRUE(scored(t, diagnosis("found", {effect("joint_softening", "arch 2", "factor", 0.4, 0.1)})).wrong);
  nlohmann::json unexplained = diagnosis("unexplained", {});
  unexplained["nameless"] = nlohmann::json::array();
  unexplained["nameless"].push_back({{"name", "stiffness"}, {"where", "arch 1"}});
  EXPECT_EQ(scored(t, unexplained).score, 1.0);
  t.loosened.clear();
  t.effects = {"joint_softening arch 1 factor=0.2"};
  t.without = "joint_softening";
  EXPECT_EQ(scored(t, unexplained).score, 1.0);
  const Outcome named = scored(t, diagnosis("found", {effect("fill_interface", "arch 1", "factor", 0.4, 0.1)}));
  EXPECT_EQ(named.score, 0.0);
  EXPECT_TRUE(named.placed);
  EXPECT_TRUE(named.wrong);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
