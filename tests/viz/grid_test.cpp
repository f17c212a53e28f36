// Grids for ParaView: cells, fields and displaced points.
#include "io/vtk/grid.h"

#include <gtest/gtest.h>
#include <vtkCellData.h>
#include <vtkFieldData.h>
#include <vtkPointData.h>

#include <set>

#include "io/vtk/block_shape.h"
#include "solver/base/error.h"
#include "tests/folder.h"
#include "tests/viz/grid_shapes.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::cell_volume, test::mixed_shapes;
using test::Folder;
using test::message_of;
using test::two_cubes;

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
  patch.eccentricity = 0.25, patch.utilisation = 0.5;
  const auto data = joint_polydata(assembly, snapshot);
  ASSERT_EQ(data->GetNumberOfPolys(), 1);
  const auto value = [&](const char* name) { return data->GetCellData()->GetArray(name)->GetComponent(0, 0); };
  EXPECT_EQ(value("opening"), 0.1);
  EXPECT_EQ(value("normal_traction"), -2e5);
  EXPECT_EQ(value("eccentricity"), 0.25);
  EXPECT_EQ(value("utilisation"), 0.5);
  EXPECT_EQ(value("tie"), 0.0);
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
  EXPECT_NE(message_of<InputError>([&] { block_grid(two, snapshot); }).find("1 block, but the assembly has 2"),
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
            }).find("6 nodes and 3 tetrahedra, but that of the assembly has 6 and 4"),
            std::string::npos);
  EXPECT_EQ(fill_grid(test::two_cubes(), rest_snapshot(test::two_cubes()))->GetNumberOfCells(), 0);
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
