// Limit analysis of plane assemblies of rigid blocks by linear programming: an oracle for the validation of the program
// that knows neither stiffness nor time. Theory: docs/theory/limit-analysis.md.
#pragma once
#include <cstdint>
#include <string>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir::limit {

/// A force on a block, in the plane x-z.
struct BlockLoad {
  std::int64_t block = 0;
  Vec3 force = Vec3::Zero();  // N
  Vec3 at = Vec3::Zero();     // m
};

/// What is asked: the largest multiplier of a pattern of loads beside what acts anyway.
struct LimitProblem {
  Vec3 gravity = Vec3(0.0, 0.0, -9.81);  // m/s2, acts anyway
  Vec3 acceleration = Vec3::Zero();      // m/s2, times the multiplier: m a on every free block
  std::vector<BlockLoad> loads;          // times the multiplier
  double largest = 1e6;                  // of the multiplier: more counts as not limited
};

/// What a joint carries, per joint of the assembly.
struct JointForce {
  double normal = 0.0;  // N, compression
  double shear = 0.0;   // N, on b along the joint's in-plane direction
  double lever = 0.0;   // m, of the resultant from the joint's middle, along the same direction; 0 without normal force
  double limit = 0.0;   // N, what its friction and cohesion bear under that normal force
};

/// How a joint of the mechanism moves; rates have the scale at which the pattern's power is 1 W.
struct JointRate {
  std::size_t joint = 0;
  double opening[2] = {0.0, 0.0};  // at both ends along the in-plane direction, ≥ 0
  double slip = 0.0;
  bool slides() const;  // slips more than it turns open
};

struct LimitAnalysis {
  bool stands = false;   // under what acts anyway
  bool limited = false;  // by less than LimitProblem::largest
  double multiplier = 0.0;
  std::vector<JointForce> forces;    // of equilibrium at the multiplier, one of many where the rest is not moving
  std::vector<JointRate> mechanism;  // joints that open or slip by a hundredth of the largest such rate or more
  std::vector<Vec3> rates;           // of each block's centroid along x, its turn about y, and along z
  int iterations = 1;                // linear programs solved
  double excess = 0.0;               // largest shear beyond friction over the largest normal force
};

/// The static theorem (Livesley 1978): the largest multiplier for which forces at both ends of every joint balance all
/// free blocks, never pull, and stay within friction. A joint's ends are those of its polygon in the plane x-z, and its
/// friction and cohesion are those of its law once the bond is lost; tension, compressive strength, stiffness and
/// dilation are not looked at. The duals are the mechanism, whose slip lifts by the tangent of friction (associated
/// flow): where joints slide in it the multiplier is an upper bound for friction that does not lift.
/// Throws InputError that names the joint when the assembly is not plane, has a deformable fill, or has joints that are
/// elastic or ties; RunError as solve() does.
LimitAnalysis limit_analysis(const Assembly& assembly, const LimitProblem& problem);

/// The same for friction that does not lift, by a sequence of linear programs in the manner of Gilbert, Casapulla &
/// Ahmed (2006): each limits shear by friction under the normal force of the solutions before, nearly without
/// dependence on its own, so that its mechanism slips nearly without lifting. There is no theorem behind it: what it
/// converges to is one equilibrium with a mechanism that is possible, and others may exist. Its own `excess` says how
/// far the last solution is from the friction asked for. Throws RunError when multipliers do not settle.
LimitAnalysis limit_analysis_without_lift(const Assembly& assembly, const LimitProblem& problem);

/// "3 joints hinge, 2 slide".
std::string mechanism_text(const LimitAnalysis& analysis);

}  // namespace voussoir::limit
