// Hinges of an arch, from how its stones have turned.
#include "solver/statics/hinges.h"

#include "geometry/generator.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Nine voussoirs, 0.2 m thick, of mean radius 2 m; the springings follow as blocks 9 and 10.
Assembly semicircle() {
  return generated("arch", {{"mean_radius", 2.0}, {"thickness", 0.2}, {"voussoirs", 9}});
}

Snapshot turned(const Assembly& assembly, const std::vector<double>& angles) {
  Snapshot snapshot;
  for (const double angle : angles) snapshot.rotation.emplace_back(Eigen::AngleAxisd(angle, Vec3::UnitY()));
  snapshot.rotation.resize(assembly.blocks.size(), Eigen::Quaterniond::Identity());
  return snapshot;
}

TEST(Hinges, OpenWhereTheArchTurns) {
  const Assembly assembly = semicircle();
  // Both halves lean inwards; at the crown two joints open below.
  const double a = 0.01;
  const auto hinges = find_hinges(assembly, turned(assembly, {a, a, a, a, 0.4 * a, -a, -a, -a, -a}));
  ASSERT_EQ(hinges.size(), 3u);
  EXPECT_EQ(std::pair(hinges[0].a, hinges[0].b), (std::pair<std::int64_t, std::int64_t>(0, 9)));
  EXPECT_EQ(hinges[0].edge, "intrados");
  EXPECT_NEAR((hinges[0].place - Vec3(0.2, 0.0, 0.0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR(hinges[0].turn, a, 1e-6);
  EXPECT_EQ(std::pair(hinges[1].a, hinges[1].b), (std::pair<std::int64_t, std::int64_t>(4, 5)));
  EXPECT_EQ(hinges[1].edge, "extrados");
  EXPECT_NEAR(hinges[1].turn, 1.4 * a, 1e-6);
  EXPECT_EQ(std::pair(hinges[2].a, hinges[2].b), (std::pair<std::int64_t, std::int64_t>(8, 10)));
  EXPECT_EQ(hinges[2].edge, "intrados");
}

TEST(Hinges, NoneWhereLittleTurns) {
  const Assembly assembly = semicircle();
  EXPECT_TRUE(find_hinges(assembly, turned(assembly, {5e-4})).empty());
  // What turns by less than the share of the largest is not one.
  const auto hinges = find_hinges(assembly, turned(assembly, {0.0, 0.0, 0.1, 0.1, 0.1, 0.105, 0.105, 0.105, 0.105}));
  ASSERT_EQ(hinges.size(), 2u);
  EXPECT_EQ(hinges[0].edge, hinges[1].edge == "intrados" ? "extrados" : "intrados");
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
