// The deformable fill of an assembly file.
#pragma once
#include "geometry/assembly.h"
#include "io/hdf5/h5.h"

namespace voussoir {

/// Reads the group fill, or an empty mesh where there is none. Checks indices, numbers, the shape of every tetrahedron,
/// faces, and that the triangles are the surface. Throws InputError naming file, dataset and row.
FillMesh read_fill(const h5::File& file, std::size_t materials);

/// Throws InputError naming the row of joints/* unless the patch is sound and lies on its triangle.
void check_fill_joint(const h5::File& file, std::size_t row, const Assembly& assembly, const FillJoint& joint);

/// Brings the patches into their order; throws InputError when one is listed twice.
void sort_fill_joints(const h5::File& file, std::vector<FillJoint>& joints);

}  // namespace voussoir
