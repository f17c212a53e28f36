// The page of a rating, made of numbers that nobody computed.
#include "tools/rate/rate_page.h"

#include <gtest/gtest.h>

#include "tools/rate/rate_report.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

RateRequest one_axle() {
  RateRequest request;
  request.vehicles = {
      parse_vehicle("[vehicle]\ntitle = \"a\"\nsource = \"b\"\nkind = \"road\"\ntrack = 2.0\nwheel = [0.3, 0.4]\n"
                    "[[axle]]\nx = 0\nload = 1e5\n",
                    "axle.toml")};
  request.most = 14.0;
  return request;
}

RatedPlace rated(double x, bool found, double factor) {
  RatedPlace at;
  at.place = {x, 0.0, true};
  at.found = found, at.factor = factor;
  return at;
}

std::size_t count(const std::string& text, const std::string& piece) {
  std::size_t found = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++found;
  return found;
}

/// Bands have paths too, so the triangles are those that a chart with limits alone does not have.
TEST(InfluenceChart, TellsLowerBoundsFromLimits) {
  const RateRequest request = one_axle();
  Rating rating;
  rating.spans = {{0, 0.0, 4.0}};
  rating.worst = {0};
  rating.places = {rated(1.0, true, 2.0), rated(2.0, true, 14.0), rated(3.0, true, 14.0)};
  const std::string limits = influence_chart(rating, request);
  EXPECT_EQ(count(limits, "<circle"), 3u) << limits;
  EXPECT_EQ(count(limits, "lower bound"), 0u) << limits;
  rating.places[1].found = rating.places[2].found = false;
  const std::string bounds = influence_chart(rating, request);
  EXPECT_EQ(count(bounds, "<circle"), 1u) << bounds;
  EXPECT_EQ(count(bounds, "lower bound: no limit found"), 1u) << bounds;
  EXPECT_EQ(count(bounds, "<path"), count(limits, "<path") + 3) << "two triangles, and one in the legend";
}

TEST(RatePage, SaysHowManyPositionsAreMissing) {
  const RateRequest request = one_axle();
  Rating rating;
  rating.spans = {{0, 0.0, 4.0}};
  rating.worst = {0};
  rating.places = {rated(1.0, true, 2.0), rated(2.0, true, 3.0)};
  const std::string missing = "interrupted after 2 of 5 positions";
  for (const std::size_t planned : {2u, 5u}) {
    rating.planned = planned;
    const std::size_t said = planned == 5 ? 1 : 0;
    EXPECT_EQ(count(rate_page(rating, request, RatePageWords()), missing), said);
    EXPECT_EQ(count(rating_text(rating, request), missing), said);
    const nlohmann::json json = rating_json(rating, request);
    EXPECT_EQ(json["complete"], planned == 2);
    EXPECT_EQ(json["places_done"], 2);
    EXPECT_EQ(json["places_planned"], planned);
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
