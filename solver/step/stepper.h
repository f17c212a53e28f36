// The time step. For each tile it computes the patches and then moves the bodies as soon as no other tile still needs
// their old positions. One team of threads runs many time steps until a decision is necessary.
#pragma once
#include <atomic>
#include <functional>

#include "solver/base/parallel.h"
#include "solver/fill/fill_pass.h"
#include "solver/model/settings.h"
#include "solver/motion/ground_path.h"
#include "solver/step/body_pass.h"
#include "solver/step/damping.h"

namespace voussoir {

enum class StepOutcome {
  reached,      // the requested time step
  contacts,     // a contact search is necessary before the next time step
  runaway,      // a velocity is not finite or above 1000 m/s, or a tetrahedron has lost its volume
  interrupted,  // the stop flag was set
};

struct Advance {
  StepOutcome outcome = StepOutcome::reached;
  std::int32_t runaway_body = -1;
  std::int32_t runaway_node = -1, inverted_tet = -1;  // of the mesh of the fill
  std::vector<std::int32_t> past;                     // for the outcome `contacts`: tiles in which a patch has passed
                                                      // its limits
  std::int64_t intact = 0, points = 0;                // patches of the last time step on each path
};

/// Wall-clock time (s) of the time steps for one tile, and number of patches on each path. Tiles of the fill come after
/// those of bodies.
struct TileCost {
  double patches = 0.0, bodies = 0.0;  // of the fill: stresses, nodes
  double volumes = 0.0;                // of the fill
  std::int64_t intact = 0, points = 0, contacts = 0, interface = 0;
  std::int64_t yielding = 0;  // tetrahedra
};

/// Inputs of a time step. The stepper owns only temporary memory; all persistent data are in the state.
struct Stepper {
  const Model* model = nullptr;
  State* state = nullptr;
  DampingAtWork damping;
  double dt = 0.0;  // s
  int threads = 1;
  bool shortcut = true;
  bool single = false;  // strain and stress of the fill in single precision, see FillPass
  int most_ahead = 8;   // time steps between decisions, in which tiles can be ahead of each other; any number gives the
                        // same bits
  const GroundMotion* motion = nullptr;  // none: the velocity of the base is constant
  double stage_start = 0.0;              // s, time of the motion's first sample
  double stage_duration = 0.0;           // s
  std::vector<Drive> drives;             // of the stage
  Array<std::int32_t> drive;             // of each body, see BodyPass
  GroundPath ground;                     // of the motion, for drives that differ from it; else empty
  LoadsAtWork loads;                     // of the stage, applied smoothly over its duration; in an equilibrium search
                                         // at once
  double loads_since = -1.0;    // s: time at which moving loads began to change linearly; below 0: loads of the stage,
                                // applied smoothly
  double loads_duration = 0.0;  // s
  double search_distance = 1e300;  // m: a body that has moved farther since its position was noted requires a search
  // Called for each tile of bodies, by any thread, before a sample; may be empty.
  std::function<void(std::size_t tile)> before_sample;
  std::vector<TileCost>* costs = nullptr;  // of each tile, increased at every time step; null: no times are measured

  Array<double> wrenches;  // wrench_width × (joints, then contacts), of the last patches_only()

  /// Rebuilds the data that depend on the constants of the bodies and on the list of contacts. Call it after a change
  /// of either and before the first advance().
  void prepare();
  /// Rebuilds only the data that depend on the list of contacts.
  void prepare_contacts();
  /// Runs time steps until state->step() is `target` or a decision is necessary. Every `sample_every` time steps one
  /// thread calls `sample` between patches and bodies: positions and patches are at this time step, velocities at the
  /// half step before.
  Advance advance(std::int64_t target, std::int64_t sample_every, const std::function<void(const BodyPass&)>& sample,
                  const std::atomic<bool>* stop);
  /// Evaluates only the patches and the tetrahedra of the fill, in one thread: wrenches and stresses at the present
  /// placement (for the static solver and reports). Their memory is updated.
  PassReport patches_only();
  /// Notes the present jumps and strains as those of the last pass, so that the first time step does not treat them as
  /// a change. Call it after new branches were set.
  void begin_branches();
  BodyPass body_pass() const;
  /// Present positions of the still bodies, and their positions after a pass.
  StillPlaces still_places() const;
  void move_still(const BodyPass& pass, const StillPlaces& now, StillPlaces& next) const;
  FillPass fill_pass() const;  // under the whole load
  /// Share of the loads at this time (s).
  double load_share(double time) const;
  void load_fill(FillPass& pass, double share) const;

  // Temporary memory that prepare() allocates.
  Incidence incidence;
  Array<BodyBatch> body_batches;
  Array<double> sums, contact_wrenches;           // the latter of contacts, then of the interface
  mutable Array<double> fill_sums, fill_volumes;  // see FillPass
  mutable std::vector<FillEnergy> fill_energies;  // of each of the fill's tiles
  Array<double> interface_forces;                 // see PatchPass
  std::vector<TileEnergy> tile_energies;          // of the last pass that computed them
  // Batches of contacts of each tile: first of each in contact_batches (and one past the end).
  std::vector<std::int32_t> first_contact_batch, contact_batches;
  Dependencies order;  // of the tiles of bodies, then of the fill's

 private:
  PatchPass patch_pass();
  PassReport tile_patches(const PatchPass& pass, std::size_t tile) const;
};

/// The time step as plain serial loops: in each tile every joint in order adds its wrench to both bodies, then every
/// body sums tiles and contacts, then all bodies move. It is the reference that advance() must equal bit for bit.
void serial_step(Stepper& stepper);

/// Acceleration (m/s2, world axes) of a motion at `time` (s) after its first sample: linear between the samples, zero
/// before and after them and without a motion.
Vec3 base_acceleration(const GroundMotion* motion, double time);

}  // namespace voussoir
