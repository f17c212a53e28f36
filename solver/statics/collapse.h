// Collapse loads: the largest multiplier of a load pattern at which the assembly has an equilibrium, and the mechanism
// beyond it.
#pragma once
#include "solver/statics/equilibrium.h"
#include "solver/statics/resultants.h"

namespace voussoir {

/// One joint of a mechanism. Positions refer to the reference placement.
struct MechanismJoint {
  std::int64_t a = 0, b = 0;   // blocks
  bool slides = false;         // else it hinges
  Vec3 place = Vec3::Zero();   // m: middle of the edge (or of the face) that stays closed
  Vec3 centre = Vec3::Zero();  // m: centroid of the joint
  double opening = 0.0;  // of the widest point relative to the closed edge, as a share of the largest displacement
  double slip = 0.0;     // at that edge, as a share of the largest displacement
};

struct CollapseTry {
  double multiplier = 0.0;
  bool stands = false;
  std::int64_t steps = 0;  // iterations of the relaxation
};

/// An equilibrium on the load path. Displacements (m) count from the equilibrium without the pattern.
struct CollapsePoint {
  double multiplier = 0.0;
  double along = 0.0;    // of the loaded points in the direction of the load, mean weighted by the load
  double largest = 0.0;  // of any point of a block
  bool settled = false;  // it came to rest after moving farther than the displacement of the settings
};

/// The moving part after loss of equilibrium.
struct CollapseLoss {
  bool local = false;                // only loaded parts move, or less than a twentieth of the mass that can move
  std::vector<std::int64_t> blocks;  // blocks that move by a tenth of the largest displacement or more
  double share = 0.0;                // of the mass that can move
  bool loaded_only = false;          // the pattern acts on all of `blocks`, but not on all blocks
  bool fill = false;                 // the fill moves with them
  std::optional<bool> rest_stands;   // whether the rest stands with `blocks` held and their loads removed; for a local
                                     // loss
};

struct Collapse {
  bool found = false;
  double multiplier = 0.0;  // largest multiplier with an equilibrium
  double above = 0.0;       // smallest tried multiplier above it at which equilibrium was lost
  std::vector<CollapseTry> tries;
  std::vector<CollapsePoint> curve;
  RestForces last;    // joint forces in the last equilibrium
  CollapseLoss loss;  // if found
  std::vector<MechanismJoint> mechanism;
  std::optional<bool> stands_below, falls_above;  // results of the dynamic runs, if there were any
  std::string account;                            // one line for the log
};

/// Raises the multiplier from zero. Each try starts from the last equilibrium, so that the loads on the joints grow. If
/// equilibrium is lost the increment is halved, until it is below the tolerance. Equilibrium is lost when the motion
/// continues (MotionWatch); a motion that comes to rest at any distance is a settlement. At the end the state is that
/// of the collapsing assembly, or of the equilibrium under the full load if none was lost. `loads` returns the loads at
/// a multiplier. Throws RunError if there is no equilibrium without the pattern.
Collapse find_collapse(Stepper& stepper, const CollapseSettings& settings, double tolerance,
                       const std::function<LoadsAtWork(double)>& loads, const std::atomic<bool>* stop,
                       const std::function<void(const CollapseTry&, double residual)>& progress);

/// For the log: up to twelve joints with their positions.
std::string mechanism_text(const Assembly& assembly, const std::vector<MechanismJoint>& mechanism);

/// "intrados" or "extrados" for a hinge of an arch, as seen from the midpoint between its springings; else empty.
std::string edge_name(const Assembly& assembly, const MechanismJoint& joint);

/// One sentence: the multiplier, whether the loss is local or global, and whether the dynamic runs agree.
std::string collapse_headline(const Assembly& assembly, const Collapse& collapse);
/// The moving part, for example "3 loaded blocks and the fill around them" or "3 blocks of component parapet".
std::string moving_part(const Assembly& assembly, const CollapseLoss& loss);

/// Joints that open or slide by at least a tenth of the largest such movement between two placements of the bodies.
std::vector<MechanismJoint> find_mechanism(const Model& model, const State& before, const State& after);

}  // namespace voussoir
