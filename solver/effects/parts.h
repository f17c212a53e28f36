// Named parts of a bridge, and functions that change them. For effects and the diagnosis.
#pragma once
#include <functional>
#include <set>
#include <string>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

using BlockSet = std::vector<bool>;  // by block

/// Blocks for which `in` holds.
BlockSet blocks_where(const Assembly& assembly, const std::function<bool(const Block&)>& in);
inline BlockSet component(const Assembly& assembly, Component c) {
  return blocks_where(assembly, [c](const Block& b) { return b.component == c; });
}

/// Masonry parts that can be softer or stiffer than assumed: "arch 0" …, "pier 0" …, "abutment left", "abutment right",
/// "spandrel y-", "spandrel y+", "spandrel internal", "backing"; "arches", "piers", "abutments", "spandrels" where
/// there is more than one; "all". Only those that exist in the assembly.
std::vector<std::string> masonry_parts(const Assembly& assembly);
/// The blocks of one of them; the infill of a pier or abutment belongs to it.
BlockSet masonry_part(const Assembly& assembly, const std::string& name);

/// The part of the bridge that each block belongs to.
std::vector<std::string> parts_of_blocks(const Assembly& assembly);

/// Supports with a base: "abutment left", "pier 0", …. Their bases are the groups "base …".
std::vector<std::string> supports(const Assembly& assembly);
std::int64_t base_of(const Assembly& assembly, const std::string& support);

/// Ends with free faces: "left", "right", "both".
std::vector<std::string> free_ends(const Assembly& assembly);
/// An outer face of a block in the plane of an end.
struct EndFace {
  std::int64_t block = 0;
  std::int32_t cell = 0, face = 0;
  Polygon polygon;  // counter-clockwise seen from outside
};
/// The faces of one end ("left": least x) of all blocks except parapets and fixed blocks.
std::vector<EndFace> end_faces(const Assembly& assembly, bool left);
Box box_of(const std::vector<EndFace>& faces);
/// "both" is left and right.
inline bool acts_at(const std::string& where, bool left) {
  return where == "both" || where == (left ? "left" : "right");
}

/// {"all"} if the assembly has such blocks, else empty.
std::vector<std::string> all_if_any(const Assembly& assembly, Component c);

/// Whether the joint is a bar and not a masonry joint.
inline bool is_tie(const Assembly& assembly, const Joint& joint) {
  return assembly.laws[std::size_t(joint.law)].kind == JointLaw::Kind::tie;
}

/// Multiplies kn and ks of the joints inside a set of blocks, or between two.
void scale_inside(Assembly& assembly, const BlockSet& part, double factor);
void scale_between(Assembly& assembly, const BlockSet& one, const BlockSet& other, double factor);
/// Raises the strength of the `chosen` joints to at least these values (Pa) and multiplies their stiffness by a factor.
/// Joints without strength limits, and ties, are unchanged.
void strengthen(Assembly& assembly, const std::function<bool(const Joint&)>& chosen, double tension, double cohesion,
                double factor);

/// Multiplies the density of blocks. Materials that other blocks also use are split.
void scale_density(Assembly& assembly, const BlockSet& part, double factor);
/// {"all"} if there is backfill, of blocks or deformable, else empty.
std::vector<std::string> all_if_filled(const Assembly& assembly);
/// Multiplies moduli and density of the deformable fill. Materials that blocks also use are split.
void scale_fill(Assembly& assembly, double stiffness, double density);
/// Multiplies kn and ks of the patches between the fill and these blocks.
void scale_patches(Assembly& assembly, const BlockSet& part, double factor);
/// Calls scale_inside() for a masonry part with the first value of an effect. Several effects use it.
void scale_masonry_part(Assembly& assembly, const std::string& where, const std::vector<double>& values);

/// Mean stiffness over the area, and law, of the joints of this component with normals along x. If it has none, those
/// of all masonry.
struct Neighbourhood {
  double kn = 0.0, ks = 0.0;  // Pa/m
  std::int32_t law = 0;
};
Neighbourhood lengthways(const Assembly& assembly, Component component);

/// Appends a block in the shape of a box between the corners `low` and `high` (m, world axes), with its computed
/// properties such as mass. Returns its index.
std::int64_t add_box_block(Assembly& assembly, const Vec3& low, const Vec3& high, Component component,
                           std::int32_t material, bool fixed);
/// Appends a joint of blocks a and b over a polygon that is counter-clockwise about `normal`, from a to b; kn and ks
/// are in Pa/m. The block with the lower index becomes Joint::a. The reference is valid until the next joint is added.
Joint& add_joint(Assembly& assembly, std::int64_t a, std::int64_t b, const Polygon& polygon, const Vec3& normal,
                 double kn, double ks, std::int32_t law);
/// Adds joints between the faces of an end and a block in contact with them. Each joint has the law and a share of the
/// longitudinal stiffness of the joints of the component of its face, but at most `most` (Pa/m).
void join_end(Assembly& assembly, const std::vector<EndFace>& faces, std::int64_t block, double share,
              double most = 1e300);
std::int32_t elastic_law_index(Assembly& assembly);
/// Sorts the joints as Assembly::joints requires: by blocks, cells and faces.
void sort_joints(Assembly& assembly);

}  // namespace voussoir
