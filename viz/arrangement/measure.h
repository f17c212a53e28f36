// Dimensions of what was built, measured from the stones themselves: spans, rings, supports, levels.
#pragma once
#include <limits>
#include <optional>
#include <string>
#include <utility>
#include <vector>

#include "viz/arrangement/flat_view.h"

namespace voussoir {

constexpr double kNotKnown = std::numeric_limits<double>::quiet_NaN();

/// A vault, in the upright plane along the middle of the assembly. Places are (x, z, 0), m.
struct MeasuredSpan {
  std::int32_t part = 0;                                           // of component arch
  Vec3 left = Vec3::Zero(), right = Vec3::Zero();                  // springings of the intrados
  Vec3 crown = Vec3::Zero();                                       // its corner highest above the line between them
  Polygon intrados;                                                // its corners, from left to right
  double rise = 0.0;                                               // m, of the crown above that line
  double crown_thickness = kNotKnown;                              // m, of all rings, along the joint at the crown
  double left_thickness = kNotKnown, right_thickness = kNotKnown;  // m, at the springings
  double extrados = kNotKnown;                                     // z over the crown
  double deck = kNotKnown;  // z of what lies highest over the crown, without parapets
  double clear() const { return right.x() - left.x(); }
};

/// What stands on a fixed block of a group "base …".
struct MeasuredSupport {
  std::string name;                             // "pier 0"
  double x0 = kNotKnown, x1 = kNotKnown;        // m, at the springing
  double base = 0.0, springing = kNotKnown;     // z: top of the fixed block; the lower springing on it
  double base_x0 = 0.0, base_x1 = 0.0;          // m, of the fixed block
  double thickness() const { return x1 - x0; }  // m
  double height() const { return springing - base; }
};

struct Measures {
  Box moving;                             // m, of all that can move, stones and fill; of all where nothing can
  Box whole;                              // m, with what is fixed
  double middle = 0.0;                    // y of the plane along the middle
  std::pair<double, double> ends;         // x, of all that can move, in that plane
  double skew = 0.0;                      // rad, of the first springing, from y towards x
  std::vector<MeasuredSpan> spans;        // from left to right
  std::vector<MeasuredSupport> supports;  // likewise; one more than spans, or none
  double lowest_base() const;             // z
};

/// The stones of a vault are those of component arch and one part; its intrados is where nothing lies below them.
Measures measure(const Assembly& assembly);

/// Fixed blocks wholly before or behind all that can move, such as the smooth walls of a strip: they would hide an
/// elevation, or stand behind its openings.
std::vector<std::int64_t> fixed_at_faces(const Assembly& assembly, const Measures& measures);

/// Highest z of the pieces of an upright section over a place along it, without parapets and what is fixed; none where
/// there are none.
double top_over(const std::vector<FlatFace>& section, double u);

/// From where to where the pieces of a section reach that are of one component, and of one part unless it is negative.
std::optional<Box> extent_of(const std::vector<FlatFace>& section, Component component, int part = -1);

}  // namespace voussoir
