// The road: what of a rectangle lies on which blocks and nodes. Sums and moments are those of the rectangle.
#include "geometry/road.h"

#include <gtest/gtest.h>

#include <cmath>

#include "geometry/generator.h"
#include "solver/base/error.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

Assembly bridge(const std::string& backfill, std::map<std::string, double> values) {
  const Generator& generator = find_generator("bridge");
  GeneratorInput in = default_input(generator);
  in.choices["backfill"] = backfill;
  for (const auto& [key, value] :
       std::map<std::string, double>{{"width", 5.0}, {"block_scale", 2.0}, {"fill_edge", 0.9}})
    in.values[key] = value;
  for (const auto& [key, value] : values) in.values[key] = value;
  return generator.build(in);
}

/// Area in plan and its first moments about the origin, m2 and m3.
Vec3 moments(const Assembly& assembly, const RoadShare& share) {
  Vec3 sum = Vec3::Zero();
  for (const RoadShare::OfBlock& of : share.blocks) sum += of.area * Vec3(of.centre.x(), of.centre.y(), 1.0);
  for (const RoadShare::OfNode& of : share.nodes) {
    const Vec3& at = assembly.fill.nodes[std::size_t(of.node)];
    sum += of.area * Vec3(at.x(), at.y(), 1.0);
  }
  return sum;
}

void expect_exact(const Assembly& assembly, const RoadArea& area) {
  const RoadShare share = Road(assembly).under(area);
  const Vec3 sum = moments(assembly, share),
             whole = area.area() * Vec3(0.5 * (area.x0 + area.x1), 0.5 * (area.y0 + area.y1), 1.0);
  const double tolerance = 1e-12 * area.area() * 20.0;  // of places up to 20 m away
  EXPECT_NEAR(share.area, area.area(), tolerance);
  for (int c = 0; c < 3; ++c) EXPECT_NEAR(sum[c], whole[c], tolerance);
}

const RoadArea wheel = {5.137, 5.539, -0.931, -0.611};
const RoadArea lane = {3.21, 14.4, -2.1, 1.87};  // over the walls too

TEST(Road, BearsAPressureWithItsSumAndItsMoments) {
  for (const char* backfill : {"rigid", "deformable"})
    for (const double gradient : {0.0, 3.0})
      for (const double skew : {0.0, 25.0}) {
        SCOPED_TRACE(std::string(backfill) + ", gradient " + std::to_string(gradient) + ", skew " +
                     std::to_string(skew));
        const Assembly assembly = bridge(backfill, {{"gradient", gradient}, {"skew", skew}});
        expect_exact(assembly, wheel);
        expect_exact(assembly, lane);
      }
}

TEST(Road, IsNotUnderWhatStandsOnIt) {
  for (const char* backfill : {"rigid", "deformable"}) {
    const Assembly plain = bridge(backfill, {});
    const Assembly beam = bridge(backfill, {{"beam.length", 1.0}, {"beam.at", 0.5}});
    const double middle = 4.0 + 0.5 * 8.0;
    EXPECT_NEAR(Road(beam).under({middle - 0.5, middle + 0.5, -1.0, 1.0}).area, 0.0, 1e-9);
    EXPECT_NEAR(Road(beam).under({middle - 1.0, middle, -1.0, 1.0}).area, 1.0, 1e-9);
    // The walls between fill and parapet belong to the road, what is under the parapets does not.
    const RoadArea extent = Road(plain).extent();
    EXPECT_NEAR(Road(plain).under(extent).area, 16.0 * (5.0 - 2.0 * 0.35), 1e-9);
  }
}

TEST(Road, NeedsAFillOrADeck) {
  const Assembly bare = bridge("none", {});
  EXPECT_THROW(Road{bare}, InputError);
  Assembly named = bare;
  for (std::size_t i = 0; i < named.blocks.size(); ++i)
    if (named.blocks[i].component == Component::spandrel) named.groups["deck"].push_back(std::int64_t(i));
  EXPECT_GT(Road(named).under(Road(named).extent()).area, 1.0);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
