// Joints, and patches of a deformable fill, without bond that are open at the amplitude of the data: a share of their
// area carries nothing.
#include "solver/effects/effect.h"
#include "solver/effects/parts.h"

namespace voussoir {

namespace {

template <class Patch>  // a Joint or a FillJoint
bool bonded(const Assembly& assembly, const Patch& patch) {
  const JointLaw& law = assembly.laws[std::size_t(patch.law)];
  return law.kind == JointLaw::Kind::elastic || law.kind == JointLaw::Kind::tie || law.tension > 0.0 ||
         law.cohesion > 0.0;
}

void apply_amplitude_stiffness(Assembly& assembly, const std::string&, const std::vector<double>& values) {
  for (Joint& joint : assembly.joints)
    if (!bonded(assembly, joint)) joint.kn *= 1.0 - values[0], joint.ks *= 1.0 - values[0];
  for (FillJoint& patch : assembly.fill_joints)
    if (!bonded(assembly, patch)) patch.kn *= 1.0 - values[0], patch.ks *= 1.0 - values[0];
}

std::vector<std::string> places_of_amplitude_stiffness(const Assembly& assembly) {
  for (const Joint& joint : assembly.joints)
    if (!bonded(assembly, joint)) return {"all"};
  for (const FillJoint& patch : assembly.fill_joints)
    if (!bonded(assembly, patch)) return {"all"};
  return {};
}

}  // namespace

Effect amplitude_stiffness() {
  return {"amplitude_stiffness",
          "dry joints are partly open at the amplitude of the measurement",
          "Measure again at another level of vibration. If the frequencies fall when the level rises, joints open.",
          {{"share_open", "-", "share of the area of the joints without bond that is open", 0.0, 0.95, 0.0, 0.3, 0.2}},
          places_of_amplitude_stiffness,
          apply_amplitude_stiffness,
          nullptr};
}

}  // namespace voussoir
