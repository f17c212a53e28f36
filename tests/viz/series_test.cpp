// The frames of a run for ParaView: which file shows which time, and the files that come with it.
#include "io/vtk/series.h"

#include <gtest/gtest.h>

#include "io/vtk/files.h"
#include "io/vtk/grid.h"
#include "solver/base/error.h"
#include "tests/folder.h"
#include "tests/viz/scenes.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::Folder;
using test::message_of;

TEST(VtkSeries, ListsFramesAndForgetsLaterOnes) {
  const Folder folder;
  const Assembly assembly = test::two_cubes();
  Snapshot snapshot = rest_snapshot(assembly);
  VtkSeries series(folder.path());
  for (const double t : {0.0, 0.5, 12.5}) {
    snapshot.time = t;
    series.write(assembly, snapshot);
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "vtk/blocks_000012.500.vtu"));
  EXPECT_TRUE(std::filesystem::exists(folder / "vtk/joints_000012.500.vtp"));
  VtkSeries resumed(folder.path());
  ASSERT_EQ(resumed.blocks().frames().size(), 3u);
  EXPECT_EQ(resumed.blocks().frames()[2].time, 12.5);
  EXPECT_EQ(resumed.joints().frames()[1].file, "joints_000000.500.vtp");
  resumed.keep_first(2);
  EXPECT_EQ(resumed.blocks().frames().size(), 2u);
  snapshot.time = 0.75;
  resumed.write(assembly, snapshot);
  const PvdSeries blocks(folder / "vtk/blocks.pvd");
  ASSERT_EQ(blocks.frames().size(), 3u);
  EXPECT_EQ(blocks.frames()[2].time, 0.75);
  EXPECT_EQ(read_vtu(blocks.file_path(blocks.frames()[2]))->GetNumberOfCells(), 2);
}

/// The ends of two stages that take no time, and frames less than a millisecond apart.
TEST(VtkSeries, NoFrameTakesTheFileOfAnother) {
  const Folder folder;
  const Assembly assembly = test::two_cubes();
  Snapshot snapshot = rest_snapshot(assembly);
  VtkSeries series(folder.path());
  for (const double t : {0.0, 0.0, 0.0, 0.0002, 0.5}) {
    snapshot.time = t;
    series.write(assembly, snapshot);
  }
  const VtkSeries read(folder.path());
  const std::vector<PvdSeries::Frame>& frames = read.blocks().frames();
  ASSERT_EQ(frames.size(), 5u);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    EXPECT_TRUE(std::filesystem::exists(read.blocks().file_path(frames[i]))) << i;
    EXPECT_TRUE(std::filesystem::exists(read.joints().file_at(frames[i].time))) << i;
    if (i == 0) continue;
    EXPECT_LT(frames[i - 1].time, frames[i].time);
    EXPECT_NE(frames[i - 1].file, frames[i].file);
  }
  EXPECT_NEAR(frames[2].time, 0.0, 3e-6);
  EXPECT_EQ(frames[3].time, 0.0002);
}

TEST(VtkSeries, AFillHasAFrameBesideTheStones) {
  const Folder folder;
  const Assembly assembly = test::heap_on_cube();
  Snapshot snapshot = test::heap_flowing(assembly);
  VtkSeries series(folder.path());
  for (const double t : {0.0, 0.5}) {
    snapshot.time = t;
    series.write(assembly, snapshot);
  }
  EXPECT_TRUE(std::filesystem::exists(folder / "vtk/fill_000000.500.vtu"));
  VtkSeries resumed(folder.path());
  ASSERT_EQ(resumed.fill().frames().size(), 2u);
  EXPECT_EQ(read_vtu(resumed.fill().file_at(0.5))->GetNumberOfCells(), 4);
  resumed.keep_first(1);
  EXPECT_EQ(resumed.fill().frames().size(), 1u);
  EXPECT_EQ(resumed.fill().file_at(0.5), "");
  // Without a fill there is no trail of one.
  const Folder other;
  const Assembly cubes = test::two_cubes();
  VtkSeries plain(other.path());
  plain.write(cubes, rest_snapshot(cubes));
  EXPECT_EQ(test::names_in(other / "vtk").size(), 4u);
}

TEST(VtkSeries, ThreadsWriteTheSameBytes) {
  const Assembly assembly = test::heap_on_cube();
  const Snapshot snapshot = test::heap_flowing(assembly);
  const Folder one, three;
  VtkSeries(one.path()).write(assembly, snapshot, 1);
  VtkSeries series(three.path());
  for (int turn = 0; turn < 20; ++turn) {
    series.keep_first(0);
    series.write(assembly, snapshot, 3);
  }
  ASSERT_EQ(test::names_in(three / "vtk").size(), 6u);
  for (const auto& file : std::filesystem::directory_iterator(one / "vtk"))
    EXPECT_EQ(test::bytes_of(file.path().string()), test::bytes_of(three / ("vtk/" + file.path().filename().string())))
        << file.path();
}

/// meshio, among others, reads zlib but not LZ4.
TEST(VtkSeries, IsPackedAsAsked) {
  const Assembly assembly = test::two_cubes();
  for (const auto& [word, mark] : {std::pair{"lz4", "vtkLZ4DataCompressor"}, {"zlib", "vtkZLibDataCompressor"}}) {
    const Folder folder;
    VtkSeries series(folder.path(), packing_of(word));
    series.write(assembly, rest_snapshot(assembly));
    for (const PvdSeries* part : {&series.blocks(), &series.joints()})
      EXPECT_NE(test::bytes_of(part->file_at(0.0)).find(mark), std::string::npos) << word;
  }
  EXPECT_NE(message_of<InputError>([&] { packing_of("zip"); }).find("lz4, zlib or none"), std::string::npos);
}

TEST(VtkSeries, AFileThatCannotBeWrittenIsNamed) {
  const Folder folder;
  const Assembly assembly = test::two_cubes();
  test::set_bytes(folder / "vtk", "no folder");
  for (const int threads : {1, 2})
    EXPECT_NE(message_of<RunError>([&] {
                VtkSeries(folder.path()).write(assembly, rest_snapshot(assembly), threads);
              }).find("vtk"),
              std::string::npos);
}

TEST(VtkSeries, RefusesAFileThatIsNoCollection) {
  const Folder folder;
  test::set_bytes(folder / "blocks.pvd", "<VTKFile type=\"Other\"></VTKFile>");
  EXPECT_NE(message_of<InputError>([&] { PvdSeries series(folder / "blocks.pvd"); }).find("blocks.pvd"),
            std::string::npos);
  test::set_bytes(folder / "blocks.pvd", "garbage");
  EXPECT_THROW(PvdSeries series(folder / "blocks.pvd"), InputError);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
