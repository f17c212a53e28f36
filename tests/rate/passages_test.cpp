// How series of passages are judged, where vehicles are put, and what a strip is made of.
#include "tools/rate/passages.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "tests/folder.h"
#include "tools/rate/strip.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Displacements whose increments are those of a geometric series.
std::vector<AfterPassage> geometric(int passages, double first, double ratio) {
  std::vector<AfterPassage> after(1);
  for (int n = 0; n < passages; ++n) {
    after.push_back(after.back());
    after.back().largest += first * std::pow(ratio, n);
  }
  return after;
}

TEST(Passages, SettleOrGrowByTheirIncrements) {
  constexpr double none = 1e-6;
  EXPECT_EQ(judge(geometric(12, 1e-3, 0.8), none), PassageEnd::settles);
  EXPECT_EQ(judge(geometric(12, 1e-3, 0.9), none), PassageEnd::undecided);
  EXPECT_EQ(judge(geometric(12, 1e-3, 0.98), none), PassageEnd::grows);
  EXPECT_EQ(judge(geometric(12, 1e-3, 1.1), none), PassageEnd::grows);
  EXPECT_EQ(judge(geometric(12, 1e-7, 1.0), none), PassageEnd::settles);  // less than counts
  EXPECT_EQ(judge(geometric(2, 1e-3, 1.0), none), PassageEnd::undecided);
  std::vector<AfterPassage> slides = geometric(12, 0.0, 1.0);  // at one place, while joints slide on
  for (std::size_t n = 0; n < slides.size(); ++n) slides[n].slips = 1e-4 * double(n);
  EXPECT_EQ(judge(slides, none), PassageEnd::grows);
}

TEST(Passages, SayUpToWhichFactorAllSettle) {
  const auto series = [](double factor, PassageEnd end, int passages) {
    return PassageSeries{factor, std::vector<AfterPassage>(std::size_t(passages) + 1), end};
  };
  const std::string text = passages_text({series(0.3, PassageEnd::settles, 9), series(0.5, PassageEnd::grows, 9),
                                          series(0.7, PassageEnd::settles, 9), series(0.9, PassageEnd::collapses, 2)},
                                         1.0);
  EXPECT_EQ(text.find("Over 9 passages, displacements settle with factors up to 0.3 (30 % of"), 0u) << text;
  EXPECT_NE(text.find("with 0.5 they do not"), std::string::npos) << text;
  const std::string none = passages_text({series(0.3, PassageEnd::collapses, 0), series(0.5, PassageEnd::grows, 9)}, 1);
  EXPECT_EQ(none.find("Over 9 passages, displacements settle with none of the factors; with 0.3"), 0u) << none;
  const std::string first = passages_text({series(0.3, PassageEnd::collapses, 0)}, 1.0);
  EXPECT_EQ(first.find("Over 1 passage, displacements settle with none of the factors; with 0.3"), 0u) << first;
}

Vehicle two_axles() {
  return parse_vehicle(
      "[vehicle]\ntitle = \"a\"\nsource = \"b\"\nkind = \"road\"\ntrack = 2.0\nwheel = [0.3, 0.4]\n"
      "[[axle]]\nx = 0\nload = 1e5\n[[axle]]\nx = 2\nload = 5e4\n",
      "lorry.toml");
}

TEST(Fronts, HaveEveryAxleOverTheSpansOnce) {
  const std::vector<SpanExtent> spans = {{0, 4.0, 10.0}, {1, 12.0, 18.0}};
  for (const bool right : {true, false}) {
    const std::vector<double> at = fronts(two_axles(), spans, right, 0.5);
    ASSERT_EQ(at.size(), 31u);  // 16 m in steps of half a metre, without both ends
    EXPECT_NEAR(at.front(), right ? 4.5 : 2.5, 1e-12);
    EXPECT_NEAR(at.back(), right ? 19.5 : 17.5, 1e-12);
  }
}

/// A vehicle whose worst place looks to the left drives to the left: from its first place on the right to its last.
TEST(Fronts, OfAPassageAreInTheOrderOfTravel) {
  const std::vector<SpanExtent> spans = {{0, 4.0, 10.0}, {1, 12.0, 18.0}};
  PassageRequest request;
  request.rate.vehicles = {two_axles()};
  request.places = 4;
  for (const bool right : {true, false}) {
    request.towards_right = right;
    const std::vector<double> at = fronts_of_passage(spans, request);
    ASSERT_EQ(at.size(), 4u);
    // All axles are off the bridge at 4 and 20 m (to the right), and at 18 and 2 m (to the left).
    for (int k = 0; k < 4; ++k) {
      EXPECT_NEAR(at[std::size_t(k)], right ? 6.0 + 4.0 * k : 16.0 - 4.0 * k, 2e-3);
    }
  }
}

TEST(PlacedVehicle, HasItsAxlesWhereItDrives) {
  const auto middle = [](const RoadLoad& load) { return 0.5 * (load.area.x0 + load.area.x1); };
  const std::vector<RoadLoad> right = loads_of(two_axles(), {7.0, 0.5, true}),
                              left = loads_of(two_axles(), {7.0, 0.5, false});
  ASSERT_EQ(right.size(), 4u);
  EXPECT_NEAR(middle(right[0]), 7.0, 1e-12);
  EXPECT_NEAR(middle(right[2]), 5.0, 1e-12);
  EXPECT_NEAR(middle(left[2]), 9.0, 1e-12);
  double sum = 0.0;
  for (const RoadLoad& load : right) sum += load.pressure * load.area.area();
  EXPECT_NEAR(sum, 1.5e5, 1e-6);
  const std::vector<RoadLoad> strip = loads_on_strip(two_axles(), {7.0, 0.0, true}, 0.3, 3.0);
  sum = 0.0;
  for (const RoadLoad& load : strip) sum += load.pressure * load.area.area();
  EXPECT_NEAR(sum, 1.5e5 * 0.3 / 3.0, 1e-6);
}

/// A case that is a loading test is rated without it; what comes before the test stays.
TEST(LoadingTest, IsLeftOutWithItsBeam) {
  const Case c = read_case(std::string(VOUSSOIR_SOURCE_DIR) + "/cases/bridges/prestwood.toml");
  ASSERT_TRUE(is_loading_test(c));
  const Case without = without_loading_test(c);
  EXPECT_FALSE(is_loading_test(without));
  EXPECT_TRUE(without.settings.guides.empty());
  ASSERT_EQ(without.settings.stages.size(), 1u);
  EXPECT_EQ(without.settings.stages[0].kind, StageSettings::Kind::gravity);
  EXPECT_EQ(without.motions.size(), 1u);
  EXPECT_FALSE(make_assembly(without).groups.contains("load"));
  const Case strip = strip_case(c, 0.3);
  EXPECT_FALSE(is_loading_test(strip));
  EXPECT_EQ(strip.settings.stages.size(), 1u);
}

TEST(StripRemarks, CountEffects) {
  Case c = read_case(std::string(VOUSSOIR_SOURCE_DIR) + "/cases/bridges/prestwood.toml");
  for (const char* said : {"1 effect is left out", "2 effects are left out"}) {
    c.effects.emplace_back();
    const std::vector<std::string> remarks = strip_remarks(c);
    EXPECT_EQ(std::ranges::count(remarks, said), 1) << said;
  }
}

/// Everything but gravity is left out of the strip. The stages and guides of a loading test are not rated anyway.
TEST(StripRemarks, CountStagesAndGuides) {
  Case c = read_case(std::string(VOUSSOIR_SOURCE_DIR) + "/cases/bridges/prestwood.toml");
  const std::vector<std::string> none = strip_remarks(c);
  EXPECT_EQ(std::ranges::count_if(none, [](const std::string& text) { return text.find("stage") < text.size(); }), 0);
  c = without_loading_test(c);
  c.settings.stages.emplace_back().kind = StageSettings::Kind::free;
  c.motions.emplace_back();
  c.settings.guides.emplace_back();
  const std::vector<std::string> remarks = strip_remarks(c);
  EXPECT_EQ(std::ranges::count(remarks, "1 stage after gravity is left out"), 1);
  EXPECT_EQ(std::ranges::count(remarks, "1 guide is left out"), 1);
}

TEST(EffectiveWidth, IsWheelsAndACoverButNoMoreThanTheBridge) {
  EXPECT_NEAR(effective_width(2.0, 0.4, 10.0), 3.9, 1e-12);
  EXPECT_NEAR(effective_width(2.0, 0.4, 3.0), 3.0, 1e-12);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
