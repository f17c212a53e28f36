// What ParaView and our own pictures are made from: stones and the fill as unstructured grids, joint patches as
// polygons.
//
// Points are at their present, absolute place: x' = c + u + R (x − c) with the block's centroid c, displacement u and
// rotation R. The point array "displacement_of_point" is x' − x less the base's displacement, so that
//   reference = point − displacement_of_point − base_displacement,   drawn = reference + amplification × displacement.
#pragma once
#include <vtkPolyData.h>
#include <vtkSmartPointer.h>
#include <vtkUnstructuredGrid.h>

#include "geometry/assembly.h"
#include "solver/modal/modes.h"
#include "solver/step/snapshot.h"

namespace voussoir {

/// One cell a block, in block order: a hexahedron when the stone has 8 vertices and 6 quadrilateral faces, else a
/// polyhedron of its outer faces. Cell data: block, component (index into component_names()), part, fixed, displacement
/// (m, absolute, of the centroid), rotation (rotation vector, rad), velocity (m/s), max_joint_opening and
/// max_joint_slip (m, largest since the start over the block's patches). Point data: displacement_of_point (m). Field
/// data: TimeValue (s), base_displacement (m). Throws InputError when the snapshot is not one of this assembly.
vtkSmartPointer<vtkUnstructuredGrid> block_grid(const Assembly& assembly, const Snapshot& snapshot);

/// One polygon a patch, in patch order. Cell data: opening, slip, largest_opening, largest_slip (m), normal_traction,
/// shear_traction (Pa, tension positive), eccentricity (over the depth), utilisation, bonded (share of the area),
/// had_bond, area (m2), block_a, block_b, component_a, component_b (−1 where the second body is not a block). Point and
/// field data as block_grid(); a corner's displacement is the mean over the two blocks.
vtkSmartPointer<vtkPolyData> joint_polydata(const Assembly& assembly, const Snapshot& snapshot);

/// The deformable fill: its nodes and tetrahedra in the order of FillMesh, no cell without one. Point data:
/// displacement (m, absolute), displacement_of_point (m, as above), velocity (m/s). Cell data: component (that of
/// backfill), material (of the assembly), stress (Pa, Cauchy, tension positive, six numbers XX YY ZZ XY YZ XZ: VTK's
/// order of a symmetric tensor), mean_stress (Pa, their trace over 3), plastic_shear_strain, plastic_volumetric_strain,
/// yields_now and has_yielded (0 no, 1 in shear, 2 in tension, 3 both). Field data as block_grid(). Throws InputError
/// when the snapshot is not one of this assembly.
vtkSmartPointer<vtkUnstructuredGrid> fill_grid(const Assembly& assembly, const Snapshot& snapshot);

/// The stones of the assembly as built, with a mode to warp them by: point data mode_shape (largest displacement of a
/// centroid or node 1), cell data mode_displacement and mode_rotation (1/m).
vtkSmartPointer<vtkUnstructuredGrid> mode_grid(const Assembly& assembly, const Mode& mode);
/// The same of the fill, without cell data of its own. Throws InputError when the mode is not one of this fill.
vtkSmartPointer<vtkUnstructuredGrid> mode_fill_grid(const Assembly& assembly, const Mode& mode);

/// The assembly as built: nothing displaced, every joint closed and bonded where its law has tension or cohesion, the
/// fill without stress.
Snapshot rest_snapshot(const Assembly& assembly);

}  // namespace voussoir
