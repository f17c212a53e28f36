#include "io/vtk/grid.h"

#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkFieldData.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkTypeInt64Array.h>
#include <vtkUnsignedCharArray.h>

#include <algorithm>

#include "io/vtk/block_shape.h"
#include "io/vtk/grid_arrays.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {
namespace {

void check(const Assembly& assembly, const Snapshot& snapshot) {
  const std::size_t blocks = assembly.blocks.size();
  if (snapshot.displacement.size() != blocks || snapshot.rotation.size() != blocks ||
      snapshot.velocity.size() != blocks)
    throw InputError("pictures: the state has {}, but the assembly has {}. Use state and assembly of the same run.",
                     counted(snapshot.displacement.size(), "block"), blocks);
  for (const auto& patch : snapshot.patches)
    if (patch.a < 0 || patch.a >= std::int64_t(blocks) || patch.b >= std::int64_t(blocks))
      throw InputError(
          "pictures: a joint patch of the state names blocks {} and {}, but the assembly has {}. Use state and "
          "assembly of the same run.",
          patch.a, patch.b, counted(blocks, "block"));
}

Vec3 moved_point(const Block& block, const Snapshot& snapshot, std::size_t i, const Vec3& x) {
  return block.centroid + snapshot.displacement[i] + snapshot.rotation[i] * (x - block.centroid);
}

/// The place in the assembly as built of a point of block i that is at `x` now.
Vec3 reference_point(const Block& block, const Snapshot& snapshot, std::size_t i, const Vec3& x) {
  return block.centroid + snapshot.rotation[i].conjugate() * (x - block.centroid - snapshot.displacement[i]);
}

Vec3 rotation_vector(const Eigen::Quaterniond& rotation) {
  const Eigen::AngleAxisd turn(rotation.normalized());
  return turn.angle() * turn.axis();
}

void insert_cell(vtkUnstructuredGrid* grid, const Polyhedron& shape, vtkIdType first) {
  if (const auto order = hexahedron_order(shape)) {
    vtkIdType ids[8];
    for (int k = 0; k < 8; ++k) ids[k] = first + (*order)[k];
    grid->InsertNextCell(VTK_HEXAHEDRON, 8, ids);
    return;
  }
  std::vector<vtkIdType> ids, faces;
  for (std::size_t v = 0; v < shape.vertices.size(); ++v) ids.push_back(first + vtkIdType(v));
  for (const auto& loop : shape.faces) {
    faces.push_back(vtkIdType(loop.size()));
    for (int v : loop) faces.push_back(first + v);
  }
  grid->InsertNextCell(VTK_POLYHEDRON, vtkIdType(ids.size()), ids.data(), vtkIdType(shape.faces.size()), faces.data());
}

void add_block_fields(vtkUnstructuredGrid* grid, const Assembly& assembly, const Snapshot& snapshot) {
  const vtkIdType n = vtkIdType(assembly.blocks.size());
  auto id = make_array<vtkTypeInt64Array>("block", n);
  auto component = make_array<vtkIntArray>("component", n), part = make_array<vtkIntArray>("part", n);
  auto fixed = make_array<vtkUnsignedCharArray>("fixed", n);
  auto displacement = make_array<vtkDoubleArray>("displacement", n, 3);
  auto rotation = make_array<vtkDoubleArray>("rotation", n, 3);
  auto velocity = make_array<vtkDoubleArray>("velocity", n, 3);
  auto opening = make_array<vtkDoubleArray>("max_joint_opening", n);
  auto slip = make_array<vtkDoubleArray>("max_joint_slip", n);
  for (vtkIdType i = 0; i < n; ++i) {
    const Block& block = assembly.blocks[i];
    id->SetValue(i, i);
    component->SetValue(i, int(block.component));
    part->SetValue(i, block.part);
    fixed->SetValue(i, block.fixed ? 1 : 0);
    displacement->SetTuple(i, snapshot.displacement[i].data());
    rotation->SetTuple(i, rotation_vector(snapshot.rotation[i]).data());
    velocity->SetTuple(i, snapshot.velocity[i].data());
    opening->SetValue(i, 0.0);
    slip->SetValue(i, 0.0);
  }
  for (const auto& patch : snapshot.patches)
    for (const std::int64_t i : {patch.a, patch.b}) {
      if (i < 0) continue;  // the fill
      opening->SetValue(i, std::max(opening->GetValue(i), patch.largest_opening));
      slip->SetValue(i, std::max(slip->GetValue(i), patch.largest_slip));
    }
  for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{id, component, part, fixed, displacement, rotation,
                                                                  velocity, opening, slip})
    grid->GetCellData()->AddArray(array);
}

/// Displacement since the assembly of a patch corner at `x`, relative to the base: mean over the two bodies.
Vec3 corner_displacement(const Assembly& assembly, const Snapshot& snapshot, const PatchSnapshot& patch,
                         const Vec3& x) {
  const Vec3 a = reference_point(assembly.blocks[patch.a], snapshot, patch.a, x);
  const Vec3 b = patch.b < 0 ? a : reference_point(assembly.blocks[patch.b], snapshot, patch.b, x);
  return x - 0.5 * (a + b) - snapshot.base_displacement;
}

void add_patch_fields(vtkPolyData* data, const Assembly& assembly, const Snapshot& snapshot) {
  const vtkIdType n = vtkIdType(snapshot.patches.size());
  const auto number = [&](const char* name, auto value) {
    auto array = make_array<vtkDoubleArray>(name, n);
    for (vtkIdType i = 0; i < n; ++i) array->SetValue(i, value(snapshot.patches[i]));
    data->GetCellData()->AddArray(array);
  };
  const auto whole = [&]<class ArrayType>(vtkSmartPointer<ArrayType> array, auto value) {
    for (vtkIdType i = 0; i < n; ++i) array->SetValue(i, value(snapshot.patches[i]));
    data->GetCellData()->AddArray(array);
  };
  const auto component = [&](std::int64_t block) { return block < 0 ? -1 : int(assembly.blocks[block].component); };
  number("opening", [](const auto& p) { return p.opening; });
  number("slip", [](const auto& p) { return p.slip; });
  number("largest_opening", [](const auto& p) { return p.largest_opening; });
  number("largest_slip", [](const auto& p) { return p.largest_slip; });
  number("normal_traction", [](const auto& p) { return p.normal_traction; });
  number("shear_traction", [](const auto& p) { return p.shear_traction; });
  number("eccentricity", [](const auto& p) { return p.eccentricity; });
  number("utilisation", [](const auto& p) { return p.utilisation; });
  number("bonded", [](const auto& p) { return p.bonded; });
  number("area", [](const auto& p) { return p.area; });
  whole(make_array<vtkUnsignedCharArray>("had_bond", n), [](const auto& p) { return p.had_bond ? 1 : 0; });
  number("tie_yielded", [](const auto& p) { return p.yielded; });
  whole(make_array<vtkUnsignedCharArray>("tie", n), [](const auto& p) { return p.tie ? 1 : 0; });
  whole(make_array<vtkUnsignedCharArray>("replaced", n), [](const auto& p) { return p.replaced ? 1 : 0; });
  whole(make_array<vtkTypeInt64Array>("block_a", n), [](const auto& p) { return p.a; });
  whole(make_array<vtkTypeInt64Array>("block_b", n), [](const auto& p) { return p.b; });
  whole(make_array<vtkIntArray>("component_a", n), [&](const auto& p) { return component(p.a); });
  whole(make_array<vtkIntArray>("component_b", n), [&](const auto& p) { return component(p.b); });
}

vtkSmartPointer<vtkDoubleArray> displacement_array() {
  return make_array<vtkDoubleArray>("displacement_of_point", 0, 3);
}

}  // namespace

void add_field_data(vtkDataObject* data, const Snapshot& snapshot) {
  auto time = make_array<vtkDoubleArray>("TimeValue", 1);
  time->SetValue(0, snapshot.time);
  auto base = make_array<vtkDoubleArray>("base_displacement", 1, 3);
  base->SetTuple(0, snapshot.base_displacement.data());
  data->GetFieldData()->AddArray(time);
  data->GetFieldData()->AddArray(base);
}

vtkSmartPointer<vtkUnstructuredGrid> block_grid(const Assembly& assembly, const Snapshot& snapshot) {
  check(assembly, snapshot);
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  auto points = make_points();
  auto displacement = displacement_array();
  grid->Allocate(vtkIdType(assembly.blocks.size()));
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    const Block& block = assembly.blocks[i];
    const Polyhedron shape = outer_surface(block);
    const vtkIdType first = points->GetNumberOfPoints();
    for (const Vec3& x : shape.vertices) {
      const Vec3 now = moved_point(block, snapshot, i, x);
      points->InsertNextPoint(now.data());
      displacement->InsertNextTuple(Vec3(now - x - snapshot.base_displacement).data());
    }
    insert_cell(grid, shape, first);
  }
  grid->SetPoints(points);
  grid->GetPointData()->AddArray(displacement);
  add_block_fields(grid, assembly, snapshot);
  add_field_data(grid, snapshot);
  return grid;
}

vtkSmartPointer<vtkUnstructuredGrid> mode_grid(const Assembly& assembly, const Mode& mode) {
  const auto grid = block_grid(assembly, rest_snapshot(assembly));
  const vtkIdType n = vtkIdType(assembly.blocks.size());
  auto displacement = make_array<vtkDoubleArray>("mode_displacement", n, 3);
  auto rotation = make_array<vtkDoubleArray>("mode_rotation", n, 3);
  auto shape = make_array<vtkDoubleArray>("mode_shape", grid->GetNumberOfPoints(), 3);
  vtkIdType point = 0;
  for (vtkIdType i = 0; i < n; ++i) {
    const Vec3 u = mode.shape.row(i).head<3>(), turn = mode.shape.row(i).tail<3>();
    displacement->SetTuple(i, u.data());
    rotation->SetTuple(i, turn.data());
    const vtkIdType corners = grid->GetCell(i)->GetNumberOfPoints();  // block_grid() shares none between stones
    for (const vtkIdType end = point + corners; point < end; ++point) {
      Vec3 x;
      grid->GetPoint(point, x.data());
      shape->SetTuple(point, Vec3(u + turn.cross(x - assembly.blocks[std::size_t(i)].centroid)).data());
    }
  }
  grid->GetCellData()->AddArray(displacement);
  grid->GetCellData()->AddArray(rotation);
  grid->GetPointData()->AddArray(shape);
  grid->GetPointData()->SetActiveVectors("mode_shape");
  return grid;
}

vtkSmartPointer<vtkPolyData> joint_polydata(const Assembly& assembly, const Snapshot& snapshot) {
  check(assembly, snapshot);
  auto data = vtkSmartPointer<vtkPolyData>::New();
  auto points = make_points();
  auto displacement = displacement_array();
  auto polygons = vtkSmartPointer<vtkCellArray>::New();
  for (const auto& patch : snapshot.patches) {
    polygons->InsertNextCell(int(patch.polygon.size()));
    for (const Vec3& x : patch.polygon) {
      polygons->InsertCellPoint(points->InsertNextPoint(x.data()));
      displacement->InsertNextTuple(corner_displacement(assembly, snapshot, patch, x).data());
    }
  }
  data->SetPoints(points);
  data->SetPolys(polygons);
  data->GetPointData()->AddArray(displacement);
  add_patch_fields(data, assembly, snapshot);
  add_field_data(data, snapshot);
  return data;
}

Snapshot rest_snapshot(const Assembly& assembly) {
  Snapshot snapshot;
  snapshot.displacement.assign(assembly.blocks.size(), Vec3::Zero());
  snapshot.rotation.assign(assembly.blocks.size(), Eigen::Quaterniond::Identity());
  snapshot.velocity.assign(assembly.blocks.size(), Vec3::Zero());
  for (const Joint& joint : assembly.joints) {
    PatchSnapshot patch;
    patch.a = joint.a, patch.b = joint.b;
    patch.polygon = joint.polygon;
    patch.normal = joint.normal;
    patch.area = joint.area;
    const JointLaw law = std::size_t(joint.law) < assembly.laws.size() ? assembly.laws[joint.law] : JointLaw{};
    patch.had_bond = law.kind == JointLaw::Kind::elastic || law.tension > 0.0 || law.cohesion > 0.0;
    patch.bonded = patch.had_bond ? 1.0 : 0.0;
    snapshot.patches.push_back(patch);
  }
  snapshot.fill.displacement.assign(assembly.fill.nodes.size(), Vec3::Zero());
  snapshot.fill.velocity.assign(assembly.fill.nodes.size(), Vec3::Zero());
  snapshot.fill.tets.resize(assembly.fill.tets.size());
  return snapshot;
}

}  // namespace voussoir
