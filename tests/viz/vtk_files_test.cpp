// Files for ParaView: written, read back, refused.
#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>

#include "io/vtk/files.h"
#include "io/vtk/grid.h"
#include "solver/base/error.h"
#include "tests/folder.h"
#include "tests/viz/grid_shapes.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::cell_volume, test::mixed_shapes;
using test::Folder;
using test::message_of;

TEST(FillGrid, ReadsBackAsWritten) {
  const Folder folder;
  const Assembly assembly = test::heap_on_cube();
  const auto grid = fill_grid(assembly, test::heap_flowing(assembly));
  write_vtu(grid, folder / "fill.vtu");
  const auto back = read_vtu(folder / "fill.vtu");
  ASSERT_EQ(back->GetNumberOfPoints(), 6);
  for (vtkIdType i = 0; i < 6; ++i) EXPECT_EQ(Vec3(back->GetPoint(i)), Vec3(grid->GetPoint(i)));
  for (vtkIdType c = 0; c < 4; ++c) EXPECT_EQ(cell_volume(back, c), cell_volume(grid, c));
  vtkDataArray* stress = back->GetCellData()->GetArray("stress");
  ASSERT_NE(stress, nullptr);
  EXPECT_STREQ(stress->GetComponentName(4), "YZ");
  EXPECT_EQ(stress->GetComponent(3, 2), -6e3);
  // A corner beyond the points is refused, not read past the end.
  const auto wrong = fill_grid(assembly, test::heap_flowing(assembly));
  const vtkIdType corners[4] = {0, 1, 4, 77};
  wrong->GetCells()->ReplaceCellAtId(0, 4, corners);
  write_vtu(wrong, folder / "wrong.vtu");
  EXPECT_NE(message_of<InputError>([&] { read_vtu(folder / "wrong.vtu"); }).find("its parts do not agree"),
            std::string::npos);
}

TEST(VtkFiles, ReadBackAsWritten) {
  const Folder folder;
  const Assembly assembly = mixed_shapes();
  Snapshot snapshot = rest_snapshot(assembly);
  snapshot.time = 1.0 / 3.0;
  snapshot.displacement[0] = {1.0 / 7.0, 0, 0};
  const auto grid = block_grid(assembly, snapshot);
  write_vtu(grid, folder / "deep/er/blocks.vtu");
  const auto back = read_vtu(folder / "deep/er/blocks.vtu");
  ASSERT_EQ(back->GetNumberOfCells(), 3);
  ASSERT_EQ(back->GetNumberOfPoints(), grid->GetNumberOfPoints());
  for (vtkIdType i = 0; i < back->GetNumberOfPoints(); ++i)
    for (int c = 0; c < 3; ++c) EXPECT_EQ(back->GetPoint(i)[c], grid->GetPoint(i)[c]);
  for (vtkIdType c = 0; c < 3; ++c) EXPECT_NEAR(cell_volume(back, c), 3.0, 1e-12);
  EXPECT_EQ(back->GetCellData()->GetNumberOfArrays(), grid->GetCellData()->GetNumberOfArrays());
  EXPECT_EQ(back->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), 1.0 / 3.0);
  const std::string text = test::bytes_of(folder / "deep/er/blocks.vtu");
  EXPECT_NE(text.find("vtkLZ4DataCompressor"), std::string::npos);
  EXPECT_NE(text.find("format=\"appended\""), std::string::npos);
  EXPECT_EQ(test::names_in(folder / "deep/er").size(), 1u);  // no temporary is left
}

/// Runs of before wrote zlib.
TEST(VtkFiles, EveryPackingIsRead) {
  const Folder folder;
  const Assembly assembly = mixed_shapes();
  const auto grid = block_grid(assembly, rest_snapshot(assembly));
  for (const Packing packing : {Packing::none, Packing::lz4, Packing::zlib_fast, Packing::zlib}) {
    write_vtu(grid, folder / "a.vtu", packing);
    const auto back = read_vtu(folder / "a.vtu");
    ASSERT_EQ(back->GetNumberOfPoints(), grid->GetNumberOfPoints());
    for (vtkIdType i = 0; i < back->GetNumberOfPoints(); ++i)
      EXPECT_EQ(Vec3(back->GetPoint(i)), Vec3(grid->GetPoint(i)));
  }
}

TEST(VtkFiles, ErrorsNameTheFile) {
  const Folder folder;
  const Assembly assembly = test::two_cubes();
  const auto grid = block_grid(assembly, rest_snapshot(assembly));
  test::set_bytes(folder / "file", "in the way");
  EXPECT_NE(message_of<RunError>([&] { write_vtu(grid, folder / "file/blocks.vtu"); }).find("file"), std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { read_vtu(folder / "none.vtu"); }).find("no such file"), std::string::npos);
  test::set_bytes(folder / "bad.vtu", "<VTKFile type=\"UnstructuredGrid\"");
  EXPECT_NE(message_of<InputError>([&] { read_vtu(folder / "bad.vtu"); }).find("bad.vtu"), std::string::npos);
  write_vtu(grid, folder / "blocks.vtu");
  EXPECT_NE(message_of<InputError>([&] { read_vtp(folder / "blocks.vtu"); }).find("is not a .vtp"), std::string::npos);
  std::filesystem::create_directories(folder / "taken.vtu/x");
  EXPECT_NE(message_of<RunError>([&] { write_vtu(grid, folder / "taken.vtu"); }).find("cannot write"),
            std::string::npos);
  EXPECT_EQ(test::names_in(folder.path()).size(), 4u);
}

TEST(VtkFiles, ATruncatedFileIsRefused) {
  const Folder folder;
  const Assembly assembly = test::arch_and_wall();
  write_vtu(block_grid(assembly, rest_snapshot(assembly)), folder / "a.vtu");
  const std::string text = test::bytes_of(folder / "a.vtu");
  test::set_bytes(folder / "a.vtu", text.substr(0, text.size() * 6 / 10));
  EXPECT_THROW(read_vtu(folder / "a.vtu"), InputError);
}
}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
