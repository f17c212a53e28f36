// The numbers of view.html: what the page unpacks is what the grids hold.
#include <gtest/gtest.h>
#include <zlib.h>

#include <cstring>

#include "io/vtk/files.h"
#include "io/vtk/series.h"
#include "tests/folder.h"
#include "tests/viz/scenes.h"
#include "viz/viewer/viewer_frames.h"
#include "viz/viewer/viewer_pack.h"
#include "viz/viewer/viewer_page.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Reads sections as unpack.js does.
struct Unpacked {
  nlohmann::json sections;
  std::string bytes = std::string(1 << 20, '\0');

  Unpacked(nlohmann::json where, const std::string& compressed) : sections(std::move(where)) {
    uLongf size = bytes.size();
    EXPECT_EQ(uncompress(reinterpret_cast<Bytef*>(bytes.data()), &size,
                         reinterpret_cast<const Bytef*>(compressed.data()), compressed.size()),
              Z_OK);
    bytes.resize(size);
  }
  explicit Unpacked(const ViewerData& data) : Unpacked(data.scene["sections"], data.bytes) {}

  template <class Number>
  std::vector<Number> numbers(const std::string& name) const {
    std::vector<Number> out(sections[name]["count"].get<std::size_t>());
    std::memcpy(out.data(), bytes.data() + sections[name]["offset"].get<std::size_t>(), out.size() * sizeof(Number));
    return out;
  }

  double value(const std::string& name, std::size_t frame, std::size_t item, std::size_t column) const {
    const nlohmann::json& s = sections[name];
    const std::size_t items = s["items"], groups = s["groups"], width = s["width"], frames = s["frames"];
    const auto codes = numbers<unsigned char>(name);
    const std::size_t all = items * groups * width * frames;
    int sum = 0;
    for (std::size_t f = 0; f <= frame; ++f) {
      const std::size_t at = (column * frames + f) * items + item;
      const int code = codes[at] | codes[all + at] << 8;
      sum = std::int16_t(sum + ((code >> 1) ^ -(code & 1)));
    }
    return double(sum) / s["steps"].get<int>() *
           double(numbers<float>(name + "_scale")[item * groups + column / width]);
  }
};

TEST(ViewerPack, SeriesKeepTheirValuesWithinHalfAStep) {
  PackedSeries series{.items = 3, .groups = 2, .width = 2, .steps = 500, .frames = {}};
  for (int f = 0; f < 5; ++f) {
    series.frames.emplace_back();
    for (int k = 0; k < 12; ++k)  // item 2 stays, item 1 swings from end to end, item 0 is small beside it
      series.frames.back().push_back(k / 4 == 2 ? 0.0 : k / 4 == 1 ? 80.0 * (f % 2 ? -1 : 1) : 1e-4 * std::sin(k + f));
  }
  ViewerPack pack;
  pack.add("before", std::vector<std::int16_t>{7, -8, 9});  // so that the next begins at an odd place
  pack.add("s", series);
  const Unpacked read(pack.sections(), pack.compressed());
  for (std::size_t f = 0; f < 5; ++f)
    for (std::size_t i = 0; i < 3; ++i)
      for (std::size_t c = 0; c < 4; ++c) {
        double largest = 0.0;
        for (const auto& frame : series.frames)
          for (std::size_t k = 0; k < 2; ++k) largest = std::max(largest, std::abs(frame[4 * i + c / 2 * 2 + k]));
        EXPECT_NEAR(read.value("s", f, i, c), series.frames[f][4 * i + c], 0.51 / 500 * largest) << f << i << c;
      }
  EXPECT_EQ(read.numbers<std::int16_t>("before"), (std::vector<std::int16_t>{7, -8, 9}));
}

TEST(ViewerPack, ScalesAreNoLessThanTheirValues) {
  for (const double value : {1e-30, 3.3e-6, 0.1, 1.0, 1.0000001, 255.5, 1e20}) {
    EXPECT_GE(double(coarse_scale(value)), value);
    EXPECT_LE(double(coarse_scale(value)), 1.01 * value);
  }
  EXPECT_EQ(coarse_scale(0.0), 0.0F);
}

TEST(ViewerPack, WhatIsNoNumberIsShownAsNothing) {
  PackedSeries series{.items = 1, .groups = 1, .width = 1, .frames = {{1.0}, {NAN}, {INFINITY}, {-1.0}}};
  ViewerPack pack;
  pack.add("s", series);
  const Unpacked read(pack.sections(), pack.compressed());
  EXPECT_NEAR(read.value("s", 0, 0, 0), 1.0, 1e-3);
  EXPECT_EQ(read.value("s", 1, 0, 0), 0.0);
  EXPECT_EQ(read.value("s", 2, 0, 0), 0.0);
  EXPECT_NEAR(read.value("s", 3, 0, 0), -1.0, 1e-3);
}

/// Stones and their motion, taken from the packed numbers and put together as the shader does, are where the state has
/// them.
TEST(ViewerScene, StonesStandWhereTheStateHasThem) {
  const Assembly assembly = arch_and_wall();
  const Snapshot snapshot = damaged(assembly);
  const ViewerScene scene = snapshot_scene(assembly, snapshot);
  const ViewerData data = viewer_data(scene);
  const Unpacked read(data);
  const auto centres = read.numbers<float>("centres"), sizes = read.numbers<float>("sizes");
  const auto corners = read.numbers<std::int16_t>("corners");
  const auto counts = read.numbers<std::uint32_t>("counts"), kinds = read.numbers<std::uint32_t>("kinds");
  const auto origin = data.scene["origin"].get<std::array<double, 3>>();
  std::size_t corner = 0;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    const Block& block = assembly.blocks[i];
    ASSERT_EQ(counts[3 * i], block.cells[0].vertices.size());
    EXPECT_EQ(kinds[3 * i], std::uint32_t(block.component));
    // Faces are seen from outside.
    EXPECT_NEAR(mass_properties(Polyhedron{scene.stones[i].corners, scene.stones[i].faces}).volume,
                mass_properties(block.cells).volume, 1e-9);
    EXPECT_EQ(kinds[3 * i + 2], block.fixed ? 1U : 0U);
    Vec3 u, turn, centre;
    for (int c = 0; c < 3; ++c) {
      u[c] = read.value("motion", 0, i, std::size_t(c)), turn[c] = read.value("motion", 0, i, std::size_t(3 + c));
      centre[c] = double(centres[3 * i + std::size_t(c)]) + origin[std::size_t(c)];
    }
    const double angle = turn.norm();
    const Mat3 rotation = angle > 0.0 ? Eigen::AngleAxisd(angle, turn / angle).toRotationMatrix() : Mat3::Identity();
    Box shown, expected;
    for (const Vec3& x : block.cells[0].vertices) {
      Vec3 p;
      for (int c = 0; c < 3; ++c, ++corner) p[c] = corners[corner] / 32767.0 * double(sizes[i]);
      const Vec3 now = centre + u + rotation * p;
      shown.low = shown.low.cwiseMin(now), shown.high = shown.high.cwiseMax(now);
      const Vec3 there = block.centroid + snapshot.displacement[i] - snapshot.base_displacement +
                         snapshot.rotation[i] * (x - block.centroid);
      expected.low = expected.low.cwiseMin(there), expected.high = expected.high.cwiseMax(there);
    }
    // Half a step of displacement and rotation, half a step of the corners, single precision of the centres.
    EXPECT_LT((shown.low - expected.low).norm(), 5e-5) << i;
    EXPECT_LT((shown.high - expected.high).norm(), 5e-5) << i;
  }
  EXPECT_EQ(corner, corners.size());
}

TEST(ViewerScene, ForcesAreTractionsTimesAreas) {
  const Assembly assembly = two_cubes();
  Snapshot snapshot = rest_snapshot(assembly);
  ASSERT_EQ(snapshot.patches.size(), 1U);
  snapshot.patches[0].normal_traction = -3000.0, snapshot.patches[0].shear_traction = 500.0;
  snapshot.patches[0].area = 0.8, snapshot.patches[0].opening = 2e-3;
  PatchSnapshot second = snapshot.patches[0];
  std::swap(second.a, second.b);
  second.area = 0.2, second.normal_traction = 1000.0;
  PatchSnapshot gone = second;
  gone.replaced = true;
  snapshot.patches.push_back(second), snapshot.patches.push_back(gone);
  const ViewerScene scene = snapshot_scene(assembly, snapshot);
  ASSERT_EQ(scene.pairs, (std::vector<std::array<int, 2>>{{0, 1}}));
  const ViewerFrame& frame = scene.frames.at(0);
  EXPECT_DOUBLE_EQ(frame.forces[0][0], 3000.0 * 0.8 - 1000.0 * 0.2);
  EXPECT_DOUBLE_EQ(frame.forces[0][1], 500.0);
  EXPECT_DOUBLE_EQ(frame.forces[0][2], 2e-3);
  EXPECT_DOUBLE_EQ(frame.values[1][compression_value], 3000.0);
  EXPECT_DOUBLE_EQ(frame.values[0][shear_value], 500.0);
}

TEST(ViewerScene, FillIsItsSurface) {
  const Assembly assembly = heap_on_cube();
  const ViewerScene scene = snapshot_scene(assembly, heap_flowing(assembly));
  ASSERT_EQ(scene.fill.nodes.size(), 6U);
  EXPECT_EQ(scene.fill.triangles.size(), 8U);
  for (std::size_t n = 0; n < 6; ++n) {
    const bool top = scene.fill.nodes[n].z() > 0.5;
    EXPECT_NEAR((scene.frames[0].fill[n] - Vec3(top ? 0.1 : 0.0, 0, 0)).norm(), 0.0, 1e-12);
  }
  const ViewerData data = viewer_data(scene);
  EXPECT_EQ(data.scene["sections"]["motion"]["items"], 1 + 6);
}

TEST(ViewerScene, OfARunHasAsManyFramesAsAskedFor) {
  const Assembly assembly = two_cubes();
  Folder folder;
  VtkSeries series(folder.path());
  EXPECT_NE(message_of<InputError>([&] { run_scene(folder.path(), 9); }).find("has no frames"), std::string::npos);
  for (int k = 0; k < 5; ++k) {
    Snapshot snapshot = rest_snapshot(assembly);
    snapshot.time = k;
    snapshot.displacement[1] = {0.01 * k, 0, 0};
    series.write(assembly, snapshot);
  }
  EXPECT_EQ(run_scene(folder.path(), 9).frames.size(), 5U);
  const ViewerScene three = run_scene(folder.path(), 3);
  ASSERT_EQ(three.frames.size(), 3U);
  EXPECT_EQ(three.frames[1].label, "t = 2.000 s");
  EXPECT_DOUBLE_EQ(three.frames[2].displacement[1].x(), 0.04);
  EXPECT_EQ(run_scene(folder.path(), 1).frames[0].label, "t = 4.000 s");
  // A frame of another run among them.
  Assembly one = assembly;
  one.blocks.pop_back(), one.joints.clear();
  Snapshot other = rest_snapshot(one);
  other.time = 7.0;
  series.write(one, other);
  EXPECT_NE(message_of<InputError>([&] {
              run_scene(folder.path(), 9);
            }).find("blocks_000007.000.vtu: this frame has 1 block "),
            std::string::npos);
}

/// Before and after a diagnosis that adds a support: the stone of the support stands still before.
TEST(ViewerScene, OfShapesMayHaveMoreStonesInOneSeries) {
  const Assembly two = two_cubes();
  Assembly three = two;
  three.blocks.push_back(make_block(make_box({0, 0, 2}, {1, 1, 3}), Component::restraint));
  three.joints.clear();
  finish_blocks(three);
  Folder folder;
  std::vector<ShapeSeries> both;
  for (const Assembly* assembly : std::array<const Assembly*, 2>{&two, &three}) {
    Mode mode;
    mode.shape = BlockMotions::Constant(Eigen::Index(assembly->blocks.size()), 6, 0.25);
    const std::string name = assembly == &two ? "before" : "after";
    write_vtu(mode_grid(*assembly, mode), folder / (name + ".vtu"));
    PvdSeries series(folder / (name + ".pvd"));
    series.add(1.0, name + ".vtu");
    both.push_back({folder / (name + ".pvd"), "", {name}});
  }
  const ViewerScene scene = shape_scene(both);
  EXPECT_TRUE(scene.modes);
  ASSERT_EQ(scene.stones.size(), 3U);
  ASSERT_EQ(scene.frames.size(), 2U);
  EXPECT_EQ(scene.frames[0].label, "before");
  EXPECT_EQ(scene.frames[0].displacement[1], Vec3::Constant(0.25));
  EXPECT_EQ(scene.frames[0].displacement[2], Vec3::Zero());
  EXPECT_EQ(scene.frames[1].displacement[2], Vec3::Constant(0.25));
  EXPECT_FALSE(viewer_data(scene).bytes.empty());
  both[0].labels.push_back("another");
  EXPECT_NE(message_of<InputError>([&] {
              shape_scene(both);
            }).find("before.pvd has 1 mode shape, but the list of modes has 2"),
            std::string::npos);
}

TEST(ViewerPage, TextsCannotEndItsScripts) {
  ViewerScene scene = snapshot_scene(two_cubes(), rest_snapshot(two_cubes()));
  scene.title = "</script><script>alert(1)</script> & \xff";
  const std::string json = script_json(viewer_data(scene).scene);
  EXPECT_EQ(json.find('<'), std::string::npos);
  EXPECT_NE(nlohmann::json::parse(json)["title"].get<std::string>().find("</script><script>alert(1)"),
            std::string::npos);
  if (!has_viewer()) GTEST_SKIP() << "built without three.js (libjs-three): no page to look at";
  EXPECT_EQ(viewer_page(scene).find("alert(1)</script>"), std::string::npos);
}

TEST(ViewerPage, NothingToShowIsSaid) {
  const ViewerScene nothing;
  EXPECT_NE(message_of<InputError>([&] { viewer_data(nothing); }).find("no stones"), std::string::npos);
  ViewerScene still = snapshot_scene(two_cubes(), rest_snapshot(two_cubes()));
  still.frames.clear();
  EXPECT_NE(message_of<InputError>([&] { viewer_data(still); }).find("no frames"), std::string::npos);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
