// A loading machine: a pattern of loads pushed by a head through a stiff spring, so that what follows the largest load
// can be followed too.
#pragma once
#include "solver/statics/pattern.h"

namespace voussoir {

/// The multiplier of the pattern is λ = stiffness (head − a), a the displacement along the pattern since the reference
/// placement (pattern_displacement()). With the head held a structure whose load falls as it goes on is stable while it
/// falls less steeply than the spring.
struct Machine {
  LoadsAtWork pattern;     // one_a_point(); `from` at multiplier 0, `to` at 1
  double head = 0.0;       // m, since the reference placement
  double stiffness = 0.0;  // 1/m; chosen by brace()
  double multiplier = 0.0;

  /// Chooses a spring a quarter as stiff as what holds the loaded body or node that is held least for its load, in a
  /// relaxation of inertia of its own (`model`, M ≥ K), and makes the loaded ones heavier by what it asks for:
  /// (Σ wᵢ uᵢ)² ≤ Σ |wᵢ| uᵢ², with Σ |wᵢ| = 1.
  void brace(Model& model);
  /// The multiplier at the present placement, and the loads that go with it.
  void push(const Model& model, const State& state, LoadsAtWork& loads);
};

}  // namespace voussoir
