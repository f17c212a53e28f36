// What pictures are made of: faces, outlines and cuts.
#include "viz/scene.h"

#include <gtest/gtest.h>
#include <vtkIdList.h>
#include <vtkNew.h>

#include "io/vtk/grid.h"
#include "solver/base/error.h"
#include "tests/folder.h"
#include "tests/viz/grid_shapes.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::finish, test::make_block, test::two_cubes;
using test::message_of, test::mixed_shapes;

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
    EXPECT_NE(message(text).find(fmt::format("the cut is '{}'. Give an axis", text)), std::string::npos)
        << message(text);
  EXPECT_NE(message("y=4.5").find("extends from -2.000 to 4.000 m"), std::string::npos) << message("y=4.5");
  EXPECT_NE(message("y=-2").find("does not intersect the model"), std::string::npos);
  EXPECT_NE(message("x=3", "front").find("Give the view side or oblique"), std::string::npos);
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
}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
