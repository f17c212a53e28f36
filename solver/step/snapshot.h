// The state of a run at one instant, in the form for files and pictures. The solver makes it, io writes it and viz
// draws it.
#pragma once
#include <Eigen/Geometry>
#include <array>
#include <cstdint>
#include <vector>

#include "geometry/polyhedron.h"

namespace voussoir {

/// One patch: polygon and tractions at present. Patches 0 … joints−1 are the assembly's joints in their order; contacts
/// found during the run follow.
struct PatchSnapshot {
  std::int64_t a = 0, b = 0;   // blocks
  Polygon polygon;             // m, present position (midway between the two blocks' faces)
  Vec3 normal = Vec3::Zero();  // unit, present, from a to b
  double area = 0.0;           // m2
  // m, largest over the patch's points now (opening >= 0, of joints; slip is plastic).
  double opening = 0.0, slip = 0.0;
  double largest_opening = 0.0, largest_slip = 0.0;    // m, since the start
  double normal_traction = 0.0, shear_traction = 0.0;  // Pa, mean over the patch; tension positive
  // Eccentricity of the resultant of the normal tractions, as a share of the depth (geometry/kern.h); 0 without
  // compression. Utilisation: shear over shear_capacity(); 0 without shear, 1 without capacity.
  double eccentricity = 0.0, utilisation = 0.0;
  double bonded = 1.0;    // bonded share of the area (0 for joints that never had a bond)
  bool had_bond = false;  // the joint started with tensile strength or cohesion, or is elastic
  bool tie = false;       // a bar, drawn as its strip from anchor to anchor; it does not open or slip
  double yielded = 0.0, largest_tension = 0.0;  // of a tie: plastic stretch (m); Pa, since the start
  bool replaced =
      false;  // a joint that has slid or turned so far that a contact took its place, if the blocks still meet
};

/// A tetrahedron of the fill at present.
struct TetSnapshot {
  std::array<double, 6> stress = {};  // Pa, Cauchy: xx, yy, zz, xy, yz, xz; tension positive; without Maxwell branches
  double plastic_shear = 0.0;         // Σ √(⅔ Δe : Δe) of the plastic deviators so far
  double plastic_volume = 0.0;        // plastic volumetric strain: dilation and opening in tension
  std::uint8_t yield = 0;             // TetYield bits (solver/model/fill_memory.h)
};

/// The deformable fill, in the order of FillMesh; empty without one.
struct FillSnapshot {
  std::vector<Vec3> displacement;  // m, of each node since the reference placement
  std::vector<Vec3> velocity;      // m/s, of each node at the last half step, including that of the ground
  std::vector<TetSnapshot> tets;
  bool empty() const { return tets.empty(); }
};

struct Snapshot {
  double time = 0.0;                         // s since the start of the run
  Vec3 base_displacement = Vec3::Zero();     // m
  std::vector<Vec3> displacement;            // m, of the centroid of each block since the reference placement
  std::vector<Eigen::Quaterniond> rotation;  // since the reference placement
  std::vector<Vec3> velocity;  // m/s, of each centroid at the last half step, including that of the ground
  std::vector<PatchSnapshot> patches;
  FillSnapshot fill;
};

}  // namespace voussoir
