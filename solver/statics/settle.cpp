#include "solver/statics/settle.h"

#include "solver/linear/loose.h"

namespace voussoir {

namespace {

/// Bodies that no closed joint ties to anything fixed, and that a round has taken farther than `distance` (m).
std::vector<std::int32_t> falling(const Model& model, const State& state, const Array<double>& before,
                                  double distance) {
  const Unknowns unknowns = number_unknowns(model);
  const Loose loose =
      find_loose(stiffness_blocks(model, state, PatchTangent::present), mass_blocks(model, state, unknowns), unknowns);
  std::vector<std::int32_t> found;
  for (std::int32_t body : loose.bodies) {
    if (std::size_t(body) >= model.bodies.size()) continue;  // a node of the fill
    const double *from = &before[pose_width * std::size_t(body)], *to = &state.pose[pose_width * std::size_t(body)];
    if (Vec3(to[0] - from[0], to[1] - from[1], to[2] - from[2]).norm() > distance) found.push_back(body);
  }
  return found;
}

}  // namespace

Settled settle(Stepper& stepper, double tolerance, const std::atomic<bool>* stop,
               const std::function<void(std::int64_t, double)>& progress) {
  constexpr std::int64_t most = 400000;  // steps
  constexpr int chances = 3;
  const Model* model = stepper.model;
  State& state = *stepper.state;
  Model standing = *model;
  stepper.model = &standing;
  stop_motion(state);
  Settled settled;
  std::int64_t steps = 0;
  std::vector<int> falls(model->bodies.size(), 0);
  const double far = 0.2 * standing.typical_size;  // m
  bool again = true;
  while (again && steps < most && !(stop && stop->load())) {
    const Array<double> before = state.pose;
    const RelaxationLimits limits = {.steps = most - steps, .displacement = far, .from_unloaded = false};
    settled.equilibrium = relax(stepper, tolerance, limits, stop, [&](std::int64_t step, double residual) {
      if (progress) progress(steps + step, residual);
    });
    steps += settled.equilibrium.steps;
    again = settled.equilibrium.lost;
    if (again)  // something has moved far: what falls freely waits until the rest stands
      for (std::int32_t body : falling(standing, state, before, 0.5 * far)) {
        standing.bodies[std::size_t(body)].hold();
        ++falls[std::size_t(body)];
      }
    if (settled.equilibrium.converged)
      for (std::size_t body = 0; body < falls.size(); ++body) {
        if (!standing.bodies[body].still() || falls[body] == 0 || falls[body] >= chances) continue;
        standing.bodies[body] = model->bodies[body];  // it may land on what stands now
        again = true;
      }
  }
  for (std::size_t body = 0; body < falls.size(); ++body)
    if (falls[body] > 0 && standing.bodies[body].still()) settled.falling.push_back(std::int32_t(body));
  settled.equilibrium.steps = steps;
  stepper.model = model;
  stepper.prepare();
  return settled;
}

}  // namespace voussoir
