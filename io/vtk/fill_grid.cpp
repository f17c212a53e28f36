// The deformable fill as a grid of tetrahedra.
#include <vtkCellData.h>
#include <vtkDoubleArray.h>
#include <vtkIntArray.h>
#include <vtkPointData.h>
#include <vtkUnsignedCharArray.h>

#include "io/vtk/grid.h"
#include "io/vtk/grid_arrays.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"
#include "solver/model/fill_memory.h"

namespace voussoir {
namespace {

void check(const FillMesh& mesh, const FillSnapshot& fill) {
  if (fill.displacement.size() != mesh.nodes.size() || fill.velocity.size() != mesh.nodes.size() ||
      fill.tets.size() != mesh.tets.size())
    throw InputError(
        "pictures: the fill of the state has {} and {}, but that of the assembly has {} and {}. Use state "
        "and assembly of the same run.",
        counted(fill.displacement.size(), "node"), counted(fill.tets.size(), "tetrahedron", "tetrahedra"),
        mesh.nodes.size(), mesh.tets.size());
}

void add_points(vtkUnstructuredGrid* grid, const FillMesh& mesh, const Snapshot& snapshot) {
  const FillSnapshot& fill = snapshot.fill;
  const auto n = vtkIdType(mesh.nodes.size());
  auto points = make_points();
  points->SetNumberOfPoints(n);
  auto displacement = make_array<vtkDoubleArray>("displacement", n, 3);
  auto relative = make_array<vtkDoubleArray>("displacement_of_point", n, 3);
  auto velocity = make_array<vtkDoubleArray>("velocity", n, 3);
  for (vtkIdType i = 0; i < n; ++i) {
    const Vec3& u = fill.displacement[std::size_t(i)];
    points->SetPoint(i, Vec3(mesh.nodes[std::size_t(i)] + u).data());
    displacement->SetTuple(i, u.data());
    relative->SetTuple(i, Vec3(u - snapshot.base_displacement).data());
    velocity->SetTuple(i, fill.velocity[std::size_t(i)].data());
  }
  grid->SetPoints(points);
  for (vtkDataArray* array : std::initializer_list<vtkDataArray*>{displacement, relative, velocity})
    grid->GetPointData()->AddArray(array);
}

void add_cells(vtkUnstructuredGrid* grid, const FillMesh& mesh) {
  grid->Allocate(vtkIdType(mesh.tets.size()));
  for (const auto& tet : mesh.tets) {  // of positive volume: VTK's order of the corners
    const vtkIdType corners[4] = {tet[0], tet[1], tet[2], tet[3]};
    grid->InsertNextCell(VTK_TETRA, 4, corners);
  }
}

/// 0 no, 1 in shear, 2 in tension, 3 both.
unsigned char yield_number(std::uint8_t bits, std::uint8_t shear, std::uint8_t tension) {
  return static_cast<unsigned char>((bits & shear ? 1 : 0) + (bits & tension ? 2 : 0));
}

void add_cell_fields(vtkUnstructuredGrid* grid, const FillMesh& mesh, const std::vector<TetSnapshot>& tets) {
  const auto n = vtkIdType(tets.size());
  auto component = make_array<vtkIntArray>("component", n), material = make_array<vtkIntArray>("material", n);
  auto stress = make_array<vtkDoubleArray>("stress", n, 6);
  constexpr const char* names[6] = {"XX", "YY", "ZZ", "XY", "YZ", "XZ"};
  for (int c = 0; c < 6; ++c) stress->SetComponentName(c, names[c]);
  auto mean = make_array<vtkDoubleArray>("mean_stress", n);
  auto shear = make_array<vtkDoubleArray>("plastic_shear_strain", n);
  auto volume = make_array<vtkDoubleArray>("plastic_volumetric_strain", n);
  auto now = make_array<vtkUnsignedCharArray>("yields_now", n),
       ever = make_array<vtkUnsignedCharArray>("has_yielded", n);
  for (vtkIdType i = 0; i < n; ++i) {
    const TetSnapshot& tet = tets[std::size_t(i)];
    component->SetValue(i, int(Component::backfill));
    material->SetValue(i, mesh.material[std::size_t(i)]);
    stress->SetTuple(i, tet.stress.data());
    mean->SetValue(i, (tet.stress[0] + tet.stress[1] + tet.stress[2]) / 3.0);
    shear->SetValue(i, tet.plastic_shear);
    volume->SetValue(i, tet.plastic_volume);
    now->SetValue(i, yield_number(tet.yield, yields_in_shear, yields_in_tension));
    ever->SetValue(i, yield_number(tet.yield, has_yielded_in_shear, has_yielded_in_tension));
  }
  for (vtkDataArray* array :
       std::initializer_list<vtkDataArray*>{component, material, stress, mean, shear, volume, now, ever})
    grid->GetCellData()->AddArray(array);
}

}  // namespace

vtkSmartPointer<vtkUnstructuredGrid> fill_grid(const Assembly& assembly, const Snapshot& snapshot) {
  check(assembly.fill, snapshot.fill);
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  add_points(grid, assembly.fill, snapshot);
  add_cells(grid, assembly.fill);
  add_cell_fields(grid, assembly.fill, snapshot.fill.tets);
  add_field_data(grid, snapshot);
  return grid;
}

vtkSmartPointer<vtkUnstructuredGrid> mode_fill_grid(const Assembly& assembly, const Mode& mode) {
  const auto n = vtkIdType(assembly.fill.nodes.size());
  if (mode.nodes.rows() != n)
    throw InputError(
        "modes: the mode has {} nodes of a fill, but the assembly has {}. Use mode and assembly of the same analysis.",
        mode.nodes.rows(), n);
  const Snapshot rest = rest_snapshot(assembly);
  auto grid = vtkSmartPointer<vtkUnstructuredGrid>::New();
  add_points(grid, assembly.fill, rest);
  add_cells(grid, assembly.fill);
  add_field_data(grid, rest);
  auto shape = make_array<vtkDoubleArray>("mode_shape", n, 3);
  for (vtkIdType i = 0; i < n; ++i) shape->SetTuple(i, Vec3(mode.nodes.row(i)).data());
  grid->GetPointData()->AddArray(shape);
  grid->GetPointData()->SetActiveVectors("mode_shape");
  return grid;
}

}  // namespace voussoir
