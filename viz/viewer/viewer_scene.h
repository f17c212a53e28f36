// The content of view.html as plain data: stones and the surface of the fill as built, and their motion in each frame.
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

/// Values of a stone from its joints: largest opening and slip since the start (m), largest mean compression and shear
/// stress of a joint at present (Pa).
enum ViewerValue { opening_value, slip_value, compression_value, shear_value };
using ViewerValues = std::array<double, 4>;

/// Forces between two stones at present, over all their joints: normal force (N, compression positive), shear force
/// (N, sum of the magnitudes), largest opening (m).
using ViewerForces = std::array<double, 3>;

struct ViewerFrame {
  std::string label;  // "t = 12.5 s"
  // For each stone, relative to the base: displacement of the centroid (m) and rotation vector (rad).
  std::vector<Vec3> displacement, rotation;
  std::vector<Vec3> fill;            // m, per node of the fill, relative to the base
  std::vector<ViewerValues> values;  // for each stone; empty: none
  std::vector<ViewerForces> forces;  // for each pair; shorter if later frames add pairs
};

struct ViewerScene {
  std::string title, what;                // name of the run; kind of content, in words
  bool modes = false;                     // frames are mode shapes of small displacements (largest: 1) that oscillate
  std::vector<ViewerStone> stones;        // by their block number
  ViewerFill fill;                        // empty: none
  std::vector<std::array<int, 2>> pairs;  // pairs of stones with joints, the lower number first; second −1: the fill
  std::vector<ViewerFrame> frames;
};

}  // namespace voussoir
