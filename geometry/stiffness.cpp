#include "geometry/stiffness.h"

#include <algorithm>
#include <cmath>

#include "geometry/fill_mesh.h"
#include "geometry/rings.h"
#include "solver/base/constants.h"
#include "solver/base/counted.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

/// 1/k = 1/ka + 1/kb.
double in_series(double ka, double kb) {
  return ka * kb / (ka + kb);
}

Stiffness in_series(const Stiffness& a, const Stiffness& b) {
  return {in_series(a.kn, b.kn), in_series(a.ks, b.ks)};
}

Stiffness times(const Stiffness& k, double factor) {
  return {factor * k.kn, factor * k.ks};
}

/// One side of a joint: the block, or half a nominal block for a fixed block.
struct Side {
  Component component = Component::block;
  std::int32_t material = 0;
  double half_length = 0.0;  // m, from the centroid to the joint along its normal
};

class Assigner {
 public:
  Assigner(const Assembly& assembly, const JointRules& rules) : assembly_(assembly), rules_(rules) {}

  Stiffness stiffness(const Joint& joint) const {
    if (rules_.kind == JointRules::Kind::given) return rules_.uniform;
    const auto [a, b] = sides(joint);
    const bool fill_a = a.component == Component::backfill, fill_b = b.component == Component::backfill;
    if (fill_a != fill_b) return times(of_masonry(fill_a ? b : a), rules_.interface_share);
    const bool from_table = rules_.kind == JointRules::Kind::table && !fill_a;
    // The row of the infill applies to all its contacts, also with other components.
    const bool infill = a.component == Component::infill || b.component == Component::infill;
    if (from_table && infill) return row(a.component == Component::infill ? a : b);
    return in_series(from_table ? table_half(a) : moduli_half(a), from_table ? table_half(b) : moduli_half(b));
  }

  Stiffness stiffness(const FillJoint& joint, const Material& fill) const {
    if (rules_.kind == JointRules::Kind::given) return rules_.uniform;
    const Block& b = block(joint.block);
    if (!b.fixed) return times(row({b.component, b.material}), rules_.interface_share);
    const double dc = joint.normal.cwiseAbs().dot(rules_.nominal.at(Component::backfill));
    return {fill.youngs_modulus / dc, fill.shear_modulus / dc};
  }

  JointLaw law(const FillJoint& joint, const Material& fill) const {
    return block(joint.block).fixed ? strength_of(fill) : interface_law();
  }

  JointLaw law(const Joint& joint) const {
    const auto [a, b] = sides(joint);
    if ((a.component == Component::backfill) != (b.component == Component::backfill)) return interface_law();
    const JointLaw p = strength_of(material(a)), q = strength_of(material(b));
    JointLaw weaker = p;
    weaker.tension = std::min(p.tension, q.tension);
    weaker.cohesion = std::min(p.cohesion, q.cohesion);
    weaker.friction_angle = std::min(p.friction_angle, q.friction_angle);
    weaker.residual_friction_angle = weaker.friction_angle;
    return weaker;
  }

  /// The two sides; a fixed block takes component and material of the other and half of its nominal size.
  std::pair<Side, Side> sides(const Joint& joint) const {
    const Block &a = block(joint.a), &b = block(joint.b);
    if (a.fixed) return {mirrored(b, joint), side(b, joint)};
    if (b.fixed) return {side(a, joint), mirrored(a, joint)};
    return {side(a, joint), side(b, joint)};
  }

  bool is_restraint(const Joint& joint) const { return is_restraint(joint.a) || is_restraint(joint.b); }
  bool is_restraint(std::int64_t i) const { return block(i).component == Component::restraint; }
  bool both_fixed(const Joint& joint) const { return block(joint.a).fixed && block(joint.b).fixed; }
  const Material& material(const Side& s) const { return assembly_.materials[std::size_t(s.material)]; }

 private:
  const Block& block(std::int64_t i) const { return assembly_.blocks[std::size_t(i)]; }

  JointLaw interface_law() const {
    JointLaw law;  // masonry on fill: friction only
    law.friction_angle = law.residual_friction_angle = rules_.interface_friction;
    return law;
  }

  Side side(const Block& b, const Joint& joint) const {
    const double distance = std::abs(joint.normal.dot(b.centroid - polygon_centroid(joint.polygon)));
    return {b.component, b.material, std::max(distance, rules_.smallest_half_length)};
  }

  Side mirrored(const Block& moving, const Joint& joint) const {
    Side s = side(moving, joint);
    const auto nominal = rules_.nominal.find(moving.component);
    if (nominal != rules_.nominal.end()) s.half_length = 0.5 * joint.normal.cwiseAbs().dot(nominal->second);
    return s;
  }

  /// A joint between two like halves; without a table from the moduli.
  Stiffness of_masonry(const Side& s) const {
    return rules_.rows_from_moduli || rules_.table.contains(s.component) ? row(s) : times(moduli_half(s), 0.5);
  }
  Stiffness table_half(const Side& s) const { return times(row(s), 2.0); }
  Stiffness row(const Side& s) const {
    const auto given = rules_.table.find(s.component);
    if (given != rules_.table.end()) return given->second;
    const double size = rules_.nominal.at(s.component).mean();
    return {material(s).youngs_modulus / size, material(s).shear_modulus / size};
  }
  Stiffness moduli_half(const Side& s) const {
    return {material(s).youngs_modulus / s.half_length, material(s).shear_modulus / s.half_length};
  }

  const Assembly& assembly_;
  const JointRules& rules_;
};

/// Overrides by pair of material indices, low index first.
using Overrides = std::map<std::pair<std::int32_t, std::int32_t>, GeneratorInput::JointOverride>;

Overrides read_overrides(const Assembly& assembly, const GeneratorInput& input) {
  Overrides overrides;
  for (const auto& [key, value] : input.joints) {
    if (key == ring_pair) continue;
    std::pair<std::int32_t, std::int32_t> pair = {-1, -1};
    const auto n = std::int32_t(assembly.materials.size());
    std::string names;
    for (std::int32_t i = 0; i < n; ++i) {
      names += (i ? ", " : "") + assembly.materials[std::size_t(i)].name;
      for (std::int32_t j = 0; j < n; ++j) {
        const std::string name =
            assembly.materials[std::size_t(i)].name + "-" + assembly.materials[std::size_t(j)].name;
        if (name == key) pair = std::minmax(i, j);
      }
    }
    if (pair.first < 0) {
      throw InputError(
          "[joints] has \"{}\", which is not a pair of materials of this bridge. Write two of ({}) with a "
          "hyphen between them, such as \"{}-{}\", or \"ring-ring\" for the joints between the rings of a vault",
          key, names, assembly.materials.front().name, assembly.materials.back().name);
    }
    overrides[pair] = value;
  }
  return overrides;
}

/// Values of the case replace those of the rules.
void apply(const GeneratorInput::JointOverride& override, Stiffness& k, JointLaw& law) {
  if (override.kn >= 0.0) k.kn = override.kn;
  if (override.ks >= 0.0) k.ks = override.ks;
  if (override.has_law) law = override.law;
}

void apply(const Overrides& overrides, std::int32_t a, std::int32_t b, Stiffness& k, JointLaw& law) {
  const auto found = overrides.find(std::minmax(a, b));
  if (found != overrides.end()) apply(found->second, k, law);
}

const GeneratorInput::JointOverride* override_between_rings(const GeneratorInput& input, const RingJoints& rings) {
  const auto found = input.joints.find(ring_pair);
  if (found == input.joints.end()) return nullptr;
  if (rings.none())
    throw InputError(
        "[joints.ring-ring] is given, but no vault of this bridge has more than one ring. Set rings = 2 or more in a "
        "[[bridge.span]] of generator = \"bridge\", or leave the table out.");
  return &found->second;
}

}  // namespace

std::int32_t law_index(std::vector<JointLaw>& laws, const JointLaw& law) {
  const auto found = std::find(laws.begin(), laws.end(), law);
  if (found != laws.end()) return std::int32_t(found - laws.begin());
  laws.push_back(law);
  return std::int32_t(laws.size()) - 1;
}

JointLaw strength_of(const Material& material) {
  JointLaw law;
  law.tension = material.tensile_strength;
  law.cohesion = material.cohesion;
  law.friction_angle = law.residual_friction_angle = material.friction_angle;
  return law;
}

void assign_stiffness(Assembly& assembly, const JointRules& rules, const GeneratorInput& input) {
  const Assigner assigner(assembly, rules);
  const Overrides overrides = read_overrides(assembly, input);
  const RingJoints rings(assembly);
  const auto* of_rings = override_between_rings(input, rings);
  std::erase_if(assembly.joints, [&](const Joint& joint) { return assigner.both_fixed(joint); });
  for (Joint& joint : assembly.joints) {
    Stiffness k = assigner.stiffness(joint);
    JointLaw law = assigner.law(joint);
    const auto [a, b] = assigner.sides(joint);
    const bool ring = rings(joint);
    if (ring && !rules.rings_bonded) law.tension = law.cohesion = 0.0;
    apply(overrides, a.material, b.material, k, law);
    if (ring && of_rings) apply(*of_rings, k, law);
    if (assigner.is_restraint(joint)) k = times(k, rules.restraint_share);
    joint.kn = k.kn;
    joint.ks = k.ks;
    joint.law = law_index(assembly.laws, law);
  }
}

void assign_fill_stiffness(Assembly& assembly, const JointRules& rules, const GeneratorInput& input) {
  const Assigner assigner(assembly, rules);
  const Overrides overrides = read_overrides(assembly, input);
  const std::vector<std::int32_t> tets = triangle_tets(assembly.fill);
  for (FillJoint& joint : assembly.fill_joints) {
    const Block& block = assembly.blocks[std::size_t(joint.block)];
    const std::int32_t fill = assembly.fill.material[std::size_t(tets[std::size_t(joint.triangle)])];
    const Material& material = assembly.materials[std::size_t(fill)];
    Stiffness k = assigner.stiffness(joint, material);
    JointLaw law = assigner.law(joint, material);
    apply(overrides, block.fixed ? fill : block.material, fill, k, law);
    if (assigner.is_restraint(joint.block)) k = times(k, rules.restraint_share);
    joint.kn = k.kn;
    joint.ks = k.ks;
    joint.law = law_index(assembly.laws, law);
  }
}

namespace {

/// Throws InputError for blocks without moduli, from which the stiffness of their joints follows. A fixed block takes
/// the moduli of the other block.
void check_moduli(const Assembly& assembly) {
  std::vector<std::string> without;
  std::size_t count = 0;
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i) {
    const Block& block = assembly.blocks[i];
    const Material& m = assembly.materials[std::size_t(block.material)];
    if (block.fixed || (m.youngs_modulus > 0.0 && m.shear_modulus > 0.0)) continue;
    if (++count <= 3)
      without.push_back(fmt::format("{}, material \"{}\"", block_label(assembly, std::int64_t(i)), m.name));
  }
  if (count > 0)
    throw InputError(
        "{} joints have no stiffness. Give kn and ks, or materials with youngs_modulus and shear_modulus above 0. The "
        "blocks are: {}{}",
        counted(count, "block has no moduli, so its", "blocks have no moduli, so their"), fmt::join(without, "; "),
        count > without.size() ? "; …" : "");
}

}  // namespace

JointReport lay_joints(Assembly& assembly, const JointSearch& search, const Stiffness& uniform) {
  if ((uniform.kn > 0.0) != (uniform.ks > 0.0))
    throw InputError("kn is {} and ks is {} Pa/m. Give both, or neither; then they follow from the moduli.", uniform.kn,
                     uniform.ks);
  JointRules rules;
  rules.kind = uniform.kn > 0.0 ? JointRules::Kind::given : JointRules::Kind::moduli;
  rules.uniform = uniform;
  rules.interface_friction = radians(35.0);  // of blocks of backfill on masonry, as generated bridges have it
  if (rules.kind == JointRules::Kind::moduli) check_moduli(assembly);
  const JointReport report = find_joints(assembly, search);
  assembly.laws.clear();
  assign_stiffness(assembly, rules, {});
  return report;
}

JointRules uniform_rules(const GeneratorInput& in) {
  JointRules rules;
  if (in("kn") > 0.0 && in("ks") > 0.0) {
    rules.kind = JointRules::Kind::given;
    rules.uniform = {in("kn"), in("ks")};
  } else if (in("kn") > 0.0 || in("ks") > 0.0) {
    throw InputError("[bridge] kn = {:g} and ks = {:g} Pa/m. Give both, or neither; then they follow from the moduli.",
                     in("kn"), in("ks"));
  }
  return rules;
}

}  // namespace voussoir
