// Static equilibrium: Newton on the tangent stiffness with sparse Cholesky, and dynamic relaxation where that fails.
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
  bool lost = false;       // it went past its limit of displacement
  int iterations = 0;      // Newton
  std::int64_t steps = 0;  // relaxation
  double residual = 0.0;   // largest out-of-balance force over the weight of an average block
  double first_residual = 0.0;
  std::string account;    // one line for the log
  Array<double> earlier;  // of a relaxation: rows of State::pose in its second quarter or third, to see what moves
};

/// Out-of-balance force and moment of every free body (N, N m), and the largest as below.
struct OutOfBalance {
  Eigen::VectorXd force;
  double largest = 0.0;
};
/// From a patch pass at the present placement; the patches remember it.
OutOfBalance out_of_balance(Stepper& stepper, const Unknowns& unknowns);

/// Evaluates the patches at the present placement, so that the stepper's passes hold their forces, calls `look`, and
/// leaves no trace in the state. The stepper must have no damping branches.
void look_at_rest(Stepper& stepper, const std::function<void()>& look);

/// Largest out-of-balance force of a free body (moments over the typical block size count too) over the average weight;
/// leaves no trace in the state.
double out_of_balance(Stepper& stepper);

/// Newton: each iteration evaluates all patches from the state at the call, so that the result does not depend on the
/// way. The stepper must have no damping branches. Where it does not converge it leaves the state at the placement of
/// the first iteration, the elastic solution with every joint holding. Velocities are zero afterwards.
Equilibrium newton_equilibrium(Stepper& stepper, double tolerance, const std::atomic<bool>* stop,
                               const std::function<void(int, double)>& progress);

/// From an equilibrium to the next one after loads have changed or supports have moved: Newton on the present tangent,
/// the stiffness of the forces included where that is positive, from the first iteration on. With a machine the loads
/// are those of its pattern at the multiplier that brings the displacement along it to the head exactly; it gets that
/// multiplier, and begins with the one it has. Where it does not converge the state is as it was.
Equilibrium newton_step(Stepper& stepper, double tolerance, Machine* machine, const std::atomic<bool>* stop,
                        const std::function<void(int, double)>& progress);

/// When a relaxation gives up.
struct RelaxationLimits {
  std::int64_t steps = 400000;
  double displacement = 1e300;  // m, of any point of a body since the beginning
  bool from_unloaded = true;    // with a fill the weight then comes on little by little
  bool gently = false;          // damped past critical from the first step on, so that what slides hardly goes too far
  /// What acts comes on little by little: called before each of so many rounds of steps, with a share that grows to 1.
  int ramp_rounds = 0;
  std::function<void(double)> ramp = {};
  /// Asked every round of steps, with the work that the out-of-balance forces did in it (J): true when the motion will
  /// not come to rest. None: never.
  std::function<bool(const State& state, double work)> hopeless = {};
};

/// Dynamic relaxation with inertia and damping of its own choice (solver/statics/relaxation.cpp). Neither the stepper's
/// step nor its damping matters or changes; the stepper must have no damping branches. Velocities are zero afterwards.
/// With a machine the loads are those of its pattern at the multiplier that it finds; the stepper's own are not looked
/// at.
Equilibrium relax(Stepper& stepper, double tolerance, const RelaxationLimits& limits, const std::atomic<bool>* stop,
                  const std::function<void(std::int64_t, double)>& progress, Machine* machine = nullptr);

/// Largest displacement of any body between two placements (rows of State::pose), m: of the centroid, plus the turn
/// (radians) times the distance to the farthest vertex. Good for turns below half a radian.
double largest_displacement(const Model& model, const Array<double>& from, const Array<double>& to);
/// The same of one body.
double body_displacement(const Model& model, const Array<double>& from, const Array<double>& to, std::size_t body);

}  // namespace voussoir
