// The critical time step, 2/ω_max of the intact assembly, by Lanczos's method.
#pragma once
#include "solver/linear/unknowns.h"
#include "solver/model/state.h"

namespace voussoir {

struct CriticalStep {
  double step = 0.0;        // s, undamped
  double highest = 0.0;     // rad/s
  std::int32_t body = -1;   // the body with the most kinetic energy in the highest mode
  std::int32_t node = -1;   // of the mesh of the fill, if a node has more than any body; else −1
  std::int64_t patch = -1;  // the stiffest joint of that body, index in Model::joints; −1: none
};

/// Largest Ritz value after at most 100 products with K (and as many for its vector), stopped when it grows by less
/// than 1e-4 in five. It approaches ω_max from below; the safety factor of the time step covers the difference. Without
/// any stiffness the result keeps its initial values (step 0).
CriticalStep critical_step(const Model& model, const State& state);
/// The same with only these unknowns; the others are held.
CriticalStep critical_step(const Model& model, const State& state, const Unknowns& unknowns);

}  // namespace voussoir
