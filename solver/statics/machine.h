// A testing machine: its head pushes a load pattern through a stiff spring, so that the path beyond the largest load
// can be followed.
#pragma once
#include "solver/statics/pattern.h"

namespace voussoir {

/// The multiplier of the pattern is λ = stiffness (head − a), a the displacement along the pattern since the reference
/// placement (pattern_displacement()). With a fixed head, a structure whose load decreases is stable as long as the
/// decrease is less steep than the spring.
struct Machine {
  LoadsAtWork pattern;     // one_a_point(); `from` at multiplier 0, `to` at 1
  double head = 0.0;       // m, since the reference placement
  double stiffness = 0.0;  // 1/m; chosen by brace()
  double multiplier = 0.0;

  /// Chooses the stiffness of the spring for a relaxation. relax() has given each body of `model` an inertia in its
  /// fictitious time that is at least its own block of K, so that the inertia stands for the stiffness. The spring has
  /// a quarter of the stiffness of the loaded body or node with the least stiffness for its load. The function
  /// increases the inertia of the loaded bodies and nodes accordingly: (Σ wᵢ uᵢ)² ≤ Σ |wᵢ| uᵢ², where uᵢ are their
  /// displacements and wᵢ their shares of the pattern, Σ |wᵢ| = 1.
  void brace(Model& model);
  /// Computes the multiplier at the present placement and sets the corresponding loads.
  void push(const Model& model, const State& state, LoadsAtWork& loads);
};

}  // namespace voussoir
