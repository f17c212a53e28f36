// The step: tile by tile, the patches and then, as soon as nothing reads them any more, the bodies; in one team of
// threads that stays together until there is something to decide.
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
  reached,      // the step asked for
  contacts,     // contacts must be looked for before going on
  runaway,      // a velocity is not finite or past 1000 m/s, or a tetrahedron has lost its volume
  interrupted,  // the stop flag was set
};

struct Advance {
  StepOutcome outcome = StepOutcome::reached;
  std::int32_t runaway_body = -1;
  std::int32_t runaway_node = -1, inverted_tet = -1;  // of the fill's mesh
  std::vector<std::int32_t> past;                     // contacts: tiles in which a patch has passed its limits
  std::int64_t intact = 0, points = 0;                // patches of the last step on either path
};

/// What the steps have cost a tile, wall time in s, and how many patches went which way. Tiles of the fill come after
/// those of bodies.
struct TileCost {
  double patches = 0.0, bodies = 0.0;  // of the fill: stresses, nodes
  double volumes = 0.0;                // of the fill
  std::int64_t intact = 0, points = 0, contacts = 0, interface = 0;
  std::int64_t yielding = 0;  // tetrahedra
};

/// What a step works with. The stepper owns only scratch memory; everything that must survive is in the state.
struct Stepper {
  const Model* model = nullptr;
  State* state = nullptr;
  DampingAtWork damping;
  double dt = 0.0;  // s
  int threads = 1;
  bool shortcut = true;
  bool single = false;  // the fill's strain and stress in single precision, see FillPass
  int most_ahead = 8;   // steps between decisions, in which tiles go ahead of each other; any gives the
                        // same bits
  const GroundMotion* motion = nullptr;  // none: the base keeps its velocity
  double stage_start = 0.0;              // s, time of the motion's first sample
  double stage_duration = 0.0;           // s
  std::vector<Drive> drives;             // of the stage
  Array<std::int32_t> drive;             // of each body, see BodyPass
  GroundPath ground;                     // of the motion, for drives that depart from it; else empty
  LoadsAtWork loads;                     // of the stage, eased over its duration; at once in equilibrium
  double loads_since = -1.0;  // s: when they began to change, evenly, of loads that move; below 0: of the stage, eased
  double loads_duration = 0.0;     // s
  double search_distance = 1e300;  // m: a body that has moved farther since its place was noted calls for a search
  // Called for each tile of bodies, by any thread, before a sample is; none: nothing.
  std::function<void(std::size_t tile)> before_sample;
  std::vector<TileCost>* costs = nullptr;  // of each tile, added to at every step; none: nothing is timed

  Array<double> wrenches;  // wrench_width × (joints, then contacts), of the last patches_only()

  /// Rebuilds what depends on the bodies' constants and on the list of contacts. Call after either changes and before
  /// the first advance().
  void prepare();
  /// What depends on the list of contacts alone.
  void prepare_contacts();
  /// Steps until state->step() is `target` or something has to be decided. Every `sample_every` steps `sample` is
  /// called, by one thread, between patches and bodies: positions and patches are at this step, velocities at the half
  /// step before.
  Advance advance(std::int64_t target, std::int64_t sample_every, const std::function<void(const BodyPass&)>& sample,
                  const std::atomic<bool>* stop);
  /// The patches alone, serially: wrenches at the present placement (used by the static solver and for reports).
  PassReport patches_only();
  /// Tells branches that have just been made what the strains are, so that the first step does not take all of it for a
  /// change.
  void begin_branches();
  BodyPass body_pass() const;
  /// Where still bodies are now, and where a pass will have taken them from there.
  StillPlaces still_places() const;
  void move_still(const BodyPass& pass, const StillPlaces& now, StillPlaces& next) const;
  FillPass fill_pass() const;  // under the whole load
  /// Share of the way of the loads at this time, s.
  double load_share(double time) const;
  void load_fill(FillPass& pass, double share) const;

  // Scratch memory that prepare() lays out.
  Incidence incidence;
  Array<BodyBatch> body_batches;
  Array<double> sums, contact_wrenches;           // the latter of contacts, then of the interface
  mutable Array<double> fill_sums, fill_volumes;  // see FillPass
  mutable std::vector<FillEnergy> fill_energies;  // of each of the fill's tiles
  Array<double> interface_forces;                 // see PatchPass
  std::vector<TileEnergy> tile_energies;          // of the last pass that was asked for them
  // Batches of contacts of each tile: first of each in contact_batches (and one past the end).
  std::vector<std::int32_t> first_contact_batch, contact_batches;
  Dependencies order;  // of the tiles of bodies, then of the fill's

 private:
  PatchPass patch_pass();
  PassReport tile_patches(const PatchPass& pass, std::size_t tile) const;
};

/// The plain serial step, written as the loops it stands for: tile by tile every joint in order adds its wrench to both
/// bodies, then every body adds up tiles and contacts, then all move. The oracle that advance() must equal bit for bit.
void serial_step(Stepper& stepper);

Vec3 base_acceleration(const GroundMotion* motion, double time);

}  // namespace voussoir
