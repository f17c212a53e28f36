// The scenes that are timed: walls and bridges, at rest, sliding or shaken.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "solver/step/stepper.h"

namespace voussoir {

struct Scene {
  std::string name, help;
  std::function<Assembly(double scale)> build;  // `scale`: block_scale of a bridge; a wall ignores it
  double step = 0.0;                            // s; 0: 0.8 × critical
  bool maxwell = false;                         // with Maxwell damping
  bool shaken = false;
  bool settled = true;  // in equilibrium under gravity at the start
  double before = 0.0;  // s, duration of shaking before the measurement
  double scale = 1.0;   // block_scale
};

const std::vector<Scene>& scenes();
/// The scene of that name; "cs1@0.5" is cs1 with block_scale = 0.5. Throws InputError for other names.
Scene find_scene(const std::string& name);

/// A scene that is being computed. Its members hold pointers to each other, so it must not be moved.
struct Running {
  Assembly assembly;
  Model model;
  State state;
  GroundMotion motion;
  Stepper stepper;
  // s, wall-clock times; choosing: choice of the time step
  double generation = 0.0, modelling = 0.0, choosing = 0.0, search = 0.0, equilibrium = 0.0;
  std::string account;  // text on how the equilibrium was found
};
/// Builds the scene and brings it to its initial state. `keep` is a folder for the states of scenes (empty: none): the
/// function restores the state that is stored there, or stores it. Throws InputError if that state belongs to another
/// assembly.
std::unique_ptr<Running> begin_scene(const Scene& scene, int threads, const std::string& keep = "");

struct Progressed {
  // Time steps; joints on the intact path and joints computed point by point, summed over the time steps.
  std::int64_t steps = 0, intact = 0, points = 0;
  std::int64_t searches = 0, examined = 0;  // contact searches; pairs examined
  std::int64_t changed = 0, listed = 0;     // searches that changed contacts; searches that made a new list of pairs
  double search_seconds = 0.0, seconds = 0.0, processor_seconds = 0.0;
};
/// Computes `steps` more time steps, including contact searches. Throws RunError if the run fails.
Progressed advance_scene(Running& scene, std::int64_t steps);

}  // namespace voussoir
