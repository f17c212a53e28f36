// Models with stones and fill, for rungs and tests of their interface.
#pragma once
#include "geometry/fill_joints.h"
#include "geometry/fill_mesh.h"
#include "tools/ladder/fill_rig.h"
#include "tools/ladder/models.h"

namespace voussoir::ladder {

/// Puts a fill of one material between existing stones, with a uniform interface.
inline Assembly filled(Assembly assembly, FillMesh mesh, const Material& soil, double kn, double ks,
                       const JointLaw& law) {
  finish_blocks(assembly);
  find_joints(assembly);
  for (Joint& joint : assembly.joints) joint.kn = kn, joint.ks = ks, joint.law = 0;
  assembly.materials.push_back(soil);
  mesh.material.assign(mesh.tets.size(), std::int32_t(assembly.materials.size()) - 1);
  assembly.fill = std::move(mesh);
  find_surface(assembly.fill);
  find_fill_joints(assembly);
  assembly.laws = {law};
  for (FillJoint& joint : assembly.fill_joints) joint.kn = kn, joint.ks = ks, joint.law = 0;
  return assembly;
}

/// Rotates all nodes of a mesh, or the corners of a stone, about the origin.
inline void turn_all(std::vector<Vec3>& points, const Eigen::Quaterniond& turn) {
  for (Vec3& p : points) p = turn * p;
}

inline void move_node(State& state, std::size_t node, const Vec3& u) {
  for (std::size_t c = 0; c < 3; ++c) state.fill.pose[node_width * node + c] = u[Eigen::Index(c)];
}
inline Vec3 node_motion(const State& state, std::size_t node) {
  return Vec3(&state.fill.motion[node_width * node]);
}

}  // namespace voussoir::ladder
