// The block assembly: stones, their joints with stiffness and strength, and a deformable fill. Generators and importers
// make it, assembly files store it, and the solver builds its model from it.
#pragma once
#include <array>
#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "geometry/polyhedron.h"

namespace voussoir {

/// The kind of part to which a stone belongs. Files store the index and the names.
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

/// One stone: a rigid body of one or more convex cells that do not overlap.
struct Block {
  std::vector<Polyhedron> cells;
  Component component = Component::block;
  std::int32_t part = 0;      // arch 0…, pier 0…; walls: 0 for y−, 1 for y+, 2 between
  std::int32_t material = 0;  // index into Assembly::materials
  bool fixed = false;         // moves with the ground
  // Set by finish_blocks():
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

/// Strength of a joint (SI; angles in radians). The stiffness is in Joint. The kind `tie` is a bar between two stones
/// that only pulls: kn, tension (yield) and prestress times the area of its polygon are its axial stiffness, yield
/// force and pretension; its other strengths are not used.
struct JointLaw {
  enum class Kind : std::int32_t { brittle, softening, elastic, tie, composite };
  Kind kind = Kind::brittle;
  double tension = 0.0;                                // Pa
  double cohesion = 0.0;                               // Pa
  double friction_angle = 0.0;                         // rad
  double residual_cohesion = 0.0;                      // Pa, after the bond is lost
  double residual_friction_angle = 0.0;                // rad, after the bond is lost
  double dilation_angle = 0.0;                         // rad
  std::array<double, 2> fracture_energy = {0.0, 0.0};  // GI, GII, J/m2; softening and composite
  double prestress = 0.0;                              // Pa, in the geometry as built; tie only
  // Composite only (docs/theory/joints.md):
  double compressive_strength = 0.0;  // Pa; 0: no crushing
  double compressive_energy = 0.0;    // J/m2, beyond the peak and above the residual strength
  double compressive_peak = 0.0;      // m, inelastic closure at the strength; 0: equal to the elastic closure
  double cap_shear = 9.0;             // weight of the shear in the cap
  double dilation_length = 0.0;       // m, slip over which the dilation falls to 1/e; 0: constant
  double dilation_pressure = 0.0;     // Pa, pressure above which there is no dilation; 0: no limit
  bool operator==(const JointLaw&) const = default;
};
const std::vector<std::string>& joint_law_kinds();  // names in the order of JointLaw::Kind

/// A joint patch: the overlap polygon of two opposed faces of two stones. The polygon of a tie is a strip along the
/// bar: the anchor in a is the middle of its first side, the anchor in b is the middle of its third side.
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

/// The anchors of a tie in a and in b, m. Throws InputError if its polygon is not a strip.
std::array<Vec3, 2> tie_anchors(const Joint& tie);

/// The deformable fill: one continuum of linear tetrahedra that share whole faces.
struct FillMesh {
  std::vector<Vec3> nodes;                        // m
  std::vector<std::array<std::int32_t, 4>> tets;  // indices of nodes; positive volume: (x1−x0)·((x2−x0)×(x3−x0)) > 0
  std::vector<std::int32_t> material;             // for each tetrahedron: index into Assembly::materials
  std::vector<std::array<std::int32_t, 3>> triangles;  // the surface, counter-clockwise seen from outside
  bool empty() const { return tets.empty(); }
};

/// A patch between a stone and the fill: the overlap of a face of the stone with a triangle of the surface of the fill.
struct FillJoint {
  std::int64_t block = 0;
  std::int32_t cell = 0, face = 0;
  std::int32_t triangle = 0;   // index into FillMesh::triangles
  Polygon polygon;             // in the plane of the triangle, counter-clockwise about `normal`, m
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
  std::string case_text;  // text of its case file; may be empty
  std::vector<Material> materials;
  std::vector<Block> blocks;
  std::vector<Joint> joints;  // sorted by (a, b, cell_a, cell_b, face_a, face_b), no pair of faces twice
  std::vector<JointLaw> laws;
  FillMesh fill;                                            // empty: no fill, or a fill of rigid blocks
  std::vector<FillJoint> fill_joints;                       // sorted by (block, cell, face, triangle)
  std::map<std::string, std::vector<std::int64_t>> groups;  // block indices: "keystone 0", "wall y- pier 1", …
  std::vector<Sensor> sensors;
  std::vector<std::string> effects;  // effects that have changed it, in words; see solver/effects
};

/// Sets mass, centroid and inertia of each block from its cells and material. Throws InputError with the name of a
/// block whose volume is zero, negative (faces inside-out) or not finite.
void finish_blocks(Assembly& assembly);
/// The name of a block in errors and logs: "block 12 (arch, part 0)".
std::string block_label(const Assembly& assembly, std::int64_t block);
double block_density(const Assembly& assembly, const Block& block);  // kg/m3
Box block_box(const Block& block);                                   // m, around all its cells

}  // namespace voussoir
