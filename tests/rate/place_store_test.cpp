// What an interrupted rating finds again.
#include "tools/rate/place_store.h"

#include <gtest/gtest.h>

#include "tests/folder.h"
#include "tools/ladder/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

RatedPlace rated_place(double x) {
  RatedPlace at;
  at.place = {x, 0.0, true};
  at.found = true, at.factor = 1.0 / 3.0, at.above = 0.4, at.local = true, at.fill_alone = true;
  at.spans = {2, 3}, at.share = 0.1, at.moving = "3 blocks", at.tries = 9, at.seconds = 0.7;
  return at;
}

RatedPlace not_rated(double x) {
  RatedPlace at;
  at.place = {x, 0.0, true};
  return at;
}

TEST(PlaceStore, RecallsWhatDependsOnNothingElse) {
  const Folder folder;
  const Case c = read_case(std::string(VOUSSOIR_SOURCE_DIR) + "/cases/bridges/prestwood.toml");
  Assembly assembly = ladder::generated("column", {{"blocks", 3}});
  RateRequest request;
  request.vehicles = {read_vehicle("cs454-normal-single")};
  const std::string files = folder / "places";
  const auto recalled = [&](double x) {
    RatedPlace at = not_rated(x);
    return PlaceStore(files, c, assembly, request).recall(at);
  };
  EXPECT_FALSE(recalled(3.0));
  PlaceStore(files, c, assembly, request).keep(rated_place(3.0));
  const RatedPlace kept = rated_place(3.0);
  RatedPlace at = not_rated(3.0);
  ASSERT_TRUE(PlaceStore(files, c, assembly, request).recall(at));
  EXPECT_EQ(std::tuple(at.found, at.factor, at.above, at.local, at.fill_alone, at.spans, at.share),
            std::tuple(kept.found, kept.factor, kept.above, kept.local, kept.fill_alone, kept.spans, kept.share));
  EXPECT_EQ(std::tuple(at.moving, at.tries, at.seconds), std::tuple(kept.moving, kept.tries, kept.seconds));
  EXPECT_EQ(std::tuple(at.vehicle, at.place.x), std::tuple(kept.vehicle, kept.place.x));
  EXPECT_FALSE(recalled(3.1));
  for (double* setting : {&request.most, &request.tolerance}) {
    *setting *= 2.0;
    EXPECT_FALSE(recalled(3.0));
    *setting /= 2.0;
  }
  for (LoadPatch& patch : request.vehicles[0].patches) patch.force *= 1.1;
  EXPECT_FALSE(recalled(3.0)) << "another vehicle";
  request.vehicles = {read_vehicle("cs454-normal-single")};
  EXPECT_TRUE(recalled(3.0));
  assembly.blocks[0].mass += 1.0;
  EXPECT_FALSE(recalled(3.0)) << "another assembly";
  assembly.blocks[0].mass -= 1.0;
  PlaceStore(files, c, assembly, request).clear();
  EXPECT_FALSE(recalled(3.0));
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
