// The data for ParaView and for the pictures of the program: stones and fill as unstructured grids, joint patches as
// polygons.
//
// Points are at their current, absolute place: x' = c + u + R (x − c) with centroid c, displacement u and rotation R of
// the block. The point array "displacement_of_point" is x' − x less the displacement of the base, so that
//   reference = point − displacement_of_point − base_displacement,
//   drawn = reference + amplification × displacement_of_point.
#pragma once
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include "geometry/assembly.h"
#include "solver/modal/modes.h"
#include "solver/step/snapshot.h"

namespace voussoir {

/// One cell for each block, in block order: a hexahedron if the stone has 8 vertices and 6 quadrilateral faces, else a
/// polyhedron of its outer faces. Cell data: block, component (index into component_names()), part, fixed, displacement
/// (m, absolute, of the centroid), rotation (rotation vector, rad), velocity (m/s), max_joint_opening and
/// max_joint_slip (m, largest since the start over the patches of the block). Point data: displacement_of_point (m).
/// Field data: TimeValue (s), base_displacement (m). Throws InputError if the snapshot is of another assembly.
vtkSmartPointer<vtkUnstructuredGrid> block_grid(const Assembly& assembly, const Snapshot& snapshot);

/// One polygon for each patch, in patch order. Cell data: opening, slip, largest_opening, largest_slip (m),
/// normal_traction, shear_traction (Pa, tension positive), eccentricity (over the depth), utilisation, bonded (share of
/// the area), had_bond, area (m2), tie, tie_yielded (m, plastic stretch of a tie), replaced, block_a, block_b,
/// component_a, component_b (−1 if the second body is not a block); for their meaning see PatchSnapshot. Point and
/// field data as block_grid(); the displacement of a corner is the mean of both blocks. Throws InputError if the
/// snapshot is of another assembly.
vtkSmartPointer<vtkPolyData> joint_polydata(const Assembly& assembly, const Snapshot& snapshot);

/// The deformable fill: its nodes and tetrahedra in the order of FillMesh; without a fill no cells. Point data:
/// displacement (m, absolute), displacement_of_point (m, as above), velocity (m/s). Cell data: component (that of
/// backfill), material (of the assembly), stress (Pa, Cauchy, tension positive, six numbers XX YY ZZ XY YZ XZ: VTK's
/// order of a symmetric tensor), mean_stress (Pa, their trace over 3), plastic_shear_strain, plastic_volumetric_strain,
/// yields_now and has_yielded (0 no, 1 in shear, 2 in tension, 3 both). Field data as block_grid(). Throws InputError
/// if the snapshot is of another assembly.
vtkSmartPointer<vtkUnstructuredGrid> fill_grid(const Assembly& assembly, const Snapshot& snapshot);

/// The stones of the assembly as built, with a mode: point data mode_shape, cell data mode_displacement and
/// mode_rotation (1/m). They are scaled so that the largest displacement of a centroid or of a node is 1. The mode must
/// be of this assembly.
vtkSmartPointer<vtkUnstructuredGrid> mode_grid(const Assembly& assembly, const Mode& mode);
/// The same for the fill, without cell data. Throws InputError if the mode is of another fill.
vtkSmartPointer<vtkUnstructuredGrid> mode_fill_grid(const Assembly& assembly, const Mode& mode);

/// The assembly as built: no displacement, every joint closed, and bonded if its law is elastic or has tension or
/// cohesion; no patches and no stress of the fill.
Snapshot rest_snapshot(const Assembly& assembly);

}  // namespace voussoir
