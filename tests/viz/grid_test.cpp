// Grids for ParaView: cells, fields, displaced points, and the files they are written to.
#include "io/vtk/grid.h"

#include <gtest/gtest.h>
#include <vtkCell.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkIdList.h>
#include <vtkNew.h>
#include <vtkPointData.h>

#include <set>

#include "io/vtk/block_shape.h"
#include "io/vtk/files.h"
#include "solver/base/error.h"
#include "tests/viz/folder.h"
#include "tests/viz/scenes.h"
#include "viz/scene.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::Folder;
using test::message_of;

/// Volume of one cell of a grid, from its faces as VTK gives them (divergence theorem).
double cell_volume(vtkUnstructuredGrid* grid, vtkIdType c) {
  Polyhedron shape;
  vtkCell* cell = grid->GetCell(c);
  for (int f = 0; f < cell->GetNumberOfFaces(); ++f) {
    shape.faces.emplace_back();
    vtkPoints* points = cell->GetFace(f)->GetPoints();
    for (vtkIdType k = 0; k < points->GetNumberOfPoints(); ++k) {
      shape.faces.back().push_back(int(shape.vertices.size()));
      shape.vertices.emplace_back(points->GetPoint(k));
    }
  }
  return mass_properties(shape).volume;
}

/// Every edge of the cell's faces is run once in each direction.
bool watertight(const Polyhedron& shape) {
  std::set<std::pair<int, int>> edges;
  for (const auto& loop : shape.faces)
    for (std::size_t k = 0; k < loop.size(); ++k)
      if (!edges.insert({loop[k], loop[(k + 1) % loop.size()]}).second) return false;
  for (const auto& [a, b] : edges)
    if (!edges.contains({b, a})) return false;
  return true;
}

/// An L of two boxes whose common face is smaller than one of them, a wedge and a box.
Assembly mixed_shapes() {
  Assembly assembly;
  Block angle = test::make_block(make_box({0, 0, 0}, {2, 1, 1}), Component::wall);
  angle.cells.push_back(make_box({0, 0, 1}, {1, 1, 2}));
  assembly.blocks = {angle,
                     test::make_block(make_prism({{5, 0, 0}, {7, 0, 0}, {5, 0, 1}}, {0, -3, 0}), Component::pier),
                     test::make_block(make_box({0, 5, 0}, {1, 6, 3}), Component::arch)};
  // make_prism wants its base clockwise or not depending on the sweep; a stone must have a positive volume.
  auto& wedge = assembly.blocks[1].cells[0];
  if (mass_properties(wedge).volume < 0)
    for (auto& loop : wedge.faces) std::reverse(loop.begin(), loop.end());
  test::finish(assembly);
  return assembly;
}

TEST(BlockGrid, CellTypesAndVolumesAreThoseOfTheStones) {
  const Assembly assembly = mixed_shapes();
  const auto grid = block_grid(assembly, rest_snapshot(assembly));
  ASSERT_EQ(grid->GetNumberOfCells(), 3);
  EXPECT_EQ(grid->GetCellType(0), VTK_POLYHEDRON);
  EXPECT_EQ(grid->GetCellType(1), VTK_POLYHEDRON);
  EXPECT_EQ(grid->GetCellType(2), VTK_HEXAHEDRON);
  EXPECT_NEAR(cell_volume(grid, 0), 3.0, 1e-12);
  EXPECT_NEAR(cell_volume(grid, 1), 3.0, 1e-12);
  EXPECT_NEAR(cell_volume(grid, 2), 3.0, 1e-12);
}

TEST(BlockGrid, SurfaceOfACompoundStoneIsWatertight) {
  const Assembly assembly = mixed_shapes();
  const Polyhedron shape = outer_surface(assembly.blocks[0]);
  EXPECT_TRUE(watertight(shape));
  EXPECT_NEAR(surface_area(shape), 14.0, 1e-12);  // an L of three unit cubes
}

TEST(BlockGrid, HexahedronTakesAnyFaceOrder) {
  Polyhedron box = make_box({0, 0, 0}, {1, 2, 3});
  for (int turn = 0; turn < 6; ++turn) {
    std::rotate(box.faces.begin(), box.faces.begin() + 1, box.faces.end());
    const auto order = hexahedron_order(box);
    ASSERT_TRUE(order);
    const auto at = [&](int k) { return box.vertices[(*order)[k]]; };
    EXPECT_NEAR((at(1) - at(0)).cross(at(3) - at(0)).dot(at(4) - at(0)), 6.0, 1e-12);  // right-handed
  }
}

TEST(BlockGrid, PointsMoveWithTheStone) {
  const Assembly assembly = test::two_cubes();
  Snapshot snapshot = rest_snapshot(assembly);
  snapshot.time = 3.25;
  snapshot.base_displacement = {0.5, 0, 0};
  snapshot.displacement = {{0.5, 0, 0}, {0.6, 0, 0.2}};
  snapshot.rotation[1] = Eigen::AngleAxisd(0.3, Vec3::UnitY());
  snapshot.velocity[1] = {1, 2, 3};
  const auto grid = block_grid(assembly, snapshot);
  vtkDataArray* moved = grid->GetPointData()->GetArray("displacement_of_point");
  const Vec3 centre(0.5, 0.5, 1.5);
  std::size_t upper = 0;
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) {
    const Vec3 now(grid->GetPoint(i)), d(moved->GetTuple3(i));
    const Vec3 reference = now - d - snapshot.base_displacement;
    if (i < 8) {  // the fixed cube goes with the ground
      EXPECT_NEAR(d.norm(), 0.0, 1e-14);
      continue;
    }
    ++upper;
    // Rotation about +y takes z to x: x' = x cos + z sin.
    const Vec3 r = reference - centre;
    const Vec3 expected = centre + Vec3(0.6 + std::cos(0.3) * r.x() + std::sin(0.3) * r.z(), r.y(),
                                        0.2 - std::sin(0.3) * r.x() + std::cos(0.3) * r.z());
    EXPECT_NEAR((now - expected).norm(), 0.0, 1e-14);
    EXPECT_TRUE(reference.z() == 1.0 || reference.z() == 2.0 ||
                std::abs(reference.z() - std::round(reference.z())) < 1e-14);
  }
  EXPECT_EQ(upper, 8u);
  EXPECT_NEAR(grid->GetCellData()->GetArray("rotation")->GetComponent(1, 1), 0.3, 1e-15);
  EXPECT_EQ(grid->GetCellData()->GetArray("velocity")->GetComponent(1, 2), 3.0);
  EXPECT_EQ(grid->GetCellData()->GetArray("displacement")->GetComponent(1, 0), 0.6);
  EXPECT_EQ(grid->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), 3.25);
  EXPECT_EQ(grid->GetFieldData()->GetArray("base_displacement")->GetComponent(0, 0), 0.5);
}

TEST(BlockGrid, TakesTheLargestOverAllJointsOfAStone) {
  const Assembly assembly = test::arch_and_wall();
  const Snapshot snapshot = test::damaged(assembly);
  const auto grid = block_grid(assembly, snapshot);
  std::vector<double> opening(assembly.blocks.size(), 0.0), slip(assembly.blocks.size(), 0.0);
  for (const auto& p : snapshot.patches) {
    opening[p.a] = std::max(opening[p.a], p.largest_opening), opening[p.b] = std::max(opening[p.b], p.largest_opening);
    slip[p.a] = std::max(slip[p.a], p.largest_slip), slip[p.b] = std::max(slip[p.b], p.largest_slip);
  }
  double sum = 0.0;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    EXPECT_EQ(grid->GetCellData()->GetArray("max_joint_opening")->GetComponent(vtkIdType(i), 0), opening[i]);
    EXPECT_EQ(grid->GetCellData()->GetArray("max_joint_slip")->GetComponent(vtkIdType(i), 0), slip[i]);
    sum += opening[i] + slip[i];
  }
  EXPECT_GT(sum, 0.1);
}

TEST(JointPolydata, FieldsAndCornersBetweenTheStones) {
  const Assembly assembly = test::two_cubes();
  ASSERT_EQ(assembly.joints.size(), 1u);
  Snapshot snapshot = rest_snapshot(assembly);
  snapshot.displacement[1] = {0.02, 0, 0.1};
  PatchSnapshot& patch = snapshot.patches[0];
  for (Vec3& x : patch.polygon) x += Vec3(0.01, 0, 0.05);  // midway
  patch.opening = patch.largest_opening = 0.1;
  patch.bonded = 0.0;
  patch.normal_traction = -2e5;
  const auto data = joint_polydata(assembly, snapshot);
  ASSERT_EQ(data->GetNumberOfPolys(), 1);
  const auto value = [&](const char* name) { return data->GetCellData()->GetArray(name)->GetComponent(0, 0); };
  EXPECT_EQ(value("opening"), 0.1);
  EXPECT_EQ(value("normal_traction"), -2e5);
  EXPECT_EQ(value("bonded"), 0.0);
  EXPECT_EQ(value("had_bond"), 1.0);
  EXPECT_EQ(value("component_a"), double(Component::base));
  EXPECT_EQ(value("component_b"), double(Component::wall));
  EXPECT_NEAR(value("area"), 1.0, 1e-12);
  for (vtkIdType i = 0; i < 4; ++i) {
    const Vec3 d(data->GetPointData()->GetArray("displacement_of_point")->GetTuple3(i));
    EXPECT_NEAR((d - Vec3(0.01, 0, 0.05)).norm(), 0.0, 1e-14);
  }
}

TEST(JointPolydata, SecondBodyMayBeTheFill) {
  const Assembly assembly = test::two_cubes();
  Snapshot snapshot = rest_snapshot(assembly);
  snapshot.patches[0].b = -3;
  const auto data = joint_polydata(assembly, snapshot);
  EXPECT_EQ(data->GetCellData()->GetArray("component_b")->GetComponent(0, 0), -1.0);
  EXPECT_EQ(data->GetCellData()->GetArray("block_b")->GetComponent(0, 0), -3.0);
  EXPECT_EQ(block_grid(assembly, snapshot)->GetNumberOfCells(), 2);
}

TEST(BlockGrid, RefusesAStateOfAnotherAssembly) {
  const Assembly two = test::two_cubes();
  Snapshot snapshot = rest_snapshot(two);
  snapshot.displacement.pop_back();
  EXPECT_NE(message_of<InputError>([&] { block_grid(two, snapshot); }).find("1 blocks and the assembly 2"),
            std::string::npos);
  snapshot = rest_snapshot(two);
  snapshot.patches[0].b = 7;
  EXPECT_NE(message_of<InputError>([&] { joint_polydata(two, snapshot); }).find("names blocks 0 and 7"),
            std::string::npos);
}

TEST(FillGrid, HasNodesTetrahedraAndTheirFields) {
  const Assembly assembly = test::heap_on_cube();
  const auto grid = fill_grid(assembly, test::heap_flowing(assembly));
  ASSERT_EQ(grid->GetNumberOfPoints(), 6);
  ASSERT_EQ(grid->GetNumberOfCells(), 4);
  double volume = 0.0;
  for (vtkIdType c = 0; c < 4; ++c) {
    EXPECT_EQ(grid->GetCellType(c), VTK_TETRA);
    EXPECT_GT(cell_volume(grid, c), 0.0) << "its corners are not in VTK's order";
    volume += cell_volume(grid, c);
  }
  EXPECT_NEAR(volume, 1.0 / 3.0, 1e-12);  // sheared sideways
  EXPECT_EQ(Vec3(grid->GetPoint(5)), Vec3(0.5 + 0.6, 0.5, 1.0));
  const auto point = [&](const char* name, vtkIdType i) {
    return Vec3(grid->GetPointData()->GetArray(name)->GetTuple3(i));
  };
  EXPECT_EQ(point("displacement", 5), Vec3(0.6, 0, 0));
  EXPECT_NEAR((point("displacement_of_point", 5) - Vec3(0.1, 0, 0)).norm(), 0.0, 1e-15);
  EXPECT_EQ(point("displacement_of_point", 0), Vec3(0, 0, 0));
  EXPECT_EQ(point("velocity", 5), Vec3(1, 2, 3));
  const auto cell = [&](const char* name, vtkIdType i, int c = 0) {
    return grid->GetCellData()->GetArray(name)->GetComponent(i, c);
  };
  vtkDataArray* stress = grid->GetCellData()->GetArray("stress");
  ASSERT_EQ(stress->GetNumberOfComponents(), 6);
  const std::array<std::pair<std::string, double>, 6> expected = {
      {{"XX", -1e3}, {"YY", -2e3}, {"ZZ", -6e3}, {"XY", 100}, {"YZ", 200}, {"XZ", 300}}};
  for (int c = 0; c < 6; ++c) {
    EXPECT_EQ(stress->GetComponentName(c), expected[std::size_t(c)].first);
    EXPECT_EQ(cell("stress", 2, c), expected[std::size_t(c)].second);
  }
  EXPECT_EQ(cell("mean_stress", 2), -3e3);
  EXPECT_EQ(cell("plastic_shear_strain", 3), 0.03);
  EXPECT_EQ(cell("plastic_volumetric_strain", 3), 0.003);
  EXPECT_EQ(cell("component", 0), double(Component::backfill));
  EXPECT_EQ(cell("material", 0), 1.0);
  const double now[4] = {0, 0, 1, 2}, ever[4] = {0, 1, 1, 3};
  for (vtkIdType i = 0; i < 4; ++i) {
    EXPECT_EQ(cell("yields_now", i), now[i]) << i;
    EXPECT_EQ(cell("has_yielded", i), ever[i]) << i;
  }
  EXPECT_EQ(grid->GetFieldData()->GetArray("TimeValue")->GetComponent(0, 0), 3.25);
  EXPECT_EQ(grid->GetFieldData()->GetArray("base_displacement")->GetComponent(0, 0), 0.5);
}

TEST(FillGrid, RefusesAStateOfAnotherAssembly) {
  const Assembly assembly = test::heap_on_cube();
  Snapshot snapshot = rest_snapshot(assembly);
  snapshot.fill.tets.pop_back();
  EXPECT_NE(message_of<InputError>([&] {
              fill_grid(assembly, snapshot);
            }).find("6 nodes and 3 tetrahedra and that of the assembly 6 and 4"),
            std::string::npos);
  EXPECT_EQ(fill_grid(test::two_cubes(), rest_snapshot(test::two_cubes()))->GetNumberOfCells(), 0);
}

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
  EXPECT_NE(message_of<InputError>([&] { read_vtu(folder / "wrong.vtu"); }).find("do not fit together"),
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
  const std::string text = test::read_text(folder / "deep/er/blocks.vtu");
  EXPECT_NE(text.find("vtkLZ4DataCompressor"), std::string::npos);
  EXPECT_NE(text.find("format=\"appended\""), std::string::npos);
  EXPECT_EQ(test::files_in(folder / "deep/er"), 1u);  // no temporary is left
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
  test::write_text(folder / "file", "in the way");
  EXPECT_NE(message_of<RunError>([&] { write_vtu(grid, folder / "file/blocks.vtu"); }).find("file"), std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { read_vtu(folder / "none.vtu"); }).find("no such file"), std::string::npos);
  test::write_text(folder / "bad.vtu", "<VTKFile type=\"UnstructuredGrid\"");
  EXPECT_NE(message_of<InputError>([&] { read_vtu(folder / "bad.vtu"); }).find("bad.vtu"), std::string::npos);
  write_vtu(grid, folder / "blocks.vtu");
  EXPECT_NE(message_of<InputError>([&] { read_vtp(folder / "blocks.vtu"); }).find("is not a .vtp"), std::string::npos);
  std::filesystem::create_directories(folder / "taken.vtu/x");
  EXPECT_NE(message_of<RunError>([&] { write_vtu(grid, folder / "taken.vtu"); }).find("cannot write"),
            std::string::npos);
  EXPECT_EQ(test::files_in(folder.str()), 4u);
}

TEST(VtkFiles, ATruncatedFileIsRefused) {
  const Folder folder;
  const Assembly assembly = test::arch_and_wall();
  write_vtu(block_grid(assembly, rest_snapshot(assembly)), folder / "a.vtu");
  const std::string text = test::read_text(folder / "a.vtu");
  test::write_text(folder / "a.vtu", text.substr(0, text.size() * 6 / 10));
  EXPECT_THROW(read_vtu(folder / "a.vtu"), InputError);
}

using test::finish, test::make_block, test::two_cubes;

double length_of(vtkPolyData* lines) {
  double sum = 0.0;
  vtkNew<vtkIdList> ends;
  for (vtkIdType c = 0; c < lines->GetLines()->GetNumberOfCells(); ++c) {
    lines->GetLines()->GetCellAtId(c, ends);
    Vec3 a, b;
    lines->GetPoint(ends->GetId(0), a.data());
    lines->GetPoint(ends->GetId(1), b.data());
    sum += (b - a).norm();
  }
  return sum;
}

/// Two cubes on one another have the outline of one box: none of the edges between them.
TEST(Scene, OuterOutlineIsThatOfTheWhole) {
  const Assembly assembly = two_cubes();
  const Snapshot rest = rest_snapshot(assembly);
  const auto faces = deformed_faces(block_grid(assembly, rest), Hidden({}), 0.0);
  EXPECT_NEAR(length_of(outer_outline(faces, joint_polydata(assembly, rest))), 4 * 2.0 + 8 * 1.0, 1e-9);
}

double area_of(vtkPolyData* faces) {
  double sum = 0.0;
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < faces->GetNumberOfPolys(); ++c) {
    faces->GetPolys()->GetCellAtId(c, ids);
    Vec3 twice = Vec3::Zero();
    const Vec3 from(faces->GetPoint(ids->GetId(0)));
    for (vtkIdType k = 1; k + 1 < ids->GetNumberOfIds(); ++k) {
      const Vec3 a(faces->GetPoint(ids->GetId(k))), b(faces->GetPoint(ids->GetId(k + 1)));
      twice += (a - from).cross(b - from);
    }
    sum += 0.5 * twice.norm();
  }
  return sum;
}

/// The volume within faces that look outwards.
double volume_of(vtkPolyData* faces) {
  Polyhedron shape;
  vtkNew<vtkIdList> ids;
  for (vtkIdType i = 0; i < faces->GetNumberOfPoints(); ++i) shape.vertices.emplace_back(faces->GetPoint(i));
  for (vtkIdType c = 0; c < faces->GetNumberOfPolys(); ++c) {
    faces->GetPolys()->GetCellAtId(c, ids);
    shape.faces.emplace_back(ids->begin(), ids->end());
  }
  return mass_properties(shape).volume;
}

TEST(Scene, OfAFillOnlyTheSurfaceIsSeen) {
  const Assembly assembly = test::heap_on_cube();
  const auto grid = fill_grid(assembly, test::heap_flowing(assembly));
  const auto faces = deformed_faces(grid, Hidden({}), 0.0);
  EXPECT_EQ(faces->GetNumberOfPolys(), 8);  // four below, four above; none between the tetrahedra
  EXPECT_NEAR(area_of(faces), 1.0 + 4 * 0.25 * std::sqrt(5.0), 1e-12);
  EXPECT_EQ(deformed_faces(grid, Hidden({"backfill"}), 0.0)->GetNumberOfPolys(), 0);
  double box[6];
  deformed_faces(grid, Hidden({}), 10.0)->GetBounds(box);
  EXPECT_NEAR(box[1], 1.5, 1e-12);  // the top moves by 0.1 m beyond the base
}

CutPlane cut_at(int axis, double place, double side) {
  return {axis, place, side};
}

/// What is left is closed: its faces hold the volume behind the plane.
TEST(Scene, CutsLeaveClosedBodies) {
  const Assembly stones = mixed_shapes();  // an L, a wedge and a box
  const auto blocks = block_grid(stones, rest_snapshot(stones));
  const auto left = [&](int axis, double place, double side) {
    return volume_of(deformed_faces(blocks, Hidden({}), 0.0, cut_at(axis, place, side)));
  };
  // x: the L has 2 m2 up to x = 1 and 1 m2 from there, the wedge from x = 5 on 3 m × 1 m, tapering, the box 3 m2.
  EXPECT_NEAR(left(0, 0.5, 1.0), 2.0 + 3.0 + 1.5, 1e-9);
  EXPECT_NEAR(left(0, 0.5, -1.0), 1.0 + 1.5, 1e-9);
  EXPECT_NEAR(left(0, 1.5, -1.0), 2.5 + 3.0, 1e-9);
  EXPECT_NEAR(left(0, 6.0, 1.0), 0.75, 1e-9);
  // z: the L's plane through both arms is not convex; at z = 1 it passes through its inner edge and a face of it.
  EXPECT_NEAR(left(2, 0.5, -1.0), 1.0 + 2.25 + 0.5, 1e-9);
  EXPECT_NEAR(left(2, 1.0, 1.0), 1.0 + 2.0, 1e-9);
  EXPECT_NEAR(left(2, 1.0, -1.0), 2.0 + 3.0 + 1.0, 1e-9);
  EXPECT_NEAR(left(1, 0.25, 1.0), 0.75 * 3.0 + 3.0, 1e-9);

  const Assembly heap = test::heap_on_cube();
  const auto fill = fill_grid(heap, test::heap_flowing(heap));
  EXPECT_NEAR(volume_of(deformed_faces(fill, Hidden({}), 0.0, cut_at(2, 0.5, 1.0))), 1.0 / 24.0, 1e-12);
  EXPECT_NEAR(volume_of(deformed_faces(fill, Hidden({}), 0.0, cut_at(1, 0.5, 1.0))), 1.0 / 6.0, 1e-12);
  EXPECT_NEAR(volume_of(deformed_faces(fill, Hidden({}), 0.0, cut_at(0, 0.25, -1.0))), 5.0 / 96.0, 1e-12);
}

/// A plane through faces of stones cuts none of them, and what only touches it is left out.
TEST(Scene, CutsAlongAJointTakeWholeStones) {
  const Assembly assembly = two_cubes();
  const auto grid = block_grid(assembly, rest_snapshot(assembly));
  EXPECT_EQ(deformed_faces(grid, Hidden({}), 0.0, cut_at(2, 1.0, 1.0))->GetNumberOfPolys(), 6);
  EXPECT_EQ(deformed_faces(grid, Hidden({}), 0.0, cut_at(2, 1.0 + 1e-8, 1.0))->GetNumberOfPolys(), 6);
  EXPECT_EQ(deformed_faces(grid, Hidden({}), 0.0, cut_at(2, 0.4, 1.0))->GetNumberOfPolys(), 12);
}

/// Between tetrahedra there is nothing to be seen, but where the plane takes one of them away.
TEST(Scene, CutsAlongFacesOfTetrahedraShowThem) {
  Assembly assembly;
  assembly.materials.push_back({});
  assembly.fill.nodes = {{0, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 0, 0}, {-1, 0, 0}};
  assembly.fill.tets = {{0, 1, 2, 3}, {0, 2, 1, 4}};
  assembly.fill.material = {0, 0};
  const auto grid = fill_grid(assembly, rest_snapshot(assembly));
  EXPECT_EQ(deformed_faces(grid, Hidden({}), 0.0)->GetNumberOfPolys(), 6);
  for (const double side : {1.0, -1.0})
    EXPECT_NEAR(volume_of(deformed_faces(grid, Hidden({}), 0.0, cut_at(0, 0.0, side))), 1.0 / 6.0, 1e-12);
}

/// The section moves with the material.
TEST(Scene, CutsAreMadeInTheAssemblyAsBuilt) {
  const Assembly assembly = test::heap_on_cube();
  const auto grid = fill_grid(assembly, test::heap_flowing(assembly));
  const auto faces = deformed_faces(grid, Hidden({}), 10.0, cut_at(2, 0.5, -1.0));
  Vec3 farthest = Vec3::Constant(-1e300);
  vtkNew<vtkIdList> ids;
  for (vtkIdType c = 0; c < faces->GetNumberOfPolys(); ++c) {
    faces->GetPolys()->GetCellAtId(c, ids);
    for (const vtkIdType i : *ids.GetPointer()) farthest = farthest.cwiseMax(Vec3(faces->GetPoint(i)));
  }
  EXPECT_NEAR(farthest.z(), 0.5, 1e-12);
  EXPECT_NEAR(farthest.x(), 0.75 + 0.5, 1e-12);  // at half its height it has moved half as far as its top, 10 × 0.1 m
}

TEST(Scene, CracksAreCutToo) {
  const Assembly assembly = two_cubes();
  Snapshot snapshot = rest_snapshot(assembly);
  snapshot.patches[0].bonded = 0.0;
  const auto joints = joint_polydata(assembly, snapshot);
  EXPECT_NEAR(area_of(crack_patches(joints, Hidden({}), 1.0, {}, cut_at(0, 0.25, 1.0))), 0.75, 1e-12);
  EXPECT_EQ(crack_patches(joints, Hidden({}), 1.0, {}, cut_at(2, 1.5, 1.0))->GetNumberOfPolys(), 0);
  EXPECT_EQ(crack_patches(joints, Hidden({}), 1.0, {}, cut_at(2, 1.0, 1.0))->GetNumberOfPolys(), 0) << "in the plane";
}

TEST(Cut, WordsAreRead) {
  const Box content{{0, -2, 0}, {20, 4, 8}};
  const auto cut = [&](const std::string& text, const std::string& view = "oblique") {
    return find_cut(text, find_view(view), content);
  };
  EXPECT_FALSE(cut(""));
  EXPECT_EQ(cut("y")->place, 1.0);
  EXPECT_EQ(cut("y")->axis, 1);
  EXPECT_EQ(cut("x=2.5")->place, 2.5);
  EXPECT_EQ(cut("x=2.5")->words(), "cut at x = 2.5 m");
  // What lies before the plane is left out: seen from above, what is above it; from the right, what is to the right.
  EXPECT_EQ(cut("y=1", "front")->side, 1.0);
  EXPECT_EQ(cut("x=1", "side")->side, -1.0);
  EXPECT_EQ(cut("z=1", "plan")->side, -1.0);
  EXPECT_EQ(cut("z=1")->side, -1.0);
  const auto message = [&](const std::string& text, const std::string& view = "oblique") {
    return message_of<InputError>([&] { cut(text, view); });
  };
  for (const char* text : {"w", "y=", "y=a", "y=1m", "y 1", "1", "y=nan", "y=1e999", "yy"})
    EXPECT_NE(message(text).find(fmt::format("the cut is '{}'; give an axis", text)), std::string::npos)
        << message(text);
  EXPECT_NE(message("y=4.5").find("reaches from -2.000 to 4.000 m"), std::string::npos) << message("y=4.5");
  EXPECT_NE(message("y=-2").find("meets nothing"), std::string::npos);
  EXPECT_NE(message("x=3", "front").find("give the view side or oblique"), std::string::npos);
}

/// Half of a face covered, half bare: the edge is outline where it is bare.
TEST(Scene, OuterOutlineIsCutWhereAJointEnds) {
  Assembly assembly;
  assembly.blocks.push_back(make_block(make_box({0, 0, 0}, {2, 1, 1}), Component::base, true));
  assembly.blocks.push_back(make_block(make_box({1, 0, 1}, {2, 1, 2}), Component::wall));
  finish(assembly);
  const Snapshot rest = rest_snapshot(assembly);
  const auto faces = deformed_faces(block_grid(assembly, rest), Hidden({}), 0.0);
  // An L in front and behind (2 + 2 + 1 + 1 + 1 + 1 m), six edges across; the re-entrant one is no edge of both faces.
  EXPECT_NEAR(length_of(outer_outline(faces, joint_polydata(assembly, rest))), 2 * 8.0 + 5 * 1.0, 1e-9);
}

TEST(Grid, OfAModeWarpsByTheRigidMotionOfEachStone) {
  const Assembly assembly = two_cubes();
  Mode mode;
  mode.shape = BlockMotions::Zero(2, 6);
  mode.shape.row(1) << 1, 0, 0, 0, 0.5, 0;  // moves along x and turns about y
  const auto grid = mode_grid(assembly, mode);
  vtkDataArray* shape = grid->GetPointData()->GetArray("mode_shape");
  ASSERT_NE(shape, nullptr);
  ASSERT_EQ(shape->GetNumberOfTuples(), grid->GetNumberOfPoints());
  for (vtkIdType i = 0; i < grid->GetNumberOfPoints(); ++i) {
    Vec3 x, u;
    grid->GetPoint(i, x.data());
    shape->GetTuple(i, u.data());
    const Vec3 arm = x - Vec3(0.5, 0.5, 1.5);
    const Vec3 expected = i < 8 ? Vec3(0, 0, 0) : Vec3(1 + 0.5 * arm.z(), 0, -0.5 * arm.x());
    EXPECT_NEAR((u - expected).norm(), 0.0, 1e-12) << i;
  }
}

TEST(Grid, OfAModeHasTheFillsMotion) {
  const Assembly assembly = test::heap_on_cube();
  Mode mode;
  mode.shape = BlockMotions::Zero(1, 6);
  EXPECT_NE(message_of<InputError>([&] { mode_fill_grid(assembly, mode); }).find("0 nodes of a fill"),
            std::string::npos);
  mode.nodes = NodeMotions::Random(6, 3);
  const auto grid = mode_fill_grid(assembly, mode);
  ASSERT_EQ(grid->GetNumberOfCells(), 4);
  for (vtkIdType i = 0; i < 6; ++i) {
    EXPECT_EQ(Vec3(grid->GetPoint(i)), assembly.fill.nodes[std::size_t(i)]);
    EXPECT_EQ(Vec3(grid->GetPointData()->GetArray("mode_shape")->GetTuple3(i)), Vec3(mode.nodes.row(i)));
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
