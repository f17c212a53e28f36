// Stiffness of the fill and of its interface with the stones, from the same elements and points as the explicit step.
#pragma once
#include "solver/linear/stiffness.h"

namespace voussoir {

/// Pairs of sites that the fill's elements and interface couple. Nodes of the fill are sites after the bodies. Through
/// the mean volumetric strain about a node all nodes of the elements around it know of each other.
void couple_fill(const Model& model, const State& state, std::vector<std::pair<std::int32_t, std::int32_t>>& coupled);
/// Elastic, at the present placement.
void add_fill(const Model& model, const State& state, BlockMatrix& k);
void add_interface(const Model& model, const State& state, PatchTangent kind, BlockMatrix& k);

}  // namespace voussoir
