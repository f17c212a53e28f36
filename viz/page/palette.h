// Colours of pictures and charts: readable in grey print and by colour-blind readers.
#pragma once
#include <array>
#include <string>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

using Colour = std::array<double, 3>;  // red, green, blue, 0…1

constexpr std::size_t kLineColours = 8;
/// The eight colours of Okabe & Ito (2008), for lines; indices beyond the last begin again.
Colour line_colour(std::size_t index);

/// Light, warm colour of the stones of a component.
Colour component_colour(Component component);
constexpr Colour kStone = {0.91, 0.875, 0.80};   // undamaged stone
constexpr Colour kFixed = {0.78, 0.78, 0.78};    // stones that move with the ground
constexpr Colour kInk = {0.12, 0.12, 0.14};      // text
constexpr Colour kOutline = {0.22, 0.20, 0.18};  // edges of stones
constexpr Colour kFaint = {0.55, 0.68, 0.85};    // earlier or undeformed state
constexpr Colour kAside = {0.90, 0.90, 0.91};    // stones next to a coloured fill
constexpr Colour kElastic = {0.91, 0.875, 0.80};
constexpr Colour kYielded = {0.60, 0.78, 0.92};  // yielded, derived from Okabe & Ito (2008)
constexpr Colour kYieldsInShear = {0.835, 0.369, 0.0};
constexpr Colour kYieldsInTension = {0.0, 0.32, 0.55};
constexpr Colour kCrack = {0.80, 0.08, 0.08};

/// Colour of a share 0…1 of the scale: from undamaged stone into viridis (van der Walt & Smith 2015) from its light to
/// its dark end, so that the lightness decreases steadily with the value.
Colour scale_colour(double share);

/// Colour of a share 0…1 of a scale for values of the opposite sign: from stone through the vermilion of Okabe & Ito
/// (2008) to its shade. It is clearly different from all colours of scale_colour().
Colour other_side_colour(double share);

}  // namespace voussoir
