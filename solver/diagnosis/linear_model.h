// Stiffness and mass of an assembly whose joints, and patches with a deformable fill, are all intact, straight from
// the assembly, without building a model for runs.
#pragma once
#include "solver/diagnosis/contributions.h"

namespace voussoir {

struct LinearModel {
  Unknowns unknowns;  // sites are the assembly's blocks, then the nodes of its fill
  SparseMatrix k, m;  // lower triangles; ways that nothing holds are held as in solver/linear/loose.h
};
/// Throws InputError when nothing is held together.
LinearModel linear_model(const Assembly& assembly);
/// The same of an assembly whose contributions() these are.
LinearModel linear_model(const Assembly& assembly, const Contributions& parts);

}  // namespace voussoir
