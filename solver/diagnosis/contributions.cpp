#include "solver/diagnosis/contributions.h"

#include <map>

#include "solver/base/error.h"
#include "solver/effects/parts.h"
#include "solver/model/interface.h"
#include "solver/model/quadrature.h"

namespace voussoir {

namespace {

using Vector12 = Eigen::Matrix<double, 12, 1>;
using Matrix6x12 = Eigen::Matrix<double, 6, 12>;

Vec3 reach_of(const Assembly& assembly, std::int64_t block, const Vec3& place) {
  return place - assembly.blocks[std::size_t(block)].centroid;
}

/// kn times the strip's area along the line between the anchors, as make_tie() of solver/model has it.
Matrix12 tie_stiffness(const Assembly& assembly, const Joint& tie) {
  const auto [from, to] = tie_anchors(tie);
  const Vec3 n = (from - to).normalized();
  Vector12 way;
  way << -n, -reach_of(assembly, tie.a, from).cross(n), n, reach_of(assembly, tie.b, to).cross(n);
  return tie.kn * patch_shape(tie.polygon, tie.normal, 3).area * way * way.transpose();
}

}  // namespace

Matrix12 pair_stiffness(const Assembly& assembly, const Joint& joint) {
  if (is_tie(assembly, joint)) return tie_stiffness(assembly, joint);
  const PatchShape shape = patch_shape(joint.polygon, joint.normal, 3);
  const Mat3 to_local = shape.frame.transpose();
  Matrix6x12 rows = Matrix6x12::Zero();
  rows.block<3, 3>(0, 0) = rows.block<3, 3>(3, 3) = -to_local;
  rows.block<3, 3>(0, 6) = rows.block<3, 3>(3, 9) = to_local;
  rows.block<3, 3>(0, 3) = to_local * skew(reach_of(assembly, joint.a, shape.centroid));
  rows.block<3, 3>(0, 9) = -to_local * skew(reach_of(assembly, joint.b, shape.centroid));
  Vector6 local;
  local << joint.kn * shape.area, joint.ks * shape.area, joint.ks * shape.area, joint.ks * (shape.ss + shape.tt),
      joint.kn * shape.tt, joint.kn * shape.ss;
  return rows.transpose() * local.asDiagonal() * rows;
}

Matrix15 patch_stiffness(const Assembly& assembly, const FillJoint& joint) {
  const PatchShape shape = patch_shape(joint.polygon, joint.normal, 3);
  const auto& triangle = assembly.fill.triangles[std::size_t(joint.triangle)];
  InterfacePatch patch;
  std::array<Vec3, 3> reach;
  for (std::size_t i = 0; i < 3; ++i) {
    const Vec3& corner = assembly.fill.nodes[std::size_t(triangle[i])];
    store(patch.rest[i], shape.frame.transpose() * (corner - shape.centroid));
    reach[i] = reach_of(assembly, joint.block, corner);
  }
  const Mat3 functions = shape_functions(patch);
  const Mat3 d = shape.frame * Vec3(joint.kn, joint.ks, joint.ks).asDiagonal() * shape.frame.transpose();
  Mat3 share = Mat3::Zero();  // m2: Σ w N_i N_j
  for (const PatchPoint& point : moment_points(shape)) {
    const Vec3 n = functions * Vec3(1.0, point.s, point.t);
    share += point.weight * n * n.transpose();
  }
  std::array<std::array<Mat3, 3>, 3> corners;
  for (std::size_t i = 0; i < 3; ++i)
    for (std::size_t j = 0; j < 3; ++j) corners[i][j] = share(Eigen::Index(i), Eigen::Index(j)) * d;
  const InterfaceStiffness of = interface_stiffness(corners, reach);
  Matrix15 k;
  k.topLeftCorner<6, 6>() = of.own;
  for (std::size_t i = 0; i < 3; ++i) {
    const auto row = Eigen::Index(6 + 3 * i);
    k.block<3, 6>(row, 0) = of.across[i];
    k.block<6, 3>(0, row) = of.across[i].transpose();
    for (std::size_t j = 0; j < 3; ++j) k.block<3, 3>(row, Eigen::Index(6 + 3 * j)) = of.corners[i][j];
  }
  return k;
}

std::vector<FillElement> fill_elements(const Assembly& assembly) {
  std::map<std::int32_t, FillLaw> laws;  // by material
  for (const std::int32_t material : assembly.fill.material)
    if (!laws.contains(material)) laws[material] = fill_law(assembly.materials.at(std::size_t(material)));
  std::vector<FillElement> elements;
  elements.reserve(assembly.fill.tets.size());
  for (std::size_t i = 0; i < assembly.fill.tets.size(); ++i) {
    const TetShape shape = tet_shape(assembly.fill.tets[i], assembly.fill.nodes);
    const FillLaw& law = laws.at(assembly.fill.material[i]);
    elements.push_back({shape.nodes, shape.gradient, shape.volume, law.bulk, law.shear});
  }
  return elements;
}

Matrix6 block_mass(const Block& block) {
  Matrix6 m = Matrix6::Zero();
  m.topLeftCorner<3, 3>() = block.mass * Mat3::Identity();
  m.bottomRightCorner<3, 3>() = block.inertia;
  return m;
}

Contributions::Element shear_term(const FillElement& element) {
  return {element.nodes, element.gradient, element.volume * element.shear};
}

Contributions::Ring ring_term(FillRing ring) {
  const double scale = 0.25 / ring.weight;
  return {std::move(ring.nodes), std::move(ring.pull), scale};
}

Contributions contributions(const Assembly& assembly) {
  Contributions c;
  for (const Joint& joint : assembly.joints) c.pairs.push_back({joint.a, joint.b, pair_stiffness(assembly, joint)});
  for (const FillJoint& patch : assembly.fill_joints)
    c.patches.push_back(
        {patch.block, assembly.fill.triangles[std::size_t(patch.triangle)], patch_stiffness(assembly, patch)});
  const std::vector<FillElement> elements = fill_elements(assembly);
  for (const FillElement& e : elements) c.elements.push_back(shear_term(e));
  for (FillRing& ring : fill_rings(elements, assembly.fill.nodes.size())) {
    if (ring.nodes.empty())
      throw InputError("node {} of the fill belongs to no tetrahedron. Remove it from the mesh.", c.rings.size());
    c.rings.push_back(ring_term(std::move(ring)));
  }
  for (std::size_t i = 0; i < assembly.blocks.size(); ++i)
    c.blocks.push_back({std::int64_t(i), block_mass(assembly.blocks[i])});
  for (std::size_t i = 0; i < elements.size(); ++i) {
    const double density = assembly.materials[std::size_t(assembly.fill.material[i])].density;
    c.lumps.push_back({elements[i].nodes, 0.25 * density * elements[i].volume});
  }
  return c;
}

}  // namespace voussoir
