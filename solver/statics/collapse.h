// Collapse loads: the largest multiplier of a load pattern under which an assembly finds equilibrium, and how it moves
// beyond it.
#pragma once
#include "solver/statics/equilibrium.h"
#include "solver/statics/resultants.h"

namespace voussoir {

/// One joint of a mechanism. Places in the reference placement.
struct MechanismJoint {
  std::int64_t a = 0, b = 0;   // blocks
  bool slides = false;         // else it hinges
  Vec3 place = Vec3::Zero();   // m: middle of the edge (or of the face) that stays closed
  Vec3 centre = Vec3::Zero();  // m: centroid of the joint
  double opening = 0.0;  // of the widest point against the edge that stays closed, share of the largest displacement
  double slip = 0.0;     // at that edge, likewise
};

struct CollapseTry {
  double multiplier = 0.0;
  bool stands = false;
  std::int64_t steps = 0;  // of relaxation
};

/// An equilibrium on the way. Displacements (m) since the one without the pattern.
struct CollapsePoint {
  double multiplier = 0.0;
  double along = 0.0;    // of the loaded points in the direction of the load, mean weighted by the load
  double largest = 0.0;  // of any point of a block
  bool settled = false;  // it came to rest only after moving farther than the settings' displacement
};

/// What moves once equilibrium is lost.
struct CollapseLoss {
  bool local = false;                // only what is loaded, or less than a twentieth of the mass that can move
  std::vector<std::int64_t> blocks;  // that move by a tenth of the largest displacement or more
  double share = 0.0;                // of the mass that can move
  bool loaded_only = false;          // all of `blocks` bear the pattern themselves, and others do not
  bool fill = false;                 // the fill moves with them
  std::optional<bool> rest_stands;   // with `blocks` held and their loads taken away; of a local loss
};

struct Collapse {
  bool found = false;
  double multiplier = 0.0;  // the largest at which equilibrium was found
  double above = 0.0;       // the least tried from there at which it was lost
  std::vector<CollapseTry> tries;
  std::vector<CollapsePoint> curve;
  RestForces last;    // what joints bear in that last equilibrium
  CollapseLoss loss;  // where found
  std::vector<MechanismJoint> mechanism;
  std::optional<bool> stands_below, falls_above;  // what dynamic runs say, where they were made
  std::string account;                            // one line for the log
};

/// Raises the multiplier from zero. Each try starts from the last equilibrium, so that joints see the loads grow; where
/// it is lost the increment is halved, until it is below the tolerance. Equilibrium is lost when the motion goes on
/// (MotionWatch); one that comes to rest, however far off, is a settlement. At the end the state is that of the
/// assembly on its way down, or in equilibrium under the full load when nothing was lost. `loads` gives what acts at a
/// multiplier. Throws RunError when there is no equilibrium without the pattern.
Collapse find_collapse(Stepper& stepper, const CollapseSettings& settings, double tolerance,
                       const std::function<LoadsAtWork(double)>& loads, const std::atomic<bool>* stop,
                       const std::function<void(const CollapseTry&, double residual)>& progress);

/// For the log: up to a dozen joints with their places.
std::string mechanism_text(const Assembly& assembly, const std::vector<MechanismJoint>& mechanism);

/// "intrados" or "extrados" for a joint that hinges in an arch, as seen from the middle of its feet; else empty.
std::string edge_name(const Assembly& assembly, const MechanismJoint& joint);

/// One sentence: the multiplier, whether the loss is local or global, and whether the dynamic runs agree.
std::string collapse_headline(const Assembly& assembly, const Collapse& collapse);
/// What moves: "the loaded blocks (1) and the fill under them", "3 blocks of the parapet".
std::string moving_part(const Assembly& assembly, const CollapseLoss& loss);

/// Joints that open or slide by at least a tenth of the largest such movement between two placements of the bodies.
std::vector<MechanismJoint> find_mechanism(const Model& model, const State& before, const State& after);

}  // namespace voussoir
