// Static equilibrium: Newton's method on the tangent stiffness with sparse Cholesky, and dynamic relaxation if it
// fails.
#pragma once
#include <atomic>
#include <functional>
#include <string>

#include "solver/linear/stiffness.h"
#include "solver/statics/machine.h"
#include "solver/step/stepper.h"

namespace voussoir {

struct Equilibrium {
  bool converged = false;
  bool relaxed = false;    // dynamic relaxation was needed
  bool lost = false;       // a displacement above its limit, StepOutcome::runaway, or a motion that is `hopeless`
  int iterations = 0;      // Newton
  std::int64_t steps = 0;  // iterations of the relaxation
  double residual = 0.0;   // largest out-of-balance force over the weight of an average block
  double first_residual = 0.0;
  std::string account;    // one line for the log
  Array<double> earlier;  // of a relaxation: rows of State::pose after a quarter to a half of its iterations, to find
                          // the moving bodies
};

/// Out-of-balance force and moment of all unknowns (N, N m; bodies and nodes of the fill), and the largest as in
/// out_of_balance() below.
struct OutOfBalance {
  Eigen::VectorXd force;
  double largest = 0.0;
};
/// Evaluates the patches at the present placement and updates their memory.
OutOfBalance out_of_balance(Stepper& stepper, const Unknowns& unknowns);

/// Evaluates the patches at the present placement, so that the passes of the stepper contain their forces, calls
/// `look`, and restores the state. The stepper must have no damping branches.
void look_at_rest(Stepper& stepper, const std::function<void()>& look);

/// Largest out-of-balance force of a free body over the average weight. Moments count too, divided by the typical block
/// size. The state is unchanged.
double out_of_balance(Stepper& stepper);

/// Newton's method. Each iteration evaluates all patches from the state at the call, so that the result does not depend
/// on the path of the iterations. The stepper must have no damping branches. Without convergence the state is left at
/// the placement of the first iteration, the elastic solution with all joints intact. Velocities are zero afterwards.
Equilibrium newton_equilibrium(Stepper& stepper, double tolerance, const std::atomic<bool>* stop,
                               const std::function<void(int, double)>& progress);

/// Computes the next equilibrium after loads have changed or supports have moved. It uses Newton's method on the
/// present tangent from the first iteration on, and includes the geometric stiffness if the sum is positive definite.
/// With a machine, the loads are those of its pattern at the multiplier at which the displacement along the pattern
/// equals the head. The iteration starts from the multiplier of the machine and stores the result there. Without
/// convergence the state is unchanged.
Equilibrium newton_step(Stepper& stepper, double tolerance, Machine* machine, const std::atomic<bool>* stop,
                        const std::function<void(int, double)>& progress);

/// Limits at which a relaxation stops, and its loading.
struct RelaxationLimits {
  std::int64_t steps = 400000;
  double displacement = 1e300;  // m, of any point of a body since the beginning
  bool from_unloaded = true;    // with a fill, the weight is then applied gradually
  bool gently = false;  // damped above critical from the first iteration, so that sliding parts hardly overshoot
  /// Gradual loading: `ramp` is called before each of `ramp_rounds` rounds of iterations, with a share that grows to 1.
  int ramp_rounds = 0;
  std::function<void(double)> ramp = {};
  /// Called after every round of iterations with the work of the out-of-balance forces in it (J). Returns true if the
  /// motion will not come to rest. May be empty.
  std::function<bool(const State& state, double work)> hopeless = {};
};

/// Dynamic relaxation, which chooses its own inertia and damping (solver/statics/relaxation.cpp). It neither uses nor
/// changes the time step and damping of the stepper, which must have no damping branches. Velocities are zero
/// afterwards. With a machine, the loads are those of its pattern at the computed multiplier, and the loads of the
/// stepper are ignored.
Equilibrium relax(Stepper& stepper, double tolerance, const RelaxationLimits& limits, const std::atomic<bool>* stop,
                  const std::function<void(std::int64_t, double)>& progress, Machine* machine = nullptr);

/// Largest displacement of any body between two placements (rows of State::pose), m: of the centroid, plus the rotation
/// (rad) times the distance to the farthest vertex. Valid for rotations below 0.5 rad.
double largest_displacement(const Model& model, const Array<double>& from, const Array<double>& to);
/// The same for one body.
double body_displacement(const Model& model, const Array<double>& from, const Array<double>& to, std::size_t body);

}  // namespace voussoir
