#include "geometry/fill_import.h"

#include <algorithm>
#include <cmath>

#include "geometry/stiffness.h"
#include "solver/base/error.h"

namespace voussoir {

namespace {

constexpr double kNearest = 1e-3;  // m: nearer centroids count as this far from the patch

void set_stiffness(const Assembly& assembly, const FillInterface& interface, FillJoint& joint) {
  joint.kn = interface.kn;
  joint.ks = interface.ks;
  if (interface.kn > 0.0) return;
  const Block& block = assembly.blocks[std::size_t(joint.block)];
  const Material& stone = assembly.materials[std::size_t(block.material)];
  if (!(stone.youngs_modulus > 0.0 && stone.shear_modulus > 0.0)) {
    throw InputError(
        "{}: its material \"{}\" has no moduli, from which the stiffness of the patches of the fill would follow. Give "
        "kn and ks.",
        block_label(assembly, joint.block), stone.name);
  }
  const double distance = std::abs(joint.normal.dot(block.centroid - polygon_centroid(joint.polygon)));
  const double dc = 2.0 * std::max(distance, kNearest);
  joint.kn = interface.share * stone.youngs_modulus / dc;
  joint.ks = interface.share * stone.shear_modulus / dc;
}

}  // namespace

FillJointReport put_fill(Assembly& assembly, FillMesh mesh, std::int32_t material, const FillInterface& interface) {
  if (!assembly.fill.empty()) {
    throw InputError("the assembly already has a deformable fill of {} tetrahedra. Use an assembly without one.",
                     assembly.fill.tets.size());
  }
  if ((interface.kn > 0.0) != (interface.ks > 0.0)) {
    throw InputError(
        "patches of the fill: kn is {:g} and ks is {:g} Pa/m. Give both, or neither; then they follow from the moduli.",
        interface.kn, interface.ks);
  }
  assembly.fill = std::move(mesh);
  assembly.fill.material.assign(assembly.fill.tets.size(), material);
  if (assembly.blocks.empty()) return {};
  const FillJointReport report = find_fill_joints(assembly, interface.search);
  JointLaw law;
  law.friction_angle = law.residual_friction_angle = interface.friction;
  const std::int32_t index = law_index(assembly.laws, law);
  for (FillJoint& joint : assembly.fill_joints) {
    set_stiffness(assembly, interface, joint);
    joint.law = index;
  }
  return report;
}

}  // namespace voussoir
