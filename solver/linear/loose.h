// What nothing holds: blocks and groups of blocks that could move without straining any joint. They would fill the
// modes with motions of no frequency.
#pragma once
#include "solver/linear/block_matrix.h"

namespace voussoir {

struct Loose {
  std::vector<bool> adrift;          // per site: in a part that nothing ties to what is fixed
  std::vector<std::int32_t> bodies;  // sites adrift, ascending
  std::vector<std::int32_t> partly;  // sites tied, but free to move some way while all others stand still
};

/// Finds both from the material stiffness. Where nothing at all is fixed, or tied to what is, the heaviest connected
/// part stands for the assembly and is not adrift.
Loose find_loose(const BlockMatrix& k, const BlockMatrix& m, const Unknowns& unknowns);

/// Holds the free ways of the partly loose sites in the material stiffness so firmly that they leave the lowest modes.
/// All other eigenpairs stay what they are: a motion v of one site with K v = 0 is an eigenvector, λ = 0, and so
/// M-orthogonal to the others, which M v vᵀ M therefore does not touch. Returns how many ways are held.
int hold_free_ways(BlockMatrix& k, const BlockMatrix& m, const Unknowns& unknowns, const Loose& loose);

}  // namespace voussoir
