// What is timed: walls and bridges, at rest, sliding or shaken.
#pragma once
#include <functional>
#include <memory>
#include <string>
#include <vector>

#include "solver/step/stepper.h"

namespace voussoir {

struct Scene {
  std::string name, help;
  std::function<Assembly(double scale)> build;  // `scale`: block_scale of a bridge, nothing to a wall
  double step = 0.0;                            // s; 0: 0.8 × critical
  bool maxwell = false;
  bool shaken = false;
  bool settled = true;  // in equilibrium under gravity at the start
  double before = 0.0;  // s of shaking before anything is timed
  double scale = 1.0;
};

const std::vector<Scene>& scenes();
/// The scene of that name; "cs1@0.5" is cs1 at block_scale = 0.5. InputError for others.
Scene find_scene(const std::string& name);

/// A scene at work. Its parts point at each other: it stays where it is.
struct Running {
  Assembly assembly;
  Model model;
  State state;
  GroundMotion motion;
  Stepper stepper;
  // s of wall time; choosing: of the time step
  double generation = 0.0, modelling = 0.0, choosing = 0.0, search = 0.0, equilibrium = 0.0;
  std::string account;  // of the equilibrium
};
std::unique_ptr<Running> begin_scene(const Scene& scene, int threads, const std::string& keep = "");

struct Progressed {
  std::int64_t steps = 0, intact = 0, points = 0;
  std::int64_t searches = 0, examined = 0, changed = 0, listed = 0;  // pairs; searches that changed, or listed anew
  double search_seconds = 0.0, seconds = 0.0, processor_seconds = 0.0;
};
/// `steps` more steps, contact searches included. Throws RunError when the run goes wrong.
Progressed advance_scene(Running& scene, std::int64_t steps);

}  // namespace voussoir
