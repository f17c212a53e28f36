#include "io/case/composite_joints.h"

#include "solver/base/error.h"
#include "solver/model/laws.h"

namespace voussoir {

namespace {

void check_energy(const Assembly& assembly, std::size_t i) {
  const Joint& joint = assembly.joints[i];
  const JointLaw& law = assembly.laws[std::size_t(joint.law)];
  if (law.kind != JointLaw::Kind::composite || law.compressive_strength <= 0.0) return;
  const double least = least_compressive_energy(law, joint.kn, joint.ks);
  if (law.compressive_energy > least) return;
  throw InputError(
      "joint {} between blocks {} and {}: its compressive_energy, {:g} J/m2, is too small for its stiffness (kn = "
      "{:g}, ks = {:g} Pa/m) and its compressive_strength, {:g} Pa. The joint would snap back when it crushes. Give "
      "more than {:.4g} J/m2, a larger kn and ks, or a smaller compressive_strength.",
      i, joint.a, joint.b, law.compressive_energy, joint.kn, joint.ks, law.compressive_strength, least);
}

}  // namespace

void check_composite_joints(const Assembly& assembly) {
  for (std::size_t i = 0; i < assembly.joints.size(); ++i) check_energy(assembly, i);
  for (const FillJoint& joint : assembly.fill_joints)
    if (assembly.laws[std::size_t(joint.law)].kind == JointLaw::Kind::composite)
      throw InputError(
          "block {} has a joint of kind \"composite\" with the deformable fill. Only joints between stones can have "
          "this kind. Set kind = \"brittle\" for that pair of materials.",
          joint.block);
}

}  // namespace voussoir
