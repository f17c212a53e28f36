// What view.html shows, as plain data: stones and the surface of the fill as built, and how they move in each frame.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "geometry/polyhedron.h"

namespace voussoir {

struct ViewerStone {
  int component = 0, part = 0;  // index into component_names(); see Block
  bool fixed = false;
  Vec3 centre = Vec3::Zero();           // m, centroid as built
  std::vector<Vec3> corners;            // m, as built
  std::vector<std::vector<int>> faces;  // convex loops of corners, counter-clockwise seen from outside
};

/// The surface of a deformable fill as built.
struct ViewerFill {
  std::vector<Vec3> nodes;  // m
  std::vector<std::array<int, 3>> triangles;
};

/// What a stone shows of its joints: largest opening and slip since the start (m), largest mean compression and shear
/// of a joint at present (Pa).
enum ViewerValue { opening_value, slip_value, compression_value, shear_value };
using ViewerValues = std::array<double, 4>;

/// What two stones bear between them at present, all their joints together: normal force (N, compression positive),
/// shear force (N, sum of the joints' magnitudes), largest opening (m).
using ViewerForces = std::array<double, 3>;

struct ViewerFrame {
  std::string label;  // "t = 12.5 s"
  std::vector<Vec3> displacement,
      rotation;                      // per stone, relative to the base: m, of the centroid; rotation vector, rad
  std::vector<Vec3> fill;            // m, per node of the fill, relative to the base
  std::vector<ViewerValues> values;  // per stone; empty: none
  std::vector<ViewerForces> forces;  // per pair; shorter where later frames bring new pairs
};

struct ViewerScene {
  std::string title, what;                // name of the run; what kind of thing, in words
  bool modes = false;                     // frames are shapes of small displacements, the largest 1, that swing
  std::vector<ViewerStone> stones;        // by their block number
  ViewerFill fill;                        // empty: none
  std::vector<std::array<int, 2>> pairs;  // stones with joints between them, the lower first; second −1: the fill
  std::vector<ViewerFrame> frames;
};

}  // namespace voussoir
