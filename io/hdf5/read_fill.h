// The deformable fill of an assembly file.
#pragma once
#include "geometry/assembly.h"
#include "io/hdf5/h5.h"

namespace voussoir {

/// Reads the group fill; without it the mesh is empty. Checks indices, numbers, the shape of every tetrahedron,
/// faces, and that the triangles are the surface. Throws InputError with file, dataset and row.
FillMesh read_fill(const h5::File& file, std::size_t materials);

/// Throws InputError with the row of joints/* if the patch is not valid or not on its triangle.
void check_fill_joint(const h5::File& file, std::size_t row, const Assembly& assembly, const FillJoint& joint);

/// Sorts the patches. Throws InputError if one is listed twice.
void sort_fill_joints(const h5::File& file, std::vector<FillJoint>& joints);

}  // namespace voussoir
