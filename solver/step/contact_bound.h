// Bounds that show whether new contacts can have lowered the critical time step.
#pragma once
#include "solver/step/stepper.h"

namespace voussoir {

/// The largest among some bodies of Σ over a body's patches of stiffness over mass, 1/s2. Bodies with a bound below the
/// largest of the assembly cannot have lowered the critical time step. Most new contacts therefore need no new
/// eigenvalue computation.
class ContactBound {
 public:
  double of(const Stepper& stepper, const std::vector<std::int32_t>& bodies);
  double of_bodies(const Stepper& stepper);  // all
  /// The same for nodes of the fill, from the elements around them and their patches with stones.
  double of(const Model& model, const State& state, const std::vector<std::int32_t>& nodes);
  double of_nodes(const Stepper& stepper);  // all

 private:
  std::vector<double> elements_;                   // N/m, of each node; computed at the first use
  std::vector<std::vector<std::int32_t>> joints_;  // of each body, in the order of the assembly; computed at the first
                                                   // use
};

}  // namespace voussoir
