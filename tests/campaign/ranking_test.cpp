// Campaigns in which one intensity, and one demand, is the best by construction.
#include "tools/fragility/ranking.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/base/error.h"
#include "tests/campaign/synthetic.h"
#include "tools/fragility/fragility_words.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

NumberColumn named(const char* name) {
  return {std::string(name), {}};
}

/// Demands follow sa_0.30 with scatter 0.2; pga is that with an error, pgv with a larger one; the long ones of equal
/// intensity shake further (duration^0.3) where `duration` says so.
CampaignTable campaign(std::uint64_t seed, bool duration, int runs = 120) {
  RandomStream random(seed);
  CampaignTable table;
  table.path = "table.csv";
  table.columns = {named("im.pgv"),
                   named("im.d595"),
                   named("im.sa_0.30"),
                   named("im.pga"),
                   named("edp.x"),
                   named("edp.y"),
                   named("edp.place.left"),
                   named("damage.arch.broken_share"),
                   named("damage.arch.largest_slip")};
  for (int i = 0; i < runs; ++i) {
    table.runs.push_back(test::run_of(fmt::format("run-{}", i), "bridge", fmt::format("r{}", i)));
    const double scale = std::exp(0.5 * random.normal()), sa = scale * std::exp(0.6 * random.normal());
    const double d595 = 10.0 * std::exp(0.5 * random.normal()), scatter = std::exp(0.2 * random.normal());
    const double x = 0.01 * std::pow(sa, 1.4) * scatter * (duration ? std::pow(d595 / 10.0, 0.3) : 1.0);
    const double y = x * std::exp(0.8 * random.normal());
    const std::vector<double> row = {0.1 * sa * std::exp(0.5 * random.normal()),
                                     d595,
                                     sa,
                                     0.4 * sa * std::exp(0.3 * random.normal()),
                                     x,
                                     y,
                                     x,
                                     std::min(1.0, x),
                                     0.0};
    table.runs.back().scale = scale;
    for (std::size_t k = 0; k < row.size(); ++k) table.columns[k].values.push_back(row[k]);
  }
  return table;
}

TEST(Ranking, TheBestIntensityByConstructionIsFirst) {
  const CampaignTable table = campaign(1, false);
  const std::vector<MeasurePair> ranked = rank_intensities(table, "bridge", "edp.x");
  ASSERT_EQ(ranked.size(), 3u);  // duration is no intensity
  EXPECT_EQ(ranked[0].im, "im.sa_0.30");
  EXPECT_EQ(ranked[1].im, "im.pga");
  EXPECT_EQ(ranked[2].im, "im.pgv");
  const Line& line = ranked[0].line;
  EXPECT_EQ(line.count, 120u);
  EXPECT_NEAR(line.scatter, 0.2, 3.0 * 0.2 / std::sqrt(240.0));
  EXPECT_NEAR(line.slope, 1.4, 3.0 * line.slope_std);
  EXPECT_NEAR(ranked[0].proficiency(), line.scatter / line.slope, 1e-15);
  EXPECT_TRUE(ranked[0].sufficient());
  EXPECT_EQ(best_intensity(table, {"bridge"}, "edp.x", 0.02), "im.sa_0.30");
}

/// Where duration matters the best intensity is not sufficient, and the page can say of what.
TEST(Ranking, WhatAnIntensityLeavesOutIsFound) {
  const MeasurePair p = rank_intensities(campaign(2, true), "bridge", "edp.x")[0];
  EXPECT_EQ(p.im, "im.sa_0.30");
  EXPECT_FALSE(p.sufficient());
  ASSERT_EQ(p.sufficiency.size(), 2u);
  EXPECT_EQ(p.sufficiency[0].characteristic, "scale");
  EXPECT_GT(p.sufficiency[0].p, 0.05);
  EXPECT_EQ(p.sufficiency[1].characteristic, "im.d595");
  EXPECT_LT(p.sufficiency[1].p, 1e-4);
  EXPECT_EQ(p.least_p(), p.sufficiency[1].p);
}

/// Of many campaigns in which nothing is left out one in twenty finds something, per characteristic.
TEST(Ranking, NothingIsFoundWhereThereIsNothing) {
  int found = 0, tests = 0;
  for (std::uint64_t seed = 100; seed < 300; ++seed) {
    const auto pairings = rank_intensities(campaign(seed, false, 30), "bridge", "edp.x");
    for (const Sufficiency& s : pairings[0].sufficiency) ++tests, found += s.p < 0.05;
  }
  ASSERT_EQ(tests, 400);
  EXPECT_NEAR(double(found) / tests, 0.05, 3.0 * std::sqrt(0.05 * 0.95 / tests));
}

TEST(Ranking, CollapsesAndOtherCasesAreLeftOut) {
  CampaignTable table = campaign(3, false);
  for (std::size_t i = 0; i < 40; ++i) table.runs[i].status = RunStatus::collapsed;
  for (std::size_t i = 40; i < 60; ++i) table.runs[i].case_name = "another";
  EXPECT_EQ(rank_intensities(table, "bridge", "edp.x")[0].line.count, 60u);
  EXPECT_EQ(rank_intensities(table, "another", "edp.x")[0].line.count, 20u);
  EXPECT_TRUE(rank_intensities(table, "nobody", "edp.x").empty());
}

/// An intensity that half of the runs do not have would predict these the best by construction.
TEST(Ranking, AnIntensityThatSomeRunsLackIsNotChosen) {
  CampaignTable table = campaign(5, false);
  NumberColumn upwards = named("im.pga_z");
  for (std::size_t i = 0; i < table.runs.size(); ++i)
    upwards.values.push_back(i % 2 == 0 ? table.column("edp.x").values[i] : i % 4 == 1 ? 0.0 : test::none);
  table.columns.push_back(upwards);
  EXPECT_EQ(best_intensity(table, {"bridge"}, "edp.x", 0.02), "im.sa_0.30");
  EXPECT_NE(best_intensity(table, {"bridge"}, "collapse", 0.0), "im.pga_z");
  const std::vector<MeasurePair> ranked = rank_intensities(table, "bridge", "edp.x");
  ASSERT_EQ(ranked.size(), 4u);
  EXPECT_EQ(ranked[0].im, "im.sa_0.30");
  EXPECT_EQ(ranked[3].im, "im.pga_z");
  EXPECT_LT(ranked[3].proficiency(), ranked[0].proficiency());
  const Coverage c = coverage(table, {"bridge"}, "im.pga_z");
  EXPECT_EQ(c.with, 60u);
  EXPECT_EQ(c.runs, 120u);
  for (std::size_t i = 1; i < table.runs.size(); i += 2) table.runs[i].status = RunStatus::failed;
  EXPECT_EQ(best_intensity(table, {"bridge"}, "edp.x", 0.02), "im.pga_z") << "all runs with a result have it";
  // Nothing else is left: the runs that have it.
  for (std::size_t i = 1; i < table.runs.size(); i += 2) table.runs[i].status = RunStatus::done;
  std::erase_if(table.columns,
                [](const NumberColumn& column) { return column.name.starts_with("im.") && column.name != "im.pga_z"; });
  EXPECT_EQ(best_intensity(table, {"bridge"}, "edp.x", 0.02), "im.pga_z");
}

TEST(Ranking, IntensitiesHaveNamesAndUnits) {
  EXPECT_EQ(measure_label("im.pga"), "PGA, m/s²");
  EXPECT_EQ(measure_label("im.pga_z"), "PGA along z, m/s²");
  EXPECT_EQ(measure_label("im.pgv"), "PGV, m/s");
  EXPECT_EQ(measure_label("im.arias"), "Arias intensity, m/s");
  EXPECT_EQ(measure_label("im.cav"), "CAV, m/s");
  EXPECT_EQ(measure_label("im.d575"), "D5–75, s");
  EXPECT_EQ(measure_label("im.sa_0.30"), "Sa(0.30 s), m/s²");
}

/// Of a collapse there is no size: the intensity by which the counts are most probable.
TEST(Ranking, TheBestIntensityForCollapse) {
  CampaignTable table = campaign(4, false);
  RandomStream random(9);
  for (std::size_t i = 0; i < table.runs.size(); ++i)
    if (table.column("im.sa_0.30").values[i] > std::exp(0.2 * random.normal()))
      table.runs[i].status = RunStatus::collapsed;
  EXPECT_EQ(best_intensity(table, {"bridge"}, "collapse", 0.0), "im.sa_0.30");
  // Another bridge under the same motions, which never falls, has no say.
  const CampaignTable one = table;
  for (std::size_t i = 0; i < one.runs.size(); ++i) {
    table.runs.push_back(one.runs[i]);
    table.runs.back().case_name = "another", table.runs.back().status = RunStatus::done;
    for (NumberColumn& c : table.columns) c.values.push_back(c.values[i]);
  }
  EXPECT_EQ(best_intensity(table, {"bridge", "another"}, "collapse", 0.0), "im.sa_0.30");
}

TEST(Ranking, ATableWithoutIntensitiesIsRefused) {
  CampaignTable table = campaign(5, false, 6);
  std::erase_if(table.columns, [](const NumberColumn& c) { return c.name.starts_with("im.") && c.name != "im.d595"; });
  EXPECT_THROW(best_intensity(table, {"bridge"}, "edp.x", 0.02), InputError);
}

TEST(Ranking, TheDemandThatFollowsTheDamage) {
  const CampaignTable table = campaign(6, false);
  EXPECT_EQ(main_demands(table), (std::vector<std::string>{"edp.x", "edp.y"}));
  const std::vector<DamageRanking> rankings = rank_demands(table, "bridge", 200, 1);
  ASSERT_EQ(rankings.size(), 1u);  // slips are no shares
  EXPECT_EQ(rankings[0].damage, "damage.arch.broken_share");
  ASSERT_EQ(rankings[0].demands.size(), 2u);
  EXPECT_EQ(rankings[0].demands[0].demand, "edp.x");
  EXPECT_DOUBLE_EQ(rankings[0].demands[0].correlation, 1.0);
  EXPECT_LT(rankings[0].demands[1].correlation, 0.95);
  EXPECT_EQ(rankings[0].ahead, 1.0);
}

/// Two demands that are equally close: neither is ahead by much more than half of the resamples, on the average.
TEST(Ranking, NeitherIsAheadWhereBothAreAlike) {
  double sum = 0.0;
  constexpr int tries = 40;
  for (int k = 0; k < tries; ++k) {
    CampaignTable table = campaign(std::uint64_t(k), false, 40);
    RandomStream random(std::uint64_t(k) + 1000);
    const std::vector<double> damage = table.column("damage.arch.broken_share").values;
    for (std::size_t column : {4, 5})
      for (std::size_t i = 0; i < damage.size(); ++i)
        table.columns[column].values[i] = damage[i] * std::exp(0.5 * random.normal());
    const DamageRanking r = rank_demands(table, "bridge", 100, 1)[0];
    sum += r.ahead;
  }
  EXPECT_GT(sum / tries, 0.5);
  EXPECT_LT(sum / tries, 0.9);
}

TEST(Ranking, DamageThatDoesNotVaryTellsNothing) {
  CampaignTable table = campaign(7, false, 10);
  for (double& v : table.columns[7].values) v = 0.0;
  EXPECT_TRUE(rank_demands(table, "bridge", 10, 1).empty());
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
