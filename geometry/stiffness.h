// Stiffness and strength of the joints of a generated assembly.
#pragma once
#include <map>
#include <string>

#include "geometry/assembly.h"
#include "geometry/generator.h"
#include "geometry/joints.h"

namespace voussoir {

struct Stiffness {
  double kn = 0.0, ks = 0.0;  // Pa/m
};

/// The rules for stiffness and strength of the joints of an assembly.
struct JointRules {
  /// moduli: kn = E/dc and ks = G/dc, where dc (m) is the sum of the two half-lengths. A half-length is the distance of
  /// a centroid from the joint along its normal. Different materials act in series.
  /// table: one pair of values for each component in every direction; different components in series from equal halves,
  /// but the values of the infill hold for all joints of the infill. Rigid backfill takes its values from the moduli.
  /// given: `uniform` for every joint.
  enum class Kind { moduli, table, given };
  Kind kind = Kind::moduli;
  Stiffness uniform;                     // given only
  std::map<Component, Stiffness> table;  // interface_share refers to it, too
  bool rows_from_moduli = false;         // components without a row: E and G of a stone over the mean size of a block
  std::map<Component, Vec3> nominal;     // m, block size: half of it counts for a fixed block
  double interface_share = 0.20;         // masonry-backfill: share of the masonry's value (table or moduli)
  double interface_friction = 0.0;       // rad
  double restraint_share = 0.50;         // joints with restraint blocks: share of the stiffness
  bool rings_bonded = true;              // joints between the rings of a vault; otherwise friction only
  double smallest_half_length = 1e-3;    // m: a centroid nearer to the joint counts as this far from it
};

/// Sets kn, ks and law of every joint. The blocks must be finished and the joints found. Order of precedence: the
/// override of the case for joints between rings ("ring-ring") or for the pair of materials; the interface between
/// masonry and backfill; the rules above. The stiffness of a joint with a restraint block, also one from an override,
/// is then multiplied by `restraint_share`. A fixed block has the material of the stone that touches it. Between
/// different materials each strength is the lower of the two; residual cohesion is 0, and residual friction equals
/// friction. Joints between two fixed blocks are removed. Throws InputError for an override with an unknown material.
void assign_stiffness(Assembly& assembly, const JointRules& rules, const GeneratorInput& input);

/// The same for the patches between stones and a deformable fill, with the rules of rigid backfill. A fixed block has
/// the material of the fill; the patch then has the stiffness E/dc of one nominal block of backfill, with its size
/// along the normal, times `restraint_share` for a restraint block. The tetrahedra add no length, because they already
/// have the stiffness of the fill up to its surface.
void assign_fill_stiffness(Assembly& assembly, const JointRules& rules, const GeneratorInput& input);

/// Finds the joints of an assembly that has none and sets their stiffness and strength (blocks finished). The stiffness
/// is `uniform` or, if that is zero, follows from the moduli. Joints of masonry with blocks of backfill have a friction
/// angle of 35 degrees and no cohesion. If the stiffness follows from the moduli, they have a fifth of the stiffness of
/// the masonry. Throws InputError for blocks without moduli, for overlaps, and if only one of kn and ks is given.
JointReport lay_joints(Assembly& assembly, const JointSearch& search, const Stiffness& uniform = {});

/// Rules of the small generators: keys kn and ks (Pa/m) for every joint, or the moduli if both are 0. Throws InputError
/// if only one of them is given.
JointRules uniform_rules(const GeneratorInput& input);

/// Strength of a joint within one material: brittle, no residual cohesion.
JointLaw strength_of(const Material& material);

/// Index of the law in the list; a new law is added to the list.
std::int32_t law_index(std::vector<JointLaw>& laws, const JointLaw& law);

}  // namespace voussoir
