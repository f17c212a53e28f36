// The patches in a time step. Each patch reads its two bodies and updates its own memory. The wrenches of the joints of
// a tile are summed for each body in the order of the joints, and those of contacts are stored by slot.
#pragma once
#include "solver/contact/jump.h"

namespace voussoir {

/// Results of the pass. Each thread collects its own, and the order of merging has no effect.
struct PassReport {
  bool reclip = false;        // a patch has exceeded its limit of slip or rotation
  std::int64_t intact = 0;    // joints on the intact path
  std::int64_t points = 0;    // joints computed point by point
  std::int64_t contacts = 0;  // contacts computed
  void merge(const PassReport& other) {
    reclip |= other.reclip;
    intact += other.intact;
    points += other.points;
    contacts += other.contacts;
  }
};

/// Stored energy of the joints, contacts and patches with the fill of a tile, J, without joints that point_patch()
/// computes.
struct TileEnergy {
  double elastic = 0.0, branches = 0.0;
};

/// Whether the energy of a joint is included in that of its tile: its law has a lane form, or it is on the intact path.
bool in_tile_energy(const Model& model, const State& state, std::size_t joint);

struct PatchPass {
  const Model* model = nullptr;
  State* state = nullptr;
  const double* still = nullptr;  // pose_width × Model::still: their positions; null: those of the state
  Branches branches;
  double* sums = nullptr;                // wrench_width × the sums of Model::tiles
  double* contact_wrenches = nullptr;    // wrench_width × slots of contacts
  double* interface_wrenches = nullptr;  // wrench_width × slots of the interface
  double* interface_forces = nullptr;    // node_width × Interface::sum_count(): on the nodes of the fill
  double* wrenches = nullptr;            // wrench_width × joints, or null
  bool shortcut = true;                  // false: every patch point by point, for verification
  TileEnergy* energies = nullptr;        // of each tile, or null

  /// Pose of a body for the joints.
  const double* pose_of(std::int32_t body) const {
    const std::int32_t which = still ? model->still_of[std::size_t(body)] : -1;
    return which < 0 ? &state->pose[pose_width * std::size_t(body)] : still + pose_width * std::size_t(which);
  }
  /// Computes the joints of a tile, eight side by side: intact lanes as generalised springs, the others point by point.
  PassReport joints(std::size_t tile) const;
  /// Computes the contacts of a tile, in these batches of eight. Call it after its joints.
  PassReport contacts(std::size_t tile, const std::int32_t* begin, const std::int32_t* end) const;
  /// Computes the patches between the bodies of the tile and the fill. Call it after its joints. Returns whether a
  /// patch has slid past its limit and must be reclipped.
  bool interface(std::size_t tile) const;
};

/// Moves a joint from the intact path to evaluation point by point: transfers its rigid slip field and affine branch
/// field to its points.
void joint_to_points(const Model& model, State& state, const Branches& branches, std::size_t index);

/// Whether the slip or rotation of a patch requires reclipping.
bool past_limits(const Model& model, const Patch& patch, const Jump<double>& jump);

/// The points of a wholly open contact are not evaluated. This function updates their plastic slip, which follows the
/// jump, to the last pass.
void follow_open_contact(State& state, std::size_t contact);

/// Evaluates a joint point by point, for laws without a lane form. `wrench`: wrench_width numbers, force (N) on body a
/// and moment (N m) about the world's origin.
void point_patch(const PatchPass& pass, std::size_t joint, double* wrench);

}  // namespace voussoir
