// The patches of a step: every one reads its two bodies and updates its own memory. The wrenches of a tile's joints are
// added up body by body in the order of the joints, those of contacts are stored slot by slot.
#pragma once
#include "solver/contact/jump.h"

namespace voussoir {

/// What the pass found, gathered by each thread for itself and merged without regard to order.
struct PassReport {
  bool reclip = false;      // some patch has slid or turned past its limit
  std::int64_t intact = 0;  // joints on the intact path
  std::int64_t points = 0;  // joints computed point by point
  std::int64_t contacts = 0;
  void merge(const PassReport& other) {
    reclip |= other.reclip;
    intact += other.intact;
    points += other.points;
    contacts += other.contacts;
  }
};

/// What the joints and contacts of a tile hold, J; joints that point_patch() computes are left out.
struct TileEnergy {
  double elastic = 0.0, branches = 0.0;
};

/// Whether a joint's energy is in its tile's: its law has a lane form, or it is on the intact path.
bool in_tile_energy(const Model& model, const State& state, std::size_t joint);

struct PatchPass {
  const Model* model = nullptr;
  State* state = nullptr;
  const double* still = nullptr;  // pose_width × Model::still: where they are; none: where the state has them
  Branches branches;
  double* sums = nullptr;                // wrench_width × the sums of Model::tiles
  double* contact_wrenches = nullptr;    // wrench_width × slots of contacts
  double* interface_wrenches = nullptr;  // wrench_width × slots of the interface
  double* interface_forces = nullptr;    // node_width × Interface::sum_count(): on the nodes of the fill
  double* wrenches = nullptr;            // wrench_width × joints, or not wanted
  bool shortcut = true;                  // false: every patch point by point, for verification
  TileEnergy* energies = nullptr;        // of each tile, or not wanted

  /// Of a body, as joints read it.
  const double* pose_of(std::int32_t body) const {
    const std::int32_t which = still ? model->still_of[std::size_t(body)] : -1;
    return which < 0 ? &state->pose[pose_width * std::size_t(body)] : still + pose_width * std::size_t(which);
  }
  /// The joints of a tile, eight side by side: intact lanes as generalised springs, the others point by point.
  PassReport joints(std::size_t tile) const;
  /// The contacts of a tile, in these batches of eight; after its joints.
  PassReport contacts(std::size_t tile, const std::int32_t* begin, const std::int32_t* end) const;
  /// The patches between the tile's bodies and the fill; after its joints.
  bool interface(std::size_t tile) const;
};

/// A joint leaves the intact path: its rigid slip field and affine branch field are handed to its points.
void joint_to_points(const Model& model, State& state, const Branches& branches, std::size_t index);

/// Whether a patch has slid or turned so far that it must be clipped anew.
bool past_limits(const Model& model, const Patch& patch, const Jump<double>& jump);

/// While a contact is wholly open its points are not looked at; this brings their plastic slip, which follows the jump,
/// up to the last pass.
void follow_open_contact(State& state, std::size_t contact);

/// A joint point by point, for the laws that have no lane form.
void point_patch(const PatchPass& pass, std::size_t joint, double* wrench);

}  // namespace voussoir
