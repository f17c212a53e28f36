// Loose blocks and groups of blocks, which could move without deforming any joint. They would give modes with zero
// frequency.
#pragma once
#include "solver/linear/block_matrix.h"

namespace voussoir {

struct Loose {
  std::vector<bool> adrift;          // for each site: it is in a part without connection to a fixed block
  std::vector<std::int32_t> bodies;  // sites adrift, ascending
  std::vector<std::int32_t> partly;  // connected sites that can move freely in some direction while all others are held
};

/// Finds both from the material stiffness. If nothing is fixed or connected to a fixed block, the heaviest connected
/// part represents the assembly and is not adrift.
Loose find_loose(const BlockMatrix& k, const BlockMatrix& m, const Unknowns& unknowns);

/// Adds stiffness for the free directions of the partly loose sites, so that they do not appear in the lowest modes.
/// All other eigenpairs are unchanged: a motion v of one site with K v = 0 is an eigenvector with λ = 0 and
/// M-orthogonal to the others, so M v vᵀ M does not change them. Returns the number of held directions.
int hold_free_ways(BlockMatrix& k, const BlockMatrix& m, const Unknowns& unknowns, const Loose& loose);

}  // namespace voussoir
