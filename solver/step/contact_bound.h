// Whether new contacts may have lowered the critical step.
#pragma once
#include "solver/step/stepper.h"

namespace voussoir {

/// The largest among some bodies of Σ over a body's patches of stiffness over mass, 1/s2. Bodies whose bound stays
/// below the assembly's largest cannot have lowered the critical step, so that most new contacts need no new power
/// iteration.
class ContactBound {
 public:
  double of(const Stepper& stepper, const std::vector<std::int32_t>& bodies);
  double of_bodies(const Stepper& stepper);  // all
  /// The same of nodes of the fill, from the elements around them and their patches with stones.
  double of(const Model& model, const State& state, const std::vector<std::int32_t>& nodes);
  double of_nodes(const Stepper& stepper);  // all

 private:
  std::vector<double> elements_;                   // N/m, of each node, once asked for
  std::vector<std::vector<std::int32_t>> joints_;  // of each body, in the assembly's order; once asked for
};

}  // namespace voussoir
