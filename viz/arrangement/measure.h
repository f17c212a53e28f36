// Dimensions of the assembly as built, measured from the stones: spans, rings, supports, levels. Coordinates (x, y, z)
// are in m.
#pragma once
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viz/arrangement/flat_view.h"

namespace voussoir {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// A vault in the vertical plane along the middle of the assembly. Points are (x, z, 0), m.
struct MeasuredSpan {
  std::int32_t part = 0;                           // of component arch
  Vec3 left = Vec3::Zero(), right = Vec3::Zero();  // springings of the intrados
  Vec3 crown = Vec3::Zero();                       // corner of the intrados with the largest distance above the
                                                   // line between the springings
  Polygon intrados;                                // its corners, from left to right
  double rise = 0.0;                               // m, height of the crown above that line
  double crown_thickness = kNotKnown;              // m, of all rings, along the joint at the crown
  double left_thickness = kNotKnown, right_thickness = kNotKnown;  // m, at the springings
  double extrados = kNotKnown;                                     // z of the extrados at the crown
  double deck = kNotKnown;  // z of the highest point above the crown, without parapets
  double clear() const { return right.x() - left.x(); }
};

/// A support: the stones on a fixed block of a group "base …".
struct MeasuredSupport {
  std::string name;                             // "pier 0"
  double x0 = kNotKnown, x1 = kNotKnown;        // m, at the springing
  double base = 0.0, springing = kNotKnown;     // z: top of the fixed block; the lower springing on it
  double base_x0 = 0.0, base_x1 = 0.0;          // m, of the fixed block
  double thickness() const { return x1 - x0; }  // m
  double height() const { return springing - base; }
};

struct Measures {
  Box moving;                             // m, box of all movable stones and fill; of everything if nothing can move
  Box whole;                              // m, box of everything, including fixed blocks
  double middle = 0.0;                    // y of the plane along the middle
  std::pair<double, double> ends;         // x, range of all movable stones in that plane
  double skew = 0.0;                      // rad, of the first springing, from y towards x
  std::vector<MeasuredSpan> spans;        // from left to right
  std::vector<MeasuredSupport> supports;  // likewise; one more than spans, or none
  double lowest_base() const;             // z
};

/// Measures the assembly. The stones of a vault have component arch and the same part. Its intrados consists of the
/// faces with nothing below them.
Measures measure(const Assembly& assembly);

/// Fixed blocks that are completely in front of or behind all movable stones, such as the smooth walls of a strip.
/// They would hide an elevation or appear behind its openings.
std::vector<std::int64_t> fixed_at_faces(const Assembly& assembly, const Measures& measures);

/// Largest z of the pieces of a vertical section at a position along it, without parapets and fixed blocks; none if
/// there are no pieces.
double top_over(const std::vector<FlatFace>& section, double u);

/// The range of the pieces of a section with one component, and with one part unless it is negative.
std::optional<Box> extent_of(const std::vector<FlatFace>& section, Component component, int part = -1);

}  // namespace voussoir
