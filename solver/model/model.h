// The model: all data of bodies and patches that do not change during a run, in the layout of the time step. Bodies are
// ordered along a space-filling curve and divided into tiles. The joints of a tile are those whose first body in that
// order lies in it. Eight of them form a batch, in which each quantity is one SIMD register. A tile sums the wrenches
// of its joints body by body in the order of the joints, which changes during a run (solver/contact/grouping).
#pragma once
#include <algorithm>
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/assembly.h"
#include "geometry/convex.h"
#include "solver/base/arrays.h"
#include "solver/base/lanes.h"
#include "solver/model/construction.h"
#include "solver/model/fill_model.h"
#include "solver/model/laws.h"
#include "solver/model/quadrature.h"
#include "solver/model/settings.h"

namespace voussoir {

inline void store(double* to, const Vec3& from) {
  for (int i = 0; i < 3; ++i) to[i] = from[i];
}

/// Constants of one body; the reference placement is the assembly's.
struct Body {
  Vec3 centroid = Vec3::Zero();  // m
  double mass = 0.0;             // kg, of weight and inertia
  double inertial_mass = 0.0;    // kg, of inertia (differs from mass only under mass scaling)
  Mat3 inertia = Mat3::Zero();   // kg m2, reference axes, scaled like inertial_mass
  Mat3 inverse_inertia = Mat3::Zero();
  double radius = 0.0;         // m, centroid to the farthest vertex
  bool fixed = false;          // moves with the ground, or as prescribed by a stage
  std::uint8_t free_ways = 0;  // of a fixed body: bit c is set if a guide allows it to move along axis c
  bool turns = false;          // of a fixed body: a guide allows it to rotate
  /// Whether displacement (c < 3) or rotation c is prescribed.
  bool held(int c) const { return fixed && !(c < 3 ? free_ways >> c & 1 : turns); }
  bool still() const { return fixed && free_ways == 0 && !turns; }
  void hold() { fixed = true, free_ways = 0, turns = false; }  // also where a guide leaves it free
};

/// Geometry of one patch for the point-by-point path. The local axes (n, s, t) are fixed to both bodies: e_a and e_b
/// rotate them into the reference axes of each body, so that R_a e_a = R_b e_b at the placement in which the patch was
/// made.
struct Patch {
  std::int32_t a = 0, b = 0;  // bodies
  std::int32_t cell_a = 0, cell_b = 0;
  std::int32_t law = 0;  // index into Model::laws
  // Its points are rows first_point … of tables whose rows hold `stride` patches side by side, see point_index().
  std::int32_t first_point = 0, point_count = 0, stride = 1, lane = 0;
  std::int32_t batch = 0;                           // of joints, or of contacts
  std::int32_t first_corner = 0, corner_count = 0;  // its polygon, for files and pictures
  double arm_a[3] = {}, arm_b[3] = {};              // m, centroid of the body to that of the patch, reference axes
  double place[3] = {};                             // m, X_a + arm_a
  double shift[3] = {};  // m, (X_b + arm_b) − (X_a + arm_a): zero for the assembly's joints
  double e_a[4] = {1, 0, 0, 0}, e_b[4] = {1, 0, 0, 0};
  double gap[3] = {};                     // un (m), θs, θt (rad) at the placement in which the patch was made
  double kn = 0.0, ks = 0.0;              // Pa/m
  double area = 0.0, ss = 0.0, tt = 0.0;  // m2, m4, m4
  // The stress-free jump (m, rad) of a joint whose stones had moved before it was made.
  double built[6] = {};
  // Above 0 (m): a tie of this length as built instead of a patch. arm_a and arm_b then end at its anchors, `shift` is
  // the vector from one to the other, and ss = tt = 0; see tie_jump().
  double length = 0.0;
};

/// Index of number `c` of `columns` at point `i` of a patch in a table of points.
inline std::size_t point_index(const Patch& p, int i, int columns, int c) {
  return (std::size_t(p.first_point + i) * std::size_t(columns) + std::size_t(c)) * std::size_t(p.stride) +
         std::size_t(p.lane);
}
/// A point from a table of s, t, weight.
inline PatchPoint patch_point(const Patch& p, const Array<double>& table, int i) {
  return {table[point_index(p, i, 3, 0)], table[point_index(p, i, 3, 1)], table[point_index(p, i, 3, 2)]};
}
/// A corner from a table of s, t.
inline PatchPoint patch_corner(const Patch& p, const Array<double>& table, int i) {
  const std::size_t at = 2 * std::size_t(p.first_corner + i);
  return {table[at], table[at + 1], 0.0};
}

constexpr int pose_width = 8;    // displacement 3, quaternion 4 (w x y z), unused: one cache line per body
constexpr int wrench_width = 8;  // force 3, moment about the world's origin 3, unused: one cache line

/// Eight patches, one in each lane: the data common to all kinds of patches.
struct alignas(64) PatchBatch {
  Lanes arm_a[3], place[3], frame[4];
  Lanes kn, ks, area;
  std::int32_t pose_a[lane_count];  // index of the pose of the first body in State::pose
  std::int32_t law_of[lane_count];
  std::int32_t count = 0;        // patches in use; spare lanes repeat the last patch and are never written
  std::int32_t law = 0;          // of all lanes; −1: they differ
  std::int32_t first_point = 0;  // row of the tables of points
  std::int32_t points = 9;       // largest number of any lane; missing points repeat the last with zero weight
  std::int32_t body_a(std::size_t lane) const { return pose_a[lane] / pose_width; }
};

/// Eight joints of the assembly: all data that the intact path reads.
struct alignas(64) JointBatch : PatchBatch {
  std::int32_t pose_b[lane_count];
  std::int32_t sum_a[lane_count], sum_b[lane_count];  // indices of the sums of their wrenches among those of all tiles
  std::int32_t first_joint = 0;
  std::int32_t first_corner = 0;  // into Model::batch_corners
  std::int32_t corners = 4;       // largest number of any lane
  bool rectangles = false;        // all lanes: points and corners follow from half_s and half_t
  bool touches_still = false;     // some lane: a body of Model::still
  Lanes arm_b[3];
  Lanes ss, tt;
  Lanes half_s, half_t;  // m: the polygon lies within ±half_s, ±half_t of its centroid; a rectangle fills that
  std::int32_t body_b(std::size_t lane) const { return pose_b[lane] / pose_width; }
};

/// Eight contacts of one tile, one in each lane; free lanes are mode_gone. In contrast to joints, their bodies had
/// moved and rotated when they were made, and they have a gap.
struct alignas(64) ContactBatch {
  JointBatch patch;  // without half sizes, sums, joints and corners; frame is that of body a
  Lanes frame_b[4], shift[3], gap[3];
  Lanes reach;                    // m, from the centroid to the farthest point
  std::int32_t tile = 0;          // that of the lower body
  std::int32_t first_corner = 0;  // each lane has memory for most_corners(points)
};
/// Rows of points of a batch for contacts with this number of points, and the largest number of their corners (a
/// polygon of m corners has 2 m + 1 points).
inline std::int32_t point_rows(std::int32_t points) {
  return 1 + 8 * ((points + 6) / 8);
}
inline std::int32_t most_corners(std::int32_t rows) {
  return std::max(4, (rows - 1) / 2);
}

/// A patch between a body and a triangle of the fill's surface, see solver/model/interface.h.
struct InterfacePatch {
  std::int32_t body = 0, cell = 0, face = 0;
  std::int32_t triangle = 0;       // of FillMesh::triangles
  std::int32_t node[3] = {};       // of FillModel
  std::int32_t law = 0;            // index into Model::laws
  double arm[3] = {};              // m, centroid of the body to that of the patch, reference axes
  double frame[4] = {1, 0, 0, 0};  // local axes into the body's reference axes
  double rest[3][3] = {};          // m, n, s, t of each corner of the triangle when it was made
  double kn = 0.0, ks = 0.0;       // Pa/m
  double area = 0.0;               // m2
  double slid[3] = {};             // m, slip of the patches that it has replaced, in the reference axes of the body
  std::vector<PatchPoint> points, corners;
  // While an interface is made from another one: the slot in the old interface (−1: none), and whether the patch was
  // clipped again.
  std::int32_t from = -1;
  bool again = false;
};

/// Consecutive bodies in the order, and the joints whose first body is one of them. Still bodies count only in joints
/// between two still bodies.
struct Tile {
  struct StillSum {
    std::int32_t which = 0;  // of Model::still
    std::int32_t sum = 0;
  };
  std::int32_t first_body = 0, end_body = 0;
  std::int32_t first_joint = 0, end_joint = 0;
  std::int32_t first_batch = 0, end_batch = 0;
  std::int32_t first_sum = 0, end_sum = 0;  // its bodies in order, then still bodies and bodies of later tiles in its
                                            // joints
  std::vector<std::int32_t> followers;      // those later tiles
  std::vector<StillSum> still_sums;         // of the still bodies that its joints touch, in their order
};

/// A cell of one body and a cell of another: bodies in order, then their cells.
using CellPair = std::array<std::int32_t, 4>;
CellPair cells_of(const Patch& patch);

/// Position of a joint of the assembly in Model::joints, at present and when the model was built. Joints exchange
/// positions only with joints of the same tile and shape, so that batches keep their rows of points and corners.
struct JointPlace {
  std::int32_t now = 0, first = 0;
  std::int32_t shape = 0;  // 0: a rectangle; else the number of its corners
};

struct Model {
  std::vector<Body> bodies;
  std::vector<std::int64_t> block_of_body;
  std::vector<std::int32_t> body_of_block;
  std::vector<std::vector<Convex>> cells;  // per body, reference placement

  std::vector<LawConstants> laws;            // the assembly's, then the contact laws of pairs of materials
  std::vector<Patch> joints;                 // the assembly's joints in batch order
  std::vector<std::int64_t> joint_of_patch;  // index in Assembly::joints
  std::vector<JointPlace> joint_places;      // of Assembly::joints
  std::vector<std::pair<CellPair, std::int32_t>> joint_by_cells;  // sorted; index in Assembly::joints
  Array<double> points;   // s, t, weight of the joints' points, eight joints side by side
  Array<double> corners;  // s, t of the joints' corners
  std::size_t point_rows = 0;
  Array<JointBatch> batches;
  Array<Lanes> batch_corners;  // s, t of each corner
  Array<Singles> built;        // of each batch Patch::built, six rows; none where all joints are as drawn
  LineRule rule;               // of rectangles: its tensor product
  std::vector<Tile> tiles;
  std::int32_t tile_bodies = 64;  // each, but for the last: whole batches of bodies
  std::int32_t tile_of(std::int32_t body) const { return body / tile_bodies; }
  std::int32_t tile_of_joint(std::int32_t a, std::int32_t b) const;
  // Bodies whose motion is fully prescribed. Their positions are known in advance, so that no tile waits for them.
  // Guided bodies are not included.
  std::vector<std::int32_t> still;
  std::vector<std::int32_t> still_of;  // of each body: its index in `still`, or −1
  // Sums of each body in the order of addition: first entry of each body (and one past the end), positions of the sums.
  std::vector<std::int32_t> first_sum, sums;

  ConstructionPlan plan;  // empty: the whole structure is present at once
  FillModel fill;
  std::vector<InterfacePatch> interface;  // of the assembly, in the order of its fill_joints

  /// Number of sites of the linear problems: bodies, then nodes of the fill.
  std::size_t sites() const { return bodies.size() + fill.nodes.size(); }

  // Material of a body, for new contacts: Pa, Pa, –.
  struct Matter {
    double youngs = 0.0, shear = 0.0, tan_friction = 0.0;
  };
  std::vector<Matter> matter;             // per body
  std::vector<std::int32_t> contact_law;  // per body: the law of an unbonded contact with its own friction
  /// m, median over the free bodies of volume^(1/3); of an average tetrahedron if only the fill can move.
  double typical_size = 0.0;
  /// Square of the slip past which a patch is clipped again, m2. For small patches it is that of a patch with a quarter
  /// of the size of a block.
  double slip_limit2(double area) const {
    return contact.reclip_slip * contact.reclip_slip * std::max(area, least_slip_area());
  }
  double least_slip_area() const { return 0.0625 * typical_size * typical_size; }
  /// Square of the rotation φ past which a patch is clipped again, measured as |2 sin(φ/2)|.
  double turn_limit2() const { return contact.reclip_angle * contact.reclip_angle; }
  /// N, average over the free bodies (over the tetrahedra if only the fill can move), under the gravity of the case,
  /// or 9.81 m/s2 without gravity.
  double average_weight = 0.0;
  ContactSettings contact;
  Vec3 gravity = Vec3::Zero();  // m/s2, world axes
  Vec3 up = Vec3::Zero();       // unit vector against gravity; zero without gravity
  double bottom = -1e300;       // m, of the assembly as built, along up
};

/// Writes the constants of one patch into its lane.
void fill_lane(const Patch& patch, int lane, JointBatch& batch);
/// The law that the lanes of a batch share, or −1.
std::int32_t common_law(const PatchBatch& batch);
/// Whether any lane of a batch joins a body of Model::still.
bool touches_still(const Model& model, const JointBatch& batch);

/// Builds the model of a finished assembly (blocks, joints, laws all set). Throws InputError if nothing can move (no
/// free block and no fill), a joint has no stiffness, or a tie does not have 4 corners. It also throws the errors of
/// construction_plan(), build_fill(), interface_patches() and of the number of points per side.
Model build_model(const Assembly& assembly, const SolverSettings& settings);

}  // namespace voussoir
