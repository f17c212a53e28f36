// A deformable fill from its section: triangles in the plane x-z, swept across into tetrahedra.
#pragma once
#include "geometry/fill_columns.h"

namespace voussoir {

/// Sweeps a section into tetrahedra with edges of at most `edge` m, if those of the section keep section_bound(), in
/// layers of at most `layer` m. A fill that is symmetric about y = 0 gets a symmetric mesh. The tetrahedra are
/// oriented, the surface is set, and every tetrahedron has the material of its triangle.
FillMesh sweep(const FillSection& section, double edge, double layer);

}  // namespace voussoir
