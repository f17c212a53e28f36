// Clouds, stripes, collapses and bootstrap bands: campaigns drawn from known curves give them back.
#include "tools/fragility/fragility.h"

#include <gtest/gtest.h>

#include <cmath>

#include "solver/base/error.h"
#include "tests/campaign/synthetic.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::Cloud;
using test::draw;

LimitState limit(double threshold) {
  return {std::string("damage"), std::string("edp.x"), threshold, ""};
}

/// A point per whole number: the line is ln y = 1 + 2 ln x with the residuals of the test of lines.
TEST(Cloud, ByHand) {
  const std::vector<double> y = {1.5, 2.5, 4.5, 7.5, 9.0};
  std::vector<CloudRun> trials;
  for (std::size_t i = 0; i < y.size(); ++i)
    trials.push_back({i, std::exp(double(i)), std::exp(y[i]), false, y[i] >= 5.0});
  const CloudFit fit = fit_cloud(trials, {}, std::exp(5.0));
  ASSERT_EQ(fit.identified, Identified::yes);
  EXPECT_NEAR(fit.line.slope, 2.0, 1e-12);
  EXPECT_NEAR(fit.line.intercept, 1.0, 1e-12);
  EXPECT_NEAR(fit.line.scatter, std::sqrt(1.0 / 3.0), 1e-12);  // residuals ½ −½ −½ ½ 0
  EXPECT_NEAR(fit.curve.theta, std::exp(2.0), 1e-10);
  EXPECT_NEAR(fit.curve.beta, std::sqrt(1.0 / 3.0) / 2.0, 1e-12);
  // The median is that of the mean abscissa: only the mean's error counts, s/√n over the slope.
  EXPECT_NEAR(fit.ln_theta_std, std::sqrt(1.0 / 3.0 / 5.0) / 2.0, 1e-12);
  EXPECT_NEAR(fit.beta_std, fit.curve.beta * std::sqrt(1.0 / 6.0 + 1.0 / 3.0 / 10.0 / 4.0), 1e-12);
}

TEST(Cloud, WhatDeterminesNoLineIsSaid) {
  EXPECT_EQ(fit_cloud({}, {}, 1.0).identified, Identified::few_demands);
  std::vector<CloudRun> trials;
  for (std::size_t i = 0; i < 6; ++i) trials.push_back({i, 2.0, 1.0 + double(i), false, false});
  EXPECT_EQ(fit_cloud(trials, {}, 1.0).identified, Identified::one_level);
  for (CloudRun& t : trials) t.im = 10.0 - double(t.record);
  EXPECT_EQ(fit_cloud(trials, {}, 1.0).identified, Identified::flat);
  for (CloudRun& t : trials) t.im = 1.0 + double(t.record);
  trials.push_back({6, 20.0, test::none, true, true});
  EXPECT_EQ(fit_cloud(trials, {}, 4.0).identified, Identified::yes);
  trials.back().im = 0.5;  // the weakest motion alone
  EXPECT_EQ(fit_cloud(trials, {}, 4.0).identified, Identified::collapses);
  for (CloudRun& t : trials) t.demand = t.collapsed ? t.demand : 0.0;
  EXPECT_EQ(fit_cloud(trials, {}, 1.0).identified, Identified::few_demands);
}

TEST(Cloud, LevelsAreFoundAndCloudsHaveNone) {
  std::vector<double> im;
  for (int i = 0; i < 10; ++i)
    for (double level : {1.0, 2.0, 4.0}) im.push_back(level * (1.0 + 1e-5 * i));
  const std::vector<double> levels = levels_of(im);
  ASSERT_EQ(levels.size(), 3u);
  EXPECT_NEAR(levels[1], 2.0, 1e-4);
  RandomStream random(3);
  std::vector<double> cloud;
  for (int i = 0; i < 1000; ++i) cloud.push_back(std::exp(2.0 * random.uniform()));
  EXPECT_TRUE(levels_of(cloud).empty());
  EXPECT_TRUE(levels_of({}).empty());
  EXPECT_TRUE(levels_of({1.0, 1.0, 2.0, 2.0}).empty());  // pairs are no stripes
}

/// With collapses the whole is 1 − (1 − D)(1 − C), by hand at a point, and its median lies where that is a half.
TEST(Cloud, TotalProbability) {
  FragilityCurve curve = {2.0, 0.5, 4.0, 0.3};
  EXPECT_NEAR(curve.at(4.0), 1.0 - (1.0 - normal_cdf(std::log(2.0) / 0.5)) * 0.5, 1e-14);
  EXPECT_NEAR(curve.at(curve.median()), 0.5, 1e-10);
  EXPECT_LT(curve.median(), 2.0);
  EXPECT_LT(curve.dispersion(), 0.5);  // collapses steepen it
  curve.collapse_theta = curve.collapse_beta = test::none;
  EXPECT_NEAR(curve.median(), 2.0, 1e-10);
  EXPECT_DOUBLE_EQ(curve.dispersion(), 0.5);
}

/// All that collapse lie above all that stand, which have no scatter: two steps.
TEST(Cloud, SeparatedCollapsesAreAStep) {
  std::vector<CloudRun> trials;
  for (std::size_t i = 0; i < 6; ++i) trials.push_back({i, 1.0 + double(i), 1.0 + double(i), false, i >= 3});
  for (std::size_t i = 6; i < 8; ++i) trials.push_back({i, 24.0, test::none, true, true});
  const CloudFit fit = fit_cloud(trials, {}, 100.0);
  ASSERT_EQ(fit.identified, Identified::yes);
  EXPECT_DOUBLE_EQ(fit.curve.collapse_theta, 12.0);  // √(6 · 24)
  EXPECT_EQ(fit.curve.at(11.9), 0.0);
  EXPECT_EQ(fit.curve.at(12.1), 1.0);
  EXPECT_NEAR(fit.curve.median(), 12.0, 1e-9);
}

/// Estimates over many campaigns: unbiased, and scattering as their standard errors say.
TEST(Cloud, GivesBackWhatItWasDrawnFrom) {
  const Cloud cloud;
  constexpr double threshold = 0.05;
  constexpr int tries = 600;
  RandomStream random(21);
  double sum_t = 0.0, sum_b = 0.0, squares_t = 0.0, squares_b = 0.0, said_t = 0.0, said_b = 0.0;
  for (int k = 0; k < tries; ++k) {
    const CloudFit fit = fit_cloud(draw(cloud, threshold, random), {}, threshold);
    ASSERT_EQ(fit.identified, Identified::yes);
    const double t = std::log(fit.curve.theta / cloud.theta(threshold)), b = fit.curve.beta - cloud.beta();
    sum_t += t, sum_b += b, squares_t += t * t, squares_b += b * b;
    said_t += fit.ln_theta_std * fit.ln_theta_std, said_b += fit.beta_std * fit.beta_std;
  }
  const double std_t = std::sqrt(squares_t / tries), std_b = std::sqrt(squares_b / tries);
  EXPECT_NEAR(sum_t / tries, 0.0, 3.0 * std_t / std::sqrt(double(tries)));
  EXPECT_NEAR(sum_b / tries, 0.0, 3.0 * std_b / std::sqrt(double(tries)));
  EXPECT_NEAR(std::sqrt(said_t / tries) / std_t, 1.0, 0.09);
  EXPECT_NEAR(std::sqrt(said_b / tries) / std_b, 1.0, 0.09);
}

/// A cloud in which runs collapse with a probability of their own: the curve is met within what 4000 runs leave open.
TEST(Cloud, CollapsesArePartOfTheCurve) {
  const FragilityCurve truth = {2.0, 0.4, 3.0, 0.3};
  RandomStream random(8);
  std::vector<CloudRun> trials = draw({.a = 0.05 / std::pow(2.0, 1.5), .b = 1.5, .s = 0.6, .runs = 4000}, 0.05, random);
  for (CloudRun& t : trials)
    if (t.im >= 3.0 * std::exp(0.3 * random.normal())) t.collapsed = t.beyond = true, t.demand = test::none;
  const CloudFit fit = fit_cloud(trials, {}, 0.05);
  ASSERT_EQ(fit.identified, Identified::yes);
  for (double im : {1.0, 2.0, 3.0, 4.0}) EXPECT_NEAR(fit.curve.at(im), truth.at(im), 0.03) << im;
  const Estimate counts = estimate_counts(trials, {});
  for (double im : {1.0, 2.0, 3.0, 4.0}) EXPECT_NEAR(counts.curve.at(im), truth.at(im), 0.05) << im;
}

/// The share of campaigns whose 90 % band holds the truth, and its standard error.
struct Coverage {
  int theta = 0, beta = 0, curve = 0, tries = 0;
  void add(const Fragility& f, double theta_true, double beta_true) {
    const auto holds = [](const CurveBand& band, double value) { return band.low <= value && value <= band.high; };
    theta += holds(f.bootstrap.theta, theta_true), beta += holds(f.bootstrap.beta, beta_true);
    const CurvePoint& p = f.curve[f.curve.size() / 2];
    curve += holds(p.band, FragilityCurve{theta_true, beta_true}.at(p.im));
    ++tries;
  }
  double error() const { return std::sqrt(0.9 * 0.1 / tries); }
};

TEST(Bootstrap, BandsOfACloudHoldTheTruthNineTimesInTen) {
  const Cloud cloud;
  Coverage c;
  RandomStream random(31);
  for (int k = 0; k < 300; ++k) {
    const CampaignTable table = test::table_of(draw(cloud, 0.05, random));
    c.add(assess(table, "bridge", limit(0.05), "im.pga", {200, std::uint64_t(k)}), cloud.theta(0.05), cloud.beta());
  }
  EXPECT_NEAR(double(c.theta) / c.tries, 0.9, 3.0 * c.error());
  EXPECT_NEAR(double(c.curve) / c.tries, 0.9, 3.0 * c.error());
  EXPECT_NEAR(double(c.beta) / c.tries, 0.9, 3.0 * c.error());
}

TEST(Bootstrap, BandsOfStripesHoldTheTruthNineTimesInTen) {
  Coverage c;
  RandomStream random(32);
  for (int k = 0; k < 300; ++k) {
    const CampaignTable table =
        test::table_of(test::draw_stripes({1.0, 1.5, 2.0, 2.5, 3.2, 4.5}, 40, 2.5, 0.45, random));
    const Fragility f = assess(table, "bridge", limit(1.0), "im.pga", {200, std::uint64_t(k)});
    ASSERT_EQ(f.chosen.method, Method::counts);
    ASSERT_EQ(f.levels.size(), 6u);
    c.add(f, 2.5, 0.45);
  }
  EXPECT_NEAR(double(c.theta) / c.tries, 0.9, 3.0 * c.error());
  EXPECT_NEAR(double(c.curve) / c.tries, 0.9, 3.0 * c.error());
  EXPECT_NEAR(double(c.beta) / c.tries, 0.9, 3.0 * c.error());
}

/// Forty records scaled to six levels, each with a capacity of its own: 240 runs, but forty independent numbers. Bands
/// by records hold the truth; standard errors, which take runs for independent, are too small.
TEST(Bootstrap, KeepsTheRunsOfARecordTogether) {
  const std::vector<double> levels = {1.0, 1.5, 2.0, 2.5, 3.2, 4.5};
  RandomStream random(33);
  int held = 0, within_errors = 0;
  constexpr int tries = 300;
  for (int k = 0; k < tries; ++k) {
    std::vector<CloudRun> trials;
    for (std::size_t r = 0; r < 40; ++r) {
      const double capacity = 2.5 * std::exp(0.45 * random.normal());
      for (double level : levels) trials.push_back({r, level, level / capacity, false, level >= capacity});
    }
    const Fragility f = assess(test::table_of(trials), "bridge", limit(1.0), "im.pga", {200, std::uint64_t(k)});
    ASSERT_EQ(f.chosen.identified, Identified::yes);
    held += f.bootstrap.theta.low <= 2.5 && 2.5 <= f.bootstrap.theta.high;
    within_errors += std::abs(std::log(f.chosen.theta / 2.5)) < 1.6449 * f.chosen.ln_theta_std;
  }
  EXPECT_NEAR(double(held) / tries, 0.9, 3.0 * std::sqrt(0.09 / tries));
  EXPECT_LT(double(within_errors) / tries, 0.8);
}

TEST(Bootstrap, IsTheSameForASeedAndAnotherForAnother) {
  RandomStream random(1);
  const CampaignTable table = test::table_of(draw({}, 0.05, random));
  const Fragility a = assess(table, "bridge", limit(0.05), "im.pga", {100, 7});
  const Fragility b = assess(table, "bridge", limit(0.05), "im.pga", {100, 7});
  const Fragility c = assess(table, "bridge", limit(0.05), "im.pga", {100, 8});
  EXPECT_EQ(a.bootstrap.theta.low, b.bootstrap.theta.low);
  EXPECT_NE(a.bootstrap.theta.low, c.bootstrap.theta.low);
  EXPECT_EQ(a.bootstrap.replicates, 100);
  EXPECT_EQ(assess(table, "bridge", limit(0.05), "im.pga", {0, 7}).bootstrap.replicates, 0);
}

/// Three of twelve records beyond, only just overlapping: many resamples determine no curve, which is counted.
TEST(Bootstrap, CountsWhatIsNotIdentified) {
  std::vector<CloudRun> trials;
  for (std::size_t i = 0; i < 12; ++i)
    trials.push_back({i, 1.0 + double(i), test::none, i == 7 || i >= 10, i == 7 || i >= 10});
  const Fragility f =
      assess(test::table_of(trials), "bridge", {std::string("falls"), collapse_demand, 0.0, ""}, "im.pga", {500, 1});
  EXPECT_EQ(f.chosen.method, Method::counts);
  EXPECT_EQ(f.bootstrap.replicates, 500);
  EXPECT_GT(f.bootstrap.unidentified, 100);
  EXPECT_LT(f.bootstrap.unidentified, 400);
}

/// What each status comes to.
TEST(Fragility, RunsWithoutAResultAreLeftOutAndCounted) {
  RandomStream random(2);
  CampaignTable table = test::table_of(draw({.runs = 20}, 0.05, random));
  table.runs[0].status = RunStatus::failed;
  table.runs[1].status = RunStatus::missing;
  table.columns[0].values[2] = test::none;
  table.columns[1].values[3] = test::none;
  table.runs[4].status = RunStatus::collapsed;
  table.columns[1].values[4] = test::none;
  table.columns[1].values[5] = -0.06;  // a residual to the left
  table.columns[1].values[6] = 0.0;
  table.runs[7].case_name = "another";
  const SelectedRuns s = select(table, "bridge", limit(0.05), "im.pga");
  EXPECT_EQ(s.trials.size(), 15u);
  EXPECT_EQ(s.failed, 1u);
  EXPECT_EQ(s.missing, 1u);
  EXPECT_EQ(s.no_im, 1u);
  EXPECT_EQ(s.no_demand, 1u);
  EXPECT_EQ(s.collapsed, 1u);
  EXPECT_EQ(s.zero_demands, 1u);
  EXPECT_TRUE(s.trials[0].collapsed && s.trials[0].beyond);
  EXPECT_TRUE(s.trials[1].beyond);
  EXPECT_EQ(s.records.size(), 15u);
  EXPECT_EQ(select(table, "nobody", limit(0.05), "im.pga").trials.size(), 0u);
}

/// A cloud of which no run gets there: its line reaches the threshold all the same, counts do not.
TEST(Fragility, TheOtherMethodIsThereForComparison) {
  RandomStream random(4);
  const CampaignTable table = test::table_of(draw({}, 10.0, random));
  const Fragility f = assess(table, "bridge", limit(10.0), "im.pga", {50, 1});
  EXPECT_EQ(f.chosen.method, Method::cloud);
  EXPECT_EQ(f.chosen.identified, Identified::yes);
  EXPECT_EQ(f.other.method, Method::counts);
  EXPECT_EQ(f.other.identified, Identified::none_beyond);
  EXPECT_GT(f.chosen.theta, 6.0);
}

TEST(Fragility, WithoutAnyResultThereIsNoCurve) {
  CampaignTable table = test::table_of({});
  table.runs.push_back(test::run_of("a", "bridge", "r", RunStatus::failed));
  for (NumberColumn& c : table.columns) c.values.push_back(test::none);
  const Fragility f = assess(table, "bridge", limit(0.05), "im.pga");
  EXPECT_EQ(f.chosen.identified, Identified::no_runs);
  EXPECT_TRUE(f.curve.empty());
  EXPECT_EQ(f.selection.failed, 1u);
}

TEST(Fragility, LimitStatesAreChecked) {
  RandomStream random(4);
  const CampaignTable table = test::table_of(draw({}, 10.0, random));
  const auto error = [&](const LimitState& l) {
    try {
      check_limit(table, l, "campaign.json");
    } catch (const InputError& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  EXPECT_EQ(error(limit(0.05)), "");
  EXPECT_EQ(error({std::string("falls"), collapse_demand, 0.0, ""}), "");
  EXPECT_NE(error(limit(0.0)).find("threshold of limit state 'damage' is 0. It must be above 0"), std::string::npos);
  EXPECT_NE(error({std::string("d"), std::string("edp.y"), 1.0, ""}).find("'d': table.csv: there is no column 'edp.y'"),
            std::string::npos);
  EXPECT_NE(error({std::string("d"), std::string("im.pga"), 1.0, ""}).find("the demand of limit state 'd' is 'im.pga'"),
            std::string::npos);
  EXPECT_NE(error({std::string("d"), std::string("edp.x"), 1.0, std::string("bridg")}).find("did you mean 'bridge'"),
            std::string::npos);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
