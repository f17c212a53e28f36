// Limit analysis of plane assemblies of rigid blocks by linear programming. It validates the program with a method
// that uses neither stiffness nor time. Theory: docs/theory/limit-analysis.md.
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

/// The problem: the largest multiplier of a pattern of loads that acts in addition to the permanent loads.
struct LimitProblem {
  Vec3 gravity = Vec3(0.0, 0.0, -9.81);  // m/s2, permanent
  Vec3 acceleration = Vec3::Zero();      // m/s2, times the multiplier; the load is mass times acceleration of every
                                         // free block
  std::vector<BlockLoad> loads;          // times the multiplier
  double largest = 1e6;                  // limit of the multiplier; a larger one counts as unlimited
};

/// Forces of a joint, one entry for each joint of the assembly.
struct JointForce {
  double normal = 0.0;  // N, compression
  double shear = 0.0;   // N, on block b along the in-plane direction of the joint
  double lever = 0.0;   // m, distance of the resultant from the middle of the joint along the same direction; 0
                        // without normal force
  double limit = 0.0;   // N, shear resistance by friction and cohesion under this normal force
};

/// Motion of a joint of the mechanism. The rates are scaled so that the power of the pattern is 1 W.
struct JointRate {
  std::size_t joint = 0;
  double opening[2] = {0.0, 0.0};  // m/s, at both ends along the in-plane direction; ≥ 0 except for rounding
  double slip = 0.0;               // m/s
  bool slides() const;             // slips more than it opens by rotation
};

struct LimitAnalysis {
  bool stands = false;   // under the permanent loads
  bool limited = false;  // the multiplier is below LimitProblem::largest
  double multiplier = 0.0;
  std::vector<JointForce> forces;    // forces in equilibrium at the multiplier; not unique where the structure does
                                     // not move
  std::vector<JointRate> mechanism;  // joints whose opening or slip is at least a hundredth of the largest
  std::vector<Vec3> rates;           // of each block: velocity of the centroid along x (m/s), rotation about y (rad/s),
                                     // velocity along z (m/s)
  int iterations = 1;                // number of linear programs solved
  double excess = 0.0;               // largest shear force above the friction limit, divided by the largest normal
                                     // force
};

/// The static theorem (Livesley 1978): the largest multiplier for which forces at both ends of every joint balance all
/// free blocks, are never tensile, and stay within friction. The ends of a joint are those of its polygon in the plane
/// x-z. Its friction and cohesion are those of its law after the bond is lost. Tensile strength, compressive strength,
/// stiffness and dilation are ignored. The duals are the mechanism, in which slip causes opening by the tangent of the
/// friction angle (associated flow). If joints slide in it, the multiplier is an upper bound for friction without
/// dilation.
/// Throws InputError that names the joint if the assembly is not plane, has a deformable fill, or has elastic joints
/// or ties; RunError as solve() does.
LimitAnalysis limit_analysis(const Assembly& assembly, const LimitProblem& problem);

/// The same for friction without dilation, by a sequence of linear programs after Gilbert, Casapulla & Ahmed (2006).
/// Each program limits shear by friction under the normal forces of the previous solutions, nearly independent of its
/// own normal force, so that its mechanism slips nearly without dilation. No theorem supports the method: the result
/// is one equilibrium with a possible mechanism, and others may exist. `excess` is the difference between the last
/// solution and the given friction. Throws RunError if the multipliers do not converge.
LimitAnalysis limit_analysis_without_lift(const Assembly& assembly, const LimitProblem& problem);

/// "3 joints hinge, 2 slide".
std::string mechanism_text(const LimitAnalysis& analysis);

}  // namespace voussoir::limit
