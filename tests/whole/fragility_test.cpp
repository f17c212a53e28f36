// voussoir fragility, as a user calls it: on tables of campaigns that are drawn from known curves.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>

#include "solver/base/json_file.h"
#include "solver/base/random.h"
#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

const std::string heading =
    "run,case,record,event,scale,sample,status,reason,seconds,im.pga,im.sa_0.30,im.d595,edp.spandrel_y,edp.keystone_x,"
    "damage.arch.broken_share\n";

/// ln spandrel = ln 0.01 + 1.5 ln sa + 0.4 N for bridge `a`, a third of that for `b`: θ of 0.02 m is 2^(2/3) and
/// 6^(2/3) m/s2, β 0.267. Peaks follow sa loosely, keystones the spandrel; one run failed, one is missing.
std::string cloud_table() {
  RandomStream random(17);
  std::string text = heading;
  for (const char* bridge : {"a", "b"})
    for (int i = 0; i < 150; ++i) {
      const double sa = 0.4 * std::pow(20.0, random.uniform()), pga = 0.4 * sa * std::exp(0.4 * random.normal());
      const double y = (*bridge == 'a' ? 1.0 : 1.0 / 3.0) * 0.01 * std::pow(sa, 1.5) * std::exp(0.4 * random.normal());
      const double x = 0.5 * y * std::exp(0.7 * random.normal());
      text += fmt::format("{0}-{1},{0},record {1},,1,,done,,60,{2},{3},{4},{5},{6},{7}\n", bridge, i, pga, sa,
                          10.0 * std::exp(0.3 * random.normal()), y, x, std::min(1.0, 5.0 * y));
    }
  return text +
         "lost,a,record 1,,2,,failed,\"energy grew,\nsee run.log\",3,1,2,10,,,\nlater,b,record 2,,2,,missing,,,,,,,,\n";
}

nlohmann::json fragility_json(const std::string& folder) {
  return read_json(folder + "/fragility.json");
}

Outcome fragility(const Folder& folder, const std::vector<std::string>& more) {
  std::vector<std::string> words = {"fragility", "campaign"};
  words.insert(words.end(), more.begin(), more.end());
  return voussoir(words, {.folder = folder.path()});
}

/// A folder with a campaign.
struct Campaign : Folder {
  explicit Campaign(const std::string& table) {
    std::filesystem::create_directory(*this / "campaign");
    write("campaign/table.csv", table);
  }
};

TEST(Fragility, FindsTheCurvesThatACampaignWasDrawnFrom) {
  const Campaign folder(cloud_table());
  folder.write("campaign/campaign.json",
               R"({"limit_states": [{"name": "damage", "demand": "edp.spandrel_y", "threshold": 0.02, "case": ""}]})");
  const Outcome outcome = fragility(folder, {"--bootstrap", "300"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("302 runs: 300 done, 1 failed, 1 not run yet"), std::string::npos) << outcome.out;
  const nlohmann::json json = fragility_json(folder / "campaign");
  ASSERT_EQ(json["curves"].size(), 2u);
  for (const auto& curve : json["curves"]) {
    const double theta = std::pow(curve["case"] == "a" ? 2.0 : 6.0, 2.0 / 3.0), beta = 0.4 / 1.5;
    EXPECT_EQ(curve["im"], "im.sa_0.30");
    EXPECT_EQ(curve["im_unit"], "m/s²");
    EXPECT_EQ(curve["method"], "cloud");
    EXPECT_EQ(curve["identified"], true);
    EXPECT_NEAR(std::log(curve["theta"].get<double>() / theta), 0.0, 3.0 * curve["ln_theta_std"].get<double>());
    EXPECT_NEAR(curve["beta"].get<double>(), beta, 3.0 * curve["beta_std"].get<double>());
    EXPECT_LT(curve["theta_band"][0], curve["theta"]);
    EXPECT_GT(curve["theta_band"][1], curve["theta"]);
    EXPECT_EQ(curve["other"]["method"], "counts");
    EXPECT_NEAR(std::log(curve["other"]["theta"].get<double>() / theta), 0.0,
                3.0 * curve["other"]["ln_theta_std"].get<double>());
    EXPECT_EQ(curve["curve"].size(), 81u);
    EXPECT_EQ(curve["runs"]["used"], 150);
  }
  EXPECT_EQ(json["curves"][0]["runs"]["failed"], 1);
  EXPECT_EQ(json["curves"][1]["runs"]["missing"], 1);
  ASSERT_EQ(json["rankings"].size(), 4u);  // two bridges, two demands
  EXPECT_EQ(json["rankings"][0]["intensities"][0]["im"], "im.sa_0.30");
  ASSERT_EQ(json["damage"].size(), 2u);
  EXPECT_EQ(json["damage"][0]["demands"][0]["demand"], "edp.spandrel_y");
  const std::string page = bytes_of(folder / "campaign/fragility.html");
  EXPECT_NE(page.find("spandrel y reaches 0.02 m"), std::string::npos);
  EXPECT_EQ(page.find("nan"), std::string::npos);
  EXPECT_TRUE(exists(folder / "campaign/images/fragility_damage.svg"));
  const std::string csv = bytes_of(folder / "campaign/fragility.csv");
  EXPECT_EQ(std::count(csv.begin(), csv.end(), '\n'), 3);
}

/// Five records at each of four levels of peak acceleration; the strongest brings bridges down.
TEST(Fragility, CountsAtTheLevelsThatRecordsWereScaledTo) {
  std::string table = heading;
  const int beyond[] = {0, 2, 4, 5};
  for (int level = 0; level < 4; ++level)
    for (int i = 0; i < 5; ++i) {
      const bool fell = level == 3 && i < 2;
      table += fmt::format("l{0}-{1},a,r{1},,1,,{2},,60,{3},{4},10,{5},,\n", level, i, fell ? "collapsed" : "done",
                           0.5 * std::pow(2.0, level), 1.1 + 0.01 * i + level,
                           fell ? std::string() : fmt::format("{}", i < beyond[level] ? 0.05 : 0.01));
    }
  const Campaign folder(table);
  const Outcome outcome =
      fragility(folder, {"--limit", "damage:spandrel_y:0.02", "--im", "pga", "-o", "out", "--seed", "5"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json json = fragility_json(folder / "out");
  ASSERT_EQ(json["curves"].size(), 2u);  // falling is a limit of its own
  const auto& curve = json["curves"][0];
  EXPECT_EQ(curve["method"], "counts");
  ASSERT_EQ(curve["levels"].size(), 4u);
  EXPECT_EQ(curve["levels"][2]["beyond"], 4);
  EXPECT_EQ(curve["levels"][3]["beyond"], 5);
  EXPECT_GT(curve["theta"], 1.0);
  EXPECT_LT(curve["theta"], 2.0);
  EXPECT_EQ(json["curves"][1]["limit"], "collapse");
  EXPECT_EQ(json["curves"][1]["identified"], false);
  EXPECT_EQ(json["curves"][1]["theta"], nullptr);
  EXPECT_EQ(json["curves"][1]["theta_between"][0], 4.0);
  EXPECT_NE(outcome.out.find("at one intensity only, 4 m/s², some runs exceed the limit and others do not (2 of 5 "
                             "exceed it): θ lies above it"),
            std::string::npos)
      << outcome.out;
  EXPECT_FALSE(exists(folder / "campaign/fragility.json"));
}

TEST(Fragility, IsTheSameAgainAndQuiet) {
  const Campaign folder(cloud_table());
  const std::vector<std::string> limit = {"--limit", "damage:edp.spandrel_y:0.02", "--bootstrap", "50", "-q", "-o"};
  for (const char* out : {"one", "two"}) {
    std::vector<std::string> words = limit;
    words.push_back(out);
    const Outcome outcome = fragility(folder, words);
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(outcome.out, "");
  }
  EXPECT_EQ(contents(folder / "one"), contents(folder / "two"));
}

TEST(Fragility, ALimitMayHaveAThresholdABridge) {
  const Campaign folder(cloud_table());
  folder.write("campaign/campaign.json",
               R"({"limit_states": [{"name": "damage", "demand": "edp.spandrel_y", "threshold": 0.03, "case": "a"},
                                    {"name": "damage", "demand": "edp.spandrel_y", "threshold": 0.01, "case": "b"}]})");
  const Outcome outcome = fragility(folder, {"--bootstrap", "0"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("limit damage: spandrel y reaches 0.03 m"), std::string::npos);
  EXPECT_NE(outcome.out.find("limit damage: spandrel y reaches 0.01 m"), std::string::npos);
  const nlohmann::json json = fragility_json(folder / "campaign");
  ASSERT_EQ(json["curves"].size(), 2u);
  // The same curve twice: three times the threshold for a bridge that moves three times as far.
  for (const auto& curve : json["curves"]) {
    EXPECT_NEAR(std::log(curve["theta"].get<double>() / std::pow(3.0, 2.0 / 3.0)), 0.0,
                3.0 * curve["ln_theta_std"].get<double>());
    EXPECT_EQ(curve["theta_band"][0], nullptr);  // without resamples
  }
  EXPECT_EQ(names_in(folder / "campaign/images"),
            (std::vector<std::string>{"fragility_damage.svg", "fragility_damage_2.svg"}));
}

/// Half of the motions have no vertical part. Over the others the vertical peak predicts the demand exactly.
TEST(Fragility, AnIntensityThatSomeRunsLackIsUsedOnlyIfAskedFor) {
  RandomStream random(3);
  std::string table = "run,case,record,event,scale,sample,status,reason,seconds,im.pga,im.pga_z,edp.spandrel_y\n";
  for (int i = 0; i < 60; ++i) {
    const double pga = 0.4 * std::pow(20.0, random.uniform()), y = 0.01 * pga * std::exp(0.4 * random.normal());
    table += fmt::format("r{0},a,record {0},,1,,done,,60,{1},{2},{3}\n", i, pga, i % 2 ? 0.0 : 30.0 * y, y);
  }
  const Campaign folder(table);
  const Outcome chosen = fragility(folder, {"--limit", "damage:spandrel_y:0.02", "-o", "chosen", "--bootstrap", "0"});
  ASSERT_EQ(chosen.status, 0) << chosen.err;
  EXPECT_EQ(fragility_json(folder / "chosen")["curves"][0]["im"], "im.pga");
  const std::string page = bytes_of(folder / "chosen/fragility.html");
  EXPECT_NE(page.find("im.pga_z (PGA along z) is zero or missing in 30 of 60 runs with a result"), std::string::npos);
  EXPECT_NE(page.find("PGA along z (not in all runs)"), std::string::npos);
  const Outcome asked =
      fragility(folder, {"--limit", "damage:spandrel_y:0.02", "--im", "pga_z", "-o", "asked", "--bootstrap", "0"});
  ASSERT_EQ(asked.status, 0) << asked.err;
  EXPECT_EQ(fragility_json(folder / "asked")["curves"][0]["im"], "im.pga_z");
  EXPECT_NE(bytes_of(folder / "asked/images/fragility_damage.svg").find(">PGA along z, m/s²<"), std::string::npos);
  EXPECT_EQ(bytes_of(folder / "asked/fragility.html").find("so the program does not choose it"), std::string::npos);
}

TEST(Fragility, WithoutALimitItRanksAndSaysHowToGiveOne) {
  const Campaign folder(cloud_table());
  const Outcome outcome = fragility(folder, {});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("--limit NAME:DEMAND:THRESHOLD"), std::string::npos);
  const nlohmann::json json = fragility_json(folder / "campaign");
  EXPECT_TRUE(json["curves"].empty());
  EXPECT_EQ(json["rankings"].size(), 4u);
}

TEST(Fragility, SaysWhatIsWrong) {
  const Campaign folder(cloud_table());
  expect_error(voussoir({"fragility", "nowhere"}, {.folder = folder.path()}), 2, {"nowhere/table.csv"});
  expect_error(fragility(folder, {"--limit", "damage:spandrel:0.02"}), 2,
               {"--limit damage:spandrel:0.02", "no column 'edp.spandrel': did you mean 'edp.spandrel_y'"});
  expect_error(fragility(folder, {"--limit", "damage:im.pga:0.02"}), 2,
               {"the demand of limit state 'damage' is 'im.pga'"});
  expect_error(fragility(folder, {"--limit", "damage"}), 2, {"must be NAME:DEMAND:THRESHOLD"});
  expect_error(fragility(folder, {"--limit", "damage:spandrel_y:2 cm"}), 2,
               {"the threshold is '2 cm'", "must be a number"});
  expect_error(fragility(folder, {"--limit", "damage:spandrel_y:-1"}), 2, {"It must be above 0"});
  expect_error(fragility(folder, {"--im", "sa_0.3"}), 2, {"no column 'im.sa_0.3'", "im.sa_0.30"});
  expect_error(fragility(folder, {"--bootstrap", "-1"}), 2, {"--bootstrap is -1"});
  for (const auto& [json, piece] : std::vector<std::pair<std::string, std::string>>{
           {"{", "is not valid JSON"},
           {R"({"limit_states": 3})", "'limit_states' must be a list"},
           {R"({"limit_states": [3]})", "needs 'name', 'demand' and 'threshold'"},
           {R"({"limit_states": [{"name": "d", "demand": "edp.keystone_x"}]})", "needs a number 'threshold'"},
           {R"({"limit_states": [{"name": 1, "demand": "edp.keystone_x"}]})", "'name' must be a text"},
           {R"({"limit_states": [{"name": "d", "demand": "edp.keystone_x", "threshold": 1, "case": "c"}]})",
            "is for case 'c'"}}) {
    folder.write("campaign/campaign.json", json);
    expect_error(fragility(folder, {}), 2, {"campaign/campaign.json", piece});
  }
}

TEST(Fragility, ACampaignWithoutResultsIsRefused) {
  const Campaign folder(heading + "a,c,r,,1,,failed,energy,3,1,1,1,,,\nb,c,r,,1,,missing,,,,,,,,\n");
  expect_error(fragility(folder, {}), 2, {"none of 2 runs is done (1 failed, 1 not yet run)"});
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
