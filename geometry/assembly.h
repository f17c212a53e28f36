// The block assembly: stones, the joints between them, a deformable fill, and what each joint is made of. It is what a
// generator or an importer makes, what an assembly file holds, and what the solver builds its model from.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "geometry/polyhedron.h"

namespace voussoir {

/// Kinds of part a stone can belong to; the index is what files store, the names are written beside it.
enum class Component : std::int32_t {
  arch,
  pier,
  abutment,
  infill,
  backing,
  spandrel,
  parapet,
  backfill,
  base,
  restraint,
  wall,
  block
};
const std::vector<std::string>& component_names();  // in the order of the enumeration

/// One stone: a rigid body made of one or more convex cells that do not overlap.
struct Block {
  std::vector<Polyhedron> cells;
  Component component = Component::block;
  std::int32_t part = 0;      // arch 0…, pier 0…; walls: 0 for y−, 1 for y+, 2 between
  std::int32_t material = 0;  // index into Assembly::materials
  bool fixed = false;         // moves with the ground
  // Filled by finish_blocks():
  double mass = 0.0;             // kg
  Vec3 centroid = Vec3::Zero();  // m
  Mat3 inertia = Mat3::Zero();   // kg m2 about the centroid, world axes
};

/// A masonry or fill material (SI; angles in radians).
struct Material {
  std::string name;
  double density = 0.0;           // kg/m3
  double youngs_modulus = 0.0;    // Pa
  double shear_modulus = 0.0;     // Pa
  double tensile_strength = 0.0;  // Pa
  double cohesion = 0.0;          // Pa
  double friction_angle = 0.0;    // rad
  double dilation_angle = 0.0;    // rad, of a deformable fill
};

/// Strength of a joint (SI; angles in radians). Stiffness is per joint, see Joint. A `tie` is no joint but a bar from
/// one stone to another that only pulls: kn, tension (where it yields) and prestress times the area of its polygon are
/// its axial stiffness, yield force and pretension; the other strengths are not used.
struct JointLaw {
  enum class Kind : std::int32_t { brittle, softening, elastic, tie, composite };
  Kind kind = Kind::brittle;
  double tension = 0.0;                                // Pa
  double cohesion = 0.0;                               // Pa
  double friction_angle = 0.0;                         // rad
  double residual_cohesion = 0.0;                      // Pa, once the bond is lost
  double residual_friction_angle = 0.0;                // rad, once the bond is lost
  double dilation_angle = 0.0;                         // rad
  std::array<double, 2> fracture_energy = {0.0, 0.0};  // GI, GII, J/m2; softening and composite
  double prestress = 0.0;                              // Pa, in the placement as built; tie only
  // Composite only (docs/theory/joints.md):
  double compressive_strength = 0.0;  // Pa; 0: it never crushes
  double compressive_energy = 0.0;    // J/m2, beyond the peak and above the residual strength
  double compressive_peak = 0.0;      // m, inelastic closure at the strength; 0: as much as the elastic one
  double cap_shear = 9.0;             // weight of the shear in the cap
  double dilation_length = 0.0;       // m, slip over which the dilation fades; 0: it does not
  double dilation_pressure = 0.0;     // Pa, beyond which there is none; 0: at any
  bool operator==(const JointLaw&) const = default;
};
const std::vector<std::string>& joint_law_kinds();  // names in the order of JointLaw::Kind

/// A joint patch: the overlap polygon of two opposed faces of two stones. Of a tie it is a strip that stands for the
/// bar: from the middle of its first side, where the bar is anchored in a, to that of its third, the anchor in b.
struct Joint {
  std::int64_t a = 0, b = 0;            // blocks, a < b
  std::int32_t cell_a = 0, cell_b = 0;  // convex cell within each block
  std::int32_t face_a = 0, face_b = 0;  // face within each cell
  Polygon polygon;                      // counter-clockwise about `normal`, m
  Vec3 normal = Vec3::Zero();           // unit, from a to b
  double area = 0.0;                    // m2
  double kn = 0.0, ks = 0.0;            // Pa/m
  std::int32_t law = 0;                 // index into Assembly::laws
};

/// Where the bar of a tie is anchored in a and in b, m. Throws InputError where its polygon is no strip.
std::array<Vec3, 2> tie_anchors(const Joint& tie);

/// The deformable fill: one continuum of linear tetrahedra that share whole faces.
struct FillMesh {
  std::vector<Vec3> nodes;                             // m
  std::vector<std::array<std::int32_t, 4>> tets;       // nodes; positive volume: (x1−x0)·((x2−x0)×(x3−x0)) > 0
  std::vector<std::int32_t> material;                  // of each tetrahedron: index into Assembly::materials
  std::vector<std::array<std::int32_t, 3>> triangles;  // its surface, counter-clockwise seen from outside
  bool empty() const { return tets.empty(); }
};

/// A patch between a stone and the fill: the overlap of one of its faces with a triangle of the fill's surface.
struct FillJoint {
  std::int64_t block = 0;
  std::int32_t cell = 0, face = 0;
  std::int32_t triangle = 0;   // of FillMesh::triangles
  Polygon polygon;             // in the triangle's plane, counter-clockwise about `normal`, m
  Vec3 normal = Vec3::Zero();  // unit, out of the stone into the fill
  double area = 0.0;           // m2
  double kn = 0.0, ks = 0.0;   // Pa/m
  std::int32_t law = 0;        // index into Assembly::laws
};

/// A named point that moves with a block.
struct Sensor {
  std::string id;
  Vec3 position = Vec3::Zero();   // m
  Vec3 direction = Vec3::Zero();  // unit
  std::int64_t block = 0;
};

struct Assembly {
  std::string generator;  // "cs1", "import", …
  std::string case_text;  // the case file it was made from, may be empty
  std::vector<Material> materials;
  std::vector<Block> blocks;
  std::vector<Joint> joints;  // sorted by (a, b, cell_a, cell_b, face_a, face_b), no pair of faces twice
  std::vector<JointLaw> laws;
  FillMesh fill;                                            // empty: none, or one of rigid blocks
  std::vector<FillJoint> fill_joints;                       // sorted by (block, cell, face, triangle)
  std::map<std::string, std::vector<std::int64_t>> groups;  // block indices: "keystone 0", "wall y- pier 1", …
  std::vector<Sensor> sensors;
  std::vector<std::string> effects;  // that have changed it, in words: see solver/effects
};

/// Fills mass, centroid and inertia of each block from its cells and material. Throws InputError that names the block
/// whose volume is zero, negative (inside-out) or not finite.
void finish_blocks(Assembly& assembly);
/// "block 12 (arch, part 0)": how errors and logs name a block.
std::string block_label(const Assembly& assembly, std::int64_t block);
double block_density(const Assembly& assembly, const Block& block);
Box block_box(const Block& block);

}  // namespace voussoir
