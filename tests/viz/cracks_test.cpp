// Cracks of joints whose opening is known, and the map of them.
#include "viz/crack_map/cracks.h"

#include <gtest/gtest.h>

#include <cmath>
#include <set>

#include "io/case/case.h"
#include "io/vtk/grid.h"
#include "solver/base/constants.h"
#include "tests/folder.h"
#include "tests/viz/noted_drawing.h"
#include "viz/crack_map/crack_files.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::expect_readable;
using test::Folder;
using test::Noted;

Assembly made(const std::string& bridge) {
  return make_assembly(parse_case("[bridge]\n" + bridge, "drawn.toml", CaseUse::geometry));
}

/// A wall of 6 × 6 blocks of 0.6 × 0.5 × 0.45 m in running bond, its corner at the origin.
Assembly wall() {
  return made(
      "generator = \"wall\"\nlength_blocks = 6\ncourses = 6\nblock_length = 0.6\nblock_height = 0.5\nthickness = "
      "0.45\n");
}

Assembly arch(int voussoirs, double degrees) {
  return made("generator = \"arch\"\nmean_radius = 10.0\nthickness_ratio = 0.1\nembrace_angle = " +
              std::to_string(degrees) + "\nvoussoirs = " + std::to_string(voussoirs) + "\n");
}

/// The joint whose middle is nearest to a point.
std::size_t joint_at(const Assembly& assembly, const Vec3& at) {
  std::size_t best = 0;
  double least = 1e300;
  for (std::size_t i = 0; i < assembly.joints.size(); ++i)
    if (const double far = (polygon_centroid(assembly.joints[i].polygon) - at).norm(); far < least)
      least = far, best = i;
  return best;
}

/// Opens a joint, m; half of it closes again.
void open(Snapshot& snapshot, std::size_t joint, double opening, double slip = 0.0) {
  PatchSnapshot& p = snapshot.patches[joint];
  p.largest_opening = opening, p.opening = 0.5 * opening;
  p.largest_slip = p.slip = slip;
}

double middle_y(const Assembly& assembly) {
  return polygon_centroid(assembly.joints.front().polygon).y();
}

TEST(Cracks, OneOpenedJointIsOneCrack) {
  const Assembly assembly = wall();
  Snapshot snapshot = rest_snapshot(assembly);
  const std::size_t bed = joint_at(assembly, {1.05, middle_y(assembly), 1.0});
  ASSERT_GT(std::abs(assembly.joints[bed].normal.z()), 0.99);
  open(snapshot, bed, 2e-3, 0.5e-3);
  const std::vector<Crack> cracks = find_cracks(assembly, snapshot);
  ASSERT_EQ(cracks.size(), 1u);
  const Crack& crack = cracks.front();
  EXPECT_EQ(crack.number, 1);
  EXPECT_EQ(crack.joints, std::vector<std::size_t>{bed});
  EXPECT_NEAR(crack.length, 0.3, 1e-9);
  EXPECT_NEAR(crack.area, 0.3 * 0.45, 1e-9);
  EXPECT_DOUBLE_EQ(crack.width(), 2e-3);
  EXPECT_DOUBLE_EQ(crack.now.opening, 1e-3);
  EXPECT_DOUBLE_EQ(crack.ever.slip, 0.5e-3);
  EXPECT_EQ(crack.direction, "horizontal");
  EXPECT_EQ(crack.where, "wall, x 0.9 to 1.2 m, z 1.0 m");
  EXPECT_TRUE(find_cracks(assembly, snapshot, 2.1e-3).empty());
  EXPECT_EQ(find_cracks(assembly, snapshot, 0.9e-3, CrackState::now).size(), 1u);
  EXPECT_TRUE(find_cracks(assembly, snapshot, 1.1e-3, CrackState::now).empty());
}

TEST(Cracks, JointsThatTouchMakeOneSteppedCrack) {
  const Assembly assembly = wall();
  Snapshot snapshot = rest_snapshot(assembly);
  const double y = middle_y(assembly);
  // Heads of courses 0, 1 and 2, and the beds between.
  std::set<std::size_t> path;
  for (const auto& [x, z] : {std::pair{0.6, 0.25}, {1.5, 0.75}, {2.4, 1.25}})
    path.insert(joint_at(assembly, {x, y, z}));
  for (const auto& [from, z] : {std::pair{0.6, 0.5}, {1.5, 1.0}})
    for (int k = 0; k < 3; ++k) path.insert(joint_at(assembly, {from + 0.15 + 0.3 * k, y, z}));
  ASSERT_EQ(path.size(), 9u);
  for (const std::size_t joint : path) open(snapshot, joint, 4e-3);
  open(snapshot, joint_at(assembly, {3.15, y, 2.5}), 1e-3);  // far from it
  const std::vector<Crack> cracks = find_cracks(assembly, snapshot);
  ASSERT_EQ(cracks.size(), 2u);
  EXPECT_EQ(cracks[0].joints, std::vector<std::size_t>(path.begin(), path.end()));
  EXPECT_TRUE(cracks[0].direction.starts_with("stepped, ")) << cracks[0].direction;
  const double degrees = std::stod(cracks[0].direction.substr(9));
  EXPECT_NEAR(degrees, std::atan2(1.5, 1.8) * 180.0 / pi, 5.0) << "from end to end";
  EXPECT_NEAR(cracks[0].length, std::hypot(1.5, 1.8), 0.03 * std::hypot(1.5, 1.8));
  EXPECT_EQ(cracks[1].joints.size(), 1u);
}

TEST(Cracks, ThroughAMassRunAsTheirPlaneDoes) {
  Assembly assembly = wall();
  for (Block& block : assembly.blocks) block.component = Component::backing;
  const double y = middle_y(assembly);
  for (const auto& [at, direction] : {std::pair{Vec3(0.6, y, 0.25), "vertical"}, {Vec3(1.05, y, 1.0), "horizontal"}}) {
    Snapshot snapshot = rest_snapshot(assembly);
    open(snapshot, joint_at(assembly, at), 1e-3);
    const std::vector<Crack> cracks = find_cracks(assembly, snapshot);
    ASSERT_EQ(cracks.size(), 1u);
    EXPECT_EQ(cracks[0].direction, direction);
  }
}

TEST(Cracks, AnAngleIsNoNetwork) {
  const Assembly assembly = wall();
  Snapshot snapshot = rest_snapshot(assembly);
  const double y = middle_y(assembly);
  open(snapshot, joint_at(assembly, {0.6, y, 0.25}), 1e-3);
  for (const double x : {0.75, 1.05}) open(snapshot, joint_at(assembly, {x, y, 0.5}), 1e-3);
  const std::vector<Crack> cracks = find_cracks(assembly, snapshot);
  ASSERT_EQ(cracks.size(), 1u);
  EXPECT_EQ(cracks[0].direction, "stepped, 40°") << "half a metre high, 0.6 m long";
  EXPECT_NEAR(cracks[0].length, std::hypot(0.5, 0.6), 1e-9);
}

TEST(Cracks, NamePartsAsEffectsDo) {
  EXPECT_EQ(part_words({Component::spandrel, 0}), "spandrel y-");
  EXPECT_EQ(part_words({Component::spandrel, 1}), "spandrel y+");
  EXPECT_EQ(part_words({Component::spandrel, 2}), "spandrel internal");
  EXPECT_EQ(part_words({Component::parapet, 0}), "parapet y-");
  EXPECT_EQ(part_words({Component::arch, 2}), "arch 2");
  EXPECT_EQ(part_words({Component::abutment, 0}), "abutment left");
}

TEST(Cracks, ManyJointsOfOnePartAreANetwork) {
  for (const Component component : {Component::wall, Component::block}) {
    Assembly assembly = wall();
    for (Block& block : assembly.blocks) block.component = component, block.part = 0;
    Snapshot snapshot = rest_snapshot(assembly);
    for (std::size_t i = 0; i < assembly.joints.size(); ++i) open(snapshot, i, 2e-3);
    const std::vector<Crack> cracks = find_cracks(assembly, snapshot);
    ASSERT_EQ(cracks.size(), 1u);
    EXPECT_EQ(cracks[0].joints.size(), assembly.joints.size());
    EXPECT_EQ(cracks[0].direction, "network");
    EXPECT_TRUE(cracks[0].where.starts_with(component == Component::wall ? "wall, x" : "blocks, x")) << cracks[0].where;
  }
}

TEST(Cracks, AJointThatSlidIsACrackToo) {
  const Assembly assembly = wall();
  Snapshot snapshot = rest_snapshot(assembly);
  open(snapshot, joint_at(assembly, {1.05, middle_y(assembly), 1.0}), 0.0, 5e-3);
  const std::vector<Crack> cracks = find_cracks(assembly, snapshot);
  ASSERT_EQ(cracks.size(), 1u);
  EXPECT_TRUE(cracks[0].ever.slides());
  EXPECT_DOUBLE_EQ(cracks[0].width(), 5e-3);
}

TEST(Cracks, HingesOfAnArchLieAcrossTheBarrelAtTheirPlace) {
  const Assembly assembly = arch(20, 180.0);
  Snapshot snapshot = rest_snapshot(assembly);
  // At 45°, 90° and 135° from the left springing: shares (1 − cos) / 2 of the span of the joint's middle.
  const Vec3 centre(0.5 * (block_box(assembly.blocks.front()).low.x() + block_box(assembly.blocks.back()).high.x()),
                    0.0, 0.0);
  const std::vector<Intrados> vaults = find_intrados(measure(assembly));
  ASSERT_EQ(vaults.size(), 1u);
  const double middle = 0.5 * (vaults[0].profile.front().x() + vaults[0].profile.back().x());
  for (const double degrees : {45.0, 90.0, 135.0}) {
    const double t = degrees * pi / 180.0;
    open(snapshot, joint_at(assembly, {middle - 10.0 * std::cos(t), middle_y(assembly), 10.0 * std::sin(t)}),
         1e-3 * degrees / 45.0);
  }
  const std::vector<Crack> cracks = find_cracks(assembly, snapshot);
  ASSERT_EQ(cracks.size(), 3u);
  // Span of the intrados: 19 m; of the joints' middles: a circle of 10 m.
  EXPECT_TRUE(cracks[0].where.starts_with("arch 0 at 0.87 of its span")) << cracks[0].where;
  EXPECT_TRUE(cracks[1].where.starts_with("arch 0 at 0.50 of its span")) << cracks[1].where;
  EXPECT_TRUE(cracks[2].where.starts_with("arch 0 at 0.13 of its span")) << cracks[2].where;
  for (const Crack& crack : cracks) {
    EXPECT_EQ(crack.direction, "across the barrel");
    EXPECT_NEAR(crack.length, 1.0, 1e-6) << "the width of the arch";
  }
}

TEST(Intrados, OfASemicircleIsAsLongAsItsChords) {
  for (const int voussoirs : {9, 61}) {
    const std::vector<Intrados> vaults = find_intrados(measure(arch(voussoirs, 180.0)));
    ASSERT_EQ(vaults.size(), 1u);
    const double radius = 9.5, half = pi / (2.0 * voussoirs);
    EXPECT_NEAR(vaults[0].length(), voussoirs * 2.0 * radius * std::sin(half), 1e-6);
    if (voussoirs == 61) {
      EXPECT_NEAR(vaults[0].length(), pi * radius, 2e-4 * pi * radius);
    }
  }
}

constexpr const char* kSkewBridge = R"(generator = "bridge"
width = 5.0
skew = 25.0
block_scale = 2.0
[[bridge.span]]
shape = "segmental"
clear_span = 8.0
rise = 2.2
ring_thickness = 0.4
)";

TEST(Intrados, UnrollingKeepsLengthsOfASkewVault) {
  const Assembly assembly = made(kSkewBridge);
  const std::vector<Intrados> vaults = find_intrados(measure(assembly));
  ASSERT_EQ(vaults.size(), 1u);
  std::size_t edges = 0;
  for (const Block& block : assembly.blocks) {
    if (block.component != Component::arch) continue;
    for (const Polyhedron& cell : block.cells)
      for (std::size_t f = 0; f < cell.faces.size(); ++f) {
        const Polygon face = face_polygon(cell, int(f));
        if (!std::ranges::all_of(face, [&](const Vec3& x) { return vaults[0].unrolled(x).off < 1e-6; })) continue;
        for (std::size_t k = 0; k < face.size(); ++k, ++edges) {
          const auto a = vaults[0].unrolled(face[k]), b = vaults[0].unrolled(face[(k + 1) % face.size()]);
          EXPECT_NEAR(std::hypot(b.s - a.s, b.w - a.w), (face[(k + 1) % face.size()] - face[k]).norm(), 1e-6);
        }
      }
  }
  EXPECT_GT(edges, 100u);
}

TEST(CrackMaps, ShowEachCrackWhereItsSurfaceIsSeen) {
  const Assembly assembly = wall();
  Snapshot snapshot = rest_snapshot(assembly);
  open(snapshot, joint_at(assembly, {1.05, middle_y(assembly), 1.0}), 2e-3);
  const std::vector<Crack> cracks = find_cracks(assembly, snapshot);
  const CrackedAssembly cracked{assembly, cracks, fallen_blocks(assembly, snapshot)};
  const CrackView front = seen_view(cracked, seen_from_front(), {}, "front");
  const CrackView behind = seen_view(cracked, seen_from_behind(), {}, "behind");
  const CrackView above = seen_view(cracked, seen_from_above(), {}, "above");
  ASSERT_EQ(front.traces.size(), 1u);
  ASSERT_EQ(behind.traces.size(), 1u);
  EXPECT_TRUE(above.traces.empty()) << "it is inside";
  const auto& [a, b] = front.traces[0].line;
  EXPECT_NEAR(std::min(a.x(), b.x()), 0.9, 1e-3);
  EXPECT_NEAR(std::max(a.x(), b.x()), 1.2, 1e-3);
  EXPECT_NEAR(a.y(), 1.0, 1e-3);
  EXPECT_NEAR(std::min(behind.traces[0].line.first.x(), behind.traces[0].line.second.x()), -1.2, 1e-3) << "mirrored";
}

TEST(CrackMaps, SayWhatTheyShow) {
  const Assembly assembly = wall();
  Snapshot snapshot = rest_snapshot(assembly);
  const auto said = [&](double threshold) {
    const CrackMap map(assembly, snapshot, {"a wall", "test"}, threshold);
    Noted noted;
    map.draw(noted, CrackState::ever);
    expect_readable(map, noted, "wall");
    return noted.all();
  };
  EXPECT_NE(said(3e-4).find("No joint has opened or slid by 0.3 mm or more."), std::string::npos);
  open(snapshot, joint_at(assembly, {1.05, middle_y(assembly), 1.0}), 2e-3);
  const std::string text = said(3e-4);
  EXPECT_NE(text.find("1 crack of 1 joint, at least 0.3 mm wide"), std::string::npos) << text;
  std::string running = text;
  std::ranges::replace(running, '\n', ' ');
  EXPECT_NE(running.find("No intrados: the model has no vaults (stones of the component arch with a span). Drawn"),
            std::string::npos)
      << text;
  EXPECT_NE(text.find("\nx, m\n"), std::string::npos) << text;
  EXPECT_NE(text.find("30 mm and more"), std::string::npos) << text;
  EXPECT_NE(text.find("\nx, m\n"), std::string::npos) << text;
  EXPECT_NE(said(5e-3).find("5 to 10 mm"), std::string::npos);
}

TEST(CrackMaps, OfABridgeHaveItsIntradosAndNoTextOnAnother) {
  const Assembly assembly = made(kSkewBridge);
  Snapshot snapshot = rest_snapshot(assembly);
  for (std::size_t i = 0; i < assembly.joints.size(); ++i)
    open(snapshot, i, i % 3 == 0 ? 1e-5 * double(i % 2000) : 0.0, i % 5 == 0 ? 8e-3 : 0.0);
  snapshot.displacement.back().z() -= 2.0;
  const CrackMap map(assembly, snapshot, {"skew", "test"});
  Noted noted;
  map.draw(noted, CrackState::now);
  EXPECT_TRUE(noted.says("Intrados of arch 0, unrolled"));
  EXPECT_TRUE(noted.says("fallen stones") || assembly.blocks.back().fixed);
  expect_readable(map, noted, "skew");
}

TEST(CrackMaps, AreWrittenInEachFormat) {
  const Assembly assembly = wall();
  Snapshot snapshot = rest_snapshot(assembly);
  open(snapshot, joint_at(assembly, {1.05, middle_y(assembly), 1.0}), 1.5e-3);
  const CrackMap map(assembly, snapshot, {"a wall", "test"});
  EXPECT_TRUE(map.has_changed()) << "half of it has closed: another class";
  const Folder folder;
  const std::vector<std::string> files =
      write_crack_map(map, {CrackState::ever, CrackState::now}, {"svg", "pdf", "png"}, folder / "in/map");
  EXPECT_EQ(files.size(), 5u);
  EXPECT_TRUE(test::bytes_of(folder / "in/map.svg").starts_with("<svg "));
  EXPECT_NE(test::bytes_of(folder / "in/map.svg"), test::bytes_of(folder / "in/map_now.svg"));
  const std::string pdf = test::bytes_of(folder / "in/map.pdf");
  EXPECT_TRUE(pdf.starts_with("%PDF-"));
  EXPECT_NE(pdf.find("/Count 2"), std::string::npos);
}

TEST(Cracks, TableHasARowForEach) {
  const Assembly assembly = wall();
  Snapshot snapshot = rest_snapshot(assembly);
  open(snapshot, joint_at(assembly, {1.05, middle_y(assembly), 1.0}), 2e-3);
  const std::string table = crack_table(find_cracks(assembly, snapshot));
  EXPECT_EQ(std::ranges::count(table, '\n'), 2);
  EXPECT_NE(table.find("1,\"wall, x 0.9 to 1.2 m, z 1.0 m\",horizontal,0.300,2,0,1,0,1,0.135,0.900,1.200,"),
            std::string::npos)
      << table;
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
