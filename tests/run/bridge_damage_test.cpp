// Damage of bridges by what it does to their bearing.
#include "tools/run/bridge_damage.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <optional>

#include "io/case/case.h"
#include "io/vtk/grid.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

Assembly made(const std::string& bridge) {
  return make_assembly(parse_case("[bridge]\n" + bridge, "built.toml", CaseUse::geometry));
}

std::optional<BridgeFinding> found(const std::vector<BridgeFinding>& findings, const std::string& what) {
  const auto at = std::ranges::find(findings, what, &BridgeFinding::what);
  return at == findings.end() ? std::nullopt : std::optional(*at);
}

TEST(BridgeDamage, NothingMovedIsSound) {
  const Assembly assembly = made("generator = \"wall\"\n");
  const nlohmann::json json = bridge_damage_json(assembly, rest_snapshot(assembly));
  EXPECT_EQ(json["class"], "sound");
  EXPECT_TRUE(json["findings"].empty());
}

TEST(BridgeDamage, AWallThatMovedByAShareOfItsThickness) {
  const Assembly assembly = made("generator = \"wall\"\nthickness = 0.45\n");
  Snapshot snapshot = rest_snapshot(assembly);
  for (const auto& [share, grade] : {std::pair{0.01, 0u}, {0.03, 1u}, {0.2, 2u}, {0.4, 3u}, {1.1, 4u}}) {
    for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
      if (!assembly.blocks[i].fixed) snapshot.displacement[i].y() = share * 0.45;
    const std::optional<BridgeFinding> moved = found(bridge_findings(assembly, snapshot), "wall moved out");
    EXPECT_EQ(moved ? moved->grade : 0u, grade) << share;
  }
}

TEST(BridgeDamage, AStoneThatSlippedByAThirdOfItsDepth) {
  const Assembly assembly = made("generator = \"column\"\n");
  Snapshot snapshot = rest_snapshot(assembly);
  std::size_t top = 0;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    if (assembly.blocks[i].centroid.z() > assembly.blocks[top].centroid.z()) top = i;
  const Box box = block_box(assembly.blocks[top]);
  snapshot.displacement[top].x() = (box.high.x() - box.low.x()) / 3.0;
  const std::optional<BridgeFinding> seating = found(bridge_findings(assembly, snapshot), "seating lost");
  ASSERT_TRUE(seating);
  EXPECT_NEAR(seating->measure, 1.0 / 3.0, 1e-9);
  EXPECT_EQ(bridge_classes()[seating->grade], "serious");
}

TEST(BridgeDamage, HingesThatAlternateAreCounted) {
  const Assembly assembly =
      made("generator = \"arch\"\nmean_radius = 10.0\nthickness_ratio = 0.15\nembrace_angle = 157.5\nvoussoirs = 7\n");
  std::vector<std::size_t> stones;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    if (!assembly.blocks[i].fixed) stones.push_back(i);
  std::ranges::sort(stones, {}, [&](std::size_t i) { return assembly.blocks[i].centroid.x(); });
  ASSERT_EQ(stones.size(), 7u);
  Snapshot snapshot = rest_snapshot(assembly);
  // Turned by pieces of stones: joints between the pieces are hinges, on one side and the other by turns.
  const auto turn = [&](std::size_t from, std::size_t to, double by) {
    for (std::size_t k = from; k < to; ++k) snapshot.rotation[stones[k]] = Eigen::AngleAxisd(by, Vec3::UnitY());
  };
  turn(0, 2, 2e-3), turn(2, 5, -2e-3), turn(5, 7, 2e-3);
  const std::optional<BridgeFinding> hinges = found(bridge_findings(assembly, snapshot), "hinges");
  ASSERT_TRUE(hinges);
  EXPECT_EQ(hinges->measure, 4.0) << "at both springings and between the pieces";
  EXPECT_EQ(bridge_classes()[hinges->grade], "bearing lost");
}

TEST(BridgeDamage, AHingeAcrossAVaultOfSeveralStonesIsCounted) {
  const Assembly assembly = made(
      "generator = \"bridge\"\nwidth = 5.0\nvoussoir_width = 1.0\n\n"
      "[[bridge.span]]\nshape = \"semicircular\"\nclear_span = 6.0\nring_thickness = 0.5\n");
  std::map<std::int64_t, double> along;  // x of the voussoirs
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    if (assembly.blocks[i].component == Component::arch) along[std::int64_t(i)] = assembly.blocks[i].centroid.x();
  double crown = 0.0;
  for (const auto& [block, x] : along) crown += x / double(along.size());
  Snapshot snapshot = rest_snapshot(assembly);
  for (const auto& [block, x] : along)
    snapshot.rotation[std::size_t(block)] = Eigen::AngleAxisd(x < crown ? 2e-3 : -2e-3, Vec3::UnitY());
  const std::optional<BridgeFinding> hinges = found(bridge_findings(assembly, snapshot), "hinges");
  ASSERT_TRUE(hinges);
  EXPECT_EQ(hinges->measure, 1.0);
  EXPECT_EQ(bridge_classes()[hinges->grade], "slight");
  // Half the width that has not turned carries as before.
  for (const auto& [block, x] : along)
    if (assembly.blocks[std::size_t(block)].centroid.y() > 0.0)
      snapshot.rotation[std::size_t(block)] = Eigen::Quaterniond::Identity();
  EXPECT_FALSE(found(bridge_findings(assembly, snapshot), "hinges"));
}

TEST(BridgeDamage, CracksByTheirWidth) {
  const Assembly assembly = made("generator = \"wall\"\n");
  Snapshot snapshot = rest_snapshot(assembly);
  for (const auto& [width, grade] : {std::pair{2e-4, 0u}, {1e-3, 1u}, {5e-3, 2u}, {5e-2, 3u}}) {
    snapshot.patches[0].largest_opening = width;
    const std::optional<BridgeFinding> crack = found(bridge_findings(assembly, snapshot), "crack");
    EXPECT_EQ(crack ? crack->grade : 0u, grade) << width;
  }
  EXPECT_EQ(bridge_findings(assembly, snapshot).front().sentence().substr(0, 4), "wall");
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
