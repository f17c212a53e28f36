// Stiffness and mass matrices of an assembly with all joints and fill patches intact, directly from the assembly and
// without the model of a run.
#pragma once
#include "solver/diagnosis/contributions.h"

namespace voussoir {

struct LinearModel {
  Unknowns unknowns;  // sites are the blocks of the assembly, then the nodes of its fill
  SparseMatrix k, m;  // lower triangles; degrees of freedom that nothing holds are held as in solver/linear/loose.h
};
/// Throws InputError if no joint holds anything.
LinearModel linear_model(const Assembly& assembly);
/// The same from the contributions() of the assembly.
LinearModel linear_model(const Assembly& assembly, const Contributions& parts);

}  // namespace voussoir
