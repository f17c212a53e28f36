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

/// How the joints of an assembly get their stiffness and strength.
struct JointRules {
  /// moduli: kn = E/dc, ks = G/dc from the two half-lengths, in series where materials differ.
  /// table:  one pair of values per component in every direction, unlike ones in series from equal halves; rigid
  ///         backfill, which has no row, from the moduli.
  /// given:  `uniform` for every joint.
  enum class Kind { moduli, table, given };
  Kind kind = Kind::moduli;
  Stiffness uniform;                     // given only
  std::map<Component, Stiffness> table;  // also what `interface_share` refers to
  bool rows_from_moduli = false;         // what the table lacks: E and G of a stone over the mean size of a block
  std::map<Component, Vec3> nominal;     // m, block size: half of it stands for the fixed block below or beside
  double interface_share = 0.20;         // masonry-backfill: share of the masonry's value (table or moduli)
  double interface_friction = 0.0;       // rad
  double restraint_share = 0.50;         // joints with restraint blocks: share of the stiffness
  bool rings_bonded = true;              // joints between the rings of a vault; otherwise friction only
  double smallest_half_length = 1e-3;    // m: nearer centroids count as this far from the joint
};

/// Sets kn, ks and law of every joint (blocks finished, joints found). In this order of precedence: the case's override
/// for joints between rings ("ring-ring") or for the pair of materials; the interface between masonry and backfill; the
/// rules above. A fixed block takes the material of what it touches. Strength between unlike materials is the weaker of
/// the two in each value; residual cohesion is 0 and residual friction the friction. Joints between two fixed blocks
/// are removed. Throws InputError for an override that names an unknown material.
void assign_stiffness(Assembly& assembly, const JointRules& rules, const GeneratorInput& input);

/// The same for the patches between stones and a deformable fill, with the rules of rigid backfill. A fixed block takes
/// the fill's material; between the two stands one nominal block of backfill, E/dc with its size along the normal,
/// times `restraint_share` for a restraint block. Tetrahedra have no size of their own there: the fill's stiffness up
/// to its surface is in them.
void assign_fill_stiffness(Assembly& assembly, const JointRules& rules, const GeneratorInput& input);

/// Finds the joints of an assembly that has none and gives each its stiffness and strength (blocks finished): `uniform`
/// for all, or, where it is zero, from the moduli; blocks of backfill meet masonry with a fifth of that and a friction
/// of 35 degrees alone. Throws InputError naming the first blocks without moduli, for
/// overlaps, and when only one of kn and ks is given.
JointReport lay_joints(Assembly& assembly, const JointSearch& search, const Stiffness& uniform = {});

/// Rules of the small generators: keys kn and ks (Pa/m) for every joint, or the moduli where both are 0. Throws
/// InputError when only one of them is given.
JointRules uniform_rules(const GeneratorInput& input);

/// Strength of a joint within one material: brittle, no residual cohesion.
JointLaw strength_of(const Material& material);

/// Where the law stands in the list, to which it is added when it is new.
std::int32_t law_index(std::vector<JointLaw>& laws, const JointLaw& law);

}  // namespace voussoir
