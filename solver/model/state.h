// The state of a run: all variables that change, and none that can be recomputed. A checkpoint stores its arrays, and
// the state hash covers them.
#pragma once
#include <cstdint>
#include <vector>

#include "solver/base/arrays.h"
#include "solver/model/branches.h"
#include "solver/model/fill_memory.h"
#include "solver/model/interface.h"
#include "solver/model/model.h"

namespace voussoir {

/// How a patch is computed.
enum PatchMode : std::uint8_t {
  mode_points = 1,  // point by point (else as six generalised springs)
  mode_broken = 2,  // intact path: the whole patch has lost its bond (or never had one)
  mode_gone = 4,    // permanently without force: replaced by a contact, or its bodies have separated; or a free slot
  mode_open = 8,    // intact path, or a contact: wholly open at the last pass
  mode_slid = 16,   // intact path: its rigid plastic slip is not zero
  // Composite joints point by point:
  mode_plain = 32,  // all bonds are lost, no point is crushed and none dilates: equal to a broken brittle joint
  mode_lanes = 64,  // it was computed in this way at the last pass
};

/// Memory of a set of patches; tables of points are laid out as point_index() says.
struct PatchMemory {
  Array<double> point;       // 2 columns: plastic jump s, t (m)
  Array<double> point_rest;  // 2 columns: plastic jump n (m), softening; the time step reads them if a law needs them
  Array<double>
      point_crush;  // 3 columns: inelastic jump, closure and slip (m); none without joints of the composite law
  Array<std::uint8_t> broken;  // 1 column: 0, or 1 without bond, or 3 without bond and open
  Array<float> point_branch;   // 3 columns per branch: q (m)
  Array<std::uint8_t> mode;    // 1 per patch, PatchMode bits
  // Eight patches side by side:
  Array<double> largest;  // 2 per patch: opening, slip (m); of a tie its stretch (m) and tension (Pa)
  Array<double> energy;   // 3 per patch: friction, fracture, work done on the branches point by point (J)
  Array<float> last;      // 6 per patch: jump at the last pass (m, rad)
  /// Sets the tables to this size and all their values to zero, and removes the memory of the branches. Does not
  /// change `point_crush` and `last`.
  void resize(std::size_t patches, std::size_t batches, std::size_t points);
};

constexpr int motion_width = 8;  // velocity 3 (m/s), angular momentum 3 (kg m2/s), work of the base (J; of still
                                 // bodies: on contacts), loss by body damping (J)
constexpr int searched_width = 8;

struct State {
  // scalars: time (s), base velocity (3, m/s) and displacement (3, m); in J: energies of removed contacts (friction,
  // fracture, damping), elastic energy removed when patches were clipped again, energy at the start of the motion,
  // largest energy term so far
  Array<double> scalars = Array<double>(13, 0.0);
  Array<std::int64_t> counters = Array<std::int64_t>(5, 0);  // time steps, contact searches, contacts made, last time
                                                             // step at which patches were grouped, next time step at
                                                             // whose end displacements of bodies are checked

  Array<double> pose;      // pose_width per body; displacement since the reference placement
  Array<double> motion;    // motion_width per body; velocities at the last half step
  Array<double> baseline;  // pose_width per body: placement at the end of the last gravity stage, relative to the base
  Array<float> searched;   // searched_width per body: displacement relative to the base (m) and quaternion at the last
                           // contact search; the last is 1 if the body is lost
  Array<float> listed;     // the same when its pairs were last listed

  // Pairs of cells that are near each other without a joint between them, sorted.
  Array<std::int32_t> pair_cells;  // CellPair each
  Array<float> pair_seen;  // 8 per pair: placement of one body in the frame of the other when they were last examined
                           // (m, quaternion); distance it may move before the next examination (m)

  Array<std::int32_t> joint_order;  // index in Assembly::joints of each of Model::joints, see solver/contact/grouping
  Array<float> built;               // 6 of each of Assembly::joints: Patch::built; empty without a ConstructionPlan
  PatchMemory joint;                // of Model::joints
  Array<double> slip;               // per batch 3 × 8: rigid plastic slip of the intact path: s, t (m), about n (rad)
  Array<float> branch;              // per batch 6 × branches × 8: q of the six generalised jumps
  Array<double> branch_work;        // 8 per tile: work done on the branches of the intact path (J)
  Array<double> support_work;       // 1 per tile: work of the forces that hold or drive still bodies, on its joints (J)

  // Contacts found during the run are stored in slots, eight to a batch. A free slot has mode_gone and a patch without
  // points. The slot of a contact depends on the earlier contacts, so batches and free slots are part of the state.
  std::vector<Patch> contacts;
  Array<std::int32_t> contact_tiles;    // 2 per batch: tile, rows of points
  Array<ContactBatch> contact_batches;  // the same patches side by side: made from them, not written
  Array<double> contact_points;         // s, t, weight; eight contacts side by side
  Array<double> contact_corners;        // s, t
  PatchMemory contact;
  Array<double> contact_slid;  // 4 per contact: slip of the patches it replaced (m, world axes), largest slip of these
                               // patches (m)
  Array<double> contact_rows;  // the contacts as numbers, for files

  FillMemory fill;
  Interface interface;
  PatchMemory interface_memory;  // of its patches; `last` has 9 rows of lanes per batch
  Array<float> interface_seen;   // as `searched`, when patches with the fill were last looked for
  Array<double> interface_rows, interface_points, interface_corners;  // the patches as numbers, for files

  double& time() { return scalars[0]; }
  double time() const { return scalars[0]; }
  std::int64_t& step() { return counters[0]; }
  Eigen::Map<Vec3> base_velocity() { return Eigen::Map<Vec3>(&scalars[1]); }
  Eigen::Map<Vec3> base_displacement() { return Eigen::Map<Vec3>(&scalars[4]); }
  Eigen::Map<const Vec3> base_displacement() const { return Eigen::Map<const Vec3>(&scalars[4]); }
  Eigen::Map<const Vec3> base_velocity() const { return Eigen::Map<const Vec3>(&scalars[1]); }
  double* retired_energy() { return &scalars[7]; }
  const double* retired_energy() const { return &scalars[7]; }
  std::int64_t& grouped_at() { return counters[3]; }
  std::int64_t& look_at() { return counters[4]; }
  double& clipped_energy() { return scalars[10]; }
  double clipped_energy() const { return scalars[10]; }
  double& starting_energy() { return scalars[11]; }
  double& largest_energy() { return scalars[12]; }

  /// Whether a body has fallen below the original assembly. The solver no longer searches for its contacts.
  bool lost(std::size_t body) const { return searched[searched_width * body + 7] > 0.0f; }
  bool has_contact(std::size_t slot) const { return !(contact.mode[slot] & mode_gone); }
  std::int64_t contact_count() const;

  /// All arrays by name, with contacts and interface as flat arrays. Call unpack() after reading into them.
  std::vector<NamedArray> arrays();
  void unpack(const Model& model);
};

/// Adds a batch to State::contact_batches for eight contacts of a tile with at most this number of rows of points. The
/// other arrays are unchanged.
void append_contact_batch(State& state, std::int32_t tile, std::int32_t rows);
/// Copies State::contacts[slot], including its points, into its batch.
void fill_contact_lane(State& state, std::size_t slot);

/// Rotation of a body since its reference placement.
inline Eigen::Quaterniond rotation_of(const State& state, std::size_t body) {
  const double* p = &state.pose[pose_width * body];
  return {p[3], p[4], p[5], p[6]};
}

/// Sets the velocities of all bodies and the base to zero.
void stop_motion(State& state);

/// Position of a patch in the batches of eight. For contacts and patches with the fill it follows from the slot.
struct BatchPlace {
  std::size_t batch = 0, lane = 0;
};
inline BatchPlace place_of(const Patch& patch) {
  return {std::size_t(patch.batch), std::size_t(patch.lane)};
}
inline BatchPlace place_of_slot(std::size_t slot) {
  return {slot / lane_count, slot % lane_count};
}
/// Number c of a patch in PatchMemory::largest and PatchMemory::energy.
inline std::size_t largest_index(BatchPlace at, std::size_t c) {
  return lane_count * (2 * at.batch + c) + at.lane;
}
inline std::size_t energy_index(BatchPlace at, std::size_t c) {
  return lane_count * (3 * at.batch + c) + at.lane;
}

/// First of the eight lanes of jump c of a batch, in PatchMemory::last.
inline std::size_t last_index(std::size_t batch, int c) {
  return lane_count * (6 * batch + std::size_t(c));
}

/// First of the eight lanes of generalised jump c in branch k of a batch, in State::branch.
inline std::size_t branch_index(int branches, std::size_t batch, int c, int k) {
  return lane_count * ((6 * batch + std::size_t(c)) * std::size_t(branches) + std::size_t(k));
}

/// The state at rest in the reference placement, with the bonds of the laws and without damping branches.
State initial_state(const Model& model);

/// Gives every patch memory for `count` branches. If the number is unchanged the values are kept, else they start at q
/// = 0.
void set_branches(const Model& model, State& state, int count);

}  // namespace voussoir
