#include "solver/modal/settle.h"

#include "solver/modal/loose.h"

namespace voussoir {

Settled settle(Stepper& stepper, double tolerance, const std::atomic<bool>* stop,
               const std::function<void(std::int64_t, double)>& progress) {
  constexpr std::int64_t round = 20000, most = 400000;  // steps
  const Model* model = stepper.model;
  State& state = *stepper.state;
  Model standing = *model;
  stepper.model = &standing;
  stop_motion(state);
  stepper.patches_only();
  Settled settled;
  std::int64_t steps = 0;
  while (steps < most && !settled.equilibrium.converged && !(stop && stop->load())) {
    const Unknowns unknowns = number_unknowns(standing);
    const Loose loose = find_loose(stiffness_blocks(standing, state, PatchTangent::present),
                                   mass_blocks(standing, state, unknowns), unknowns);
    for (std::int32_t body : loose.bodies) {
      standing.bodies[std::size_t(body)].fixed = true;
      settled.falling.push_back(body);
    }
    // A round ends early when a stone has come off and moves away.
    const RelaxationLimits limits = {round, 0.2 * standing.typical_size};
    settled.equilibrium = relax(stepper, tolerance, limits, stop, [&](std::int64_t step, double residual) {
      if (progress) progress(steps + step, residual);
    });
    steps += std::max(settled.equilibrium.steps, std::int64_t(1000));
  }
  settled.equilibrium.steps = steps;
  stepper.model = model;
  stepper.prepare();
  return settled;
}

}  // namespace voussoir
