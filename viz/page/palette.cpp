#include "viz/page/palette.h"

#include <algorithm>
#include <cmath>

namespace voussoir {
namespace {

Colour mixture(const Colour& a, const Colour& b, double share_of_b) {
  Colour mixed;
  for (int c = 0; c < 3; ++c) mixed[c] = (1 - share_of_b) * a[c] + share_of_b * b[c];
  return mixed;
}

}  // namespace

Colour line_colour(std::size_t index) {
  static constexpr std::array<Colour, kLineColours> colours = {
      {{0.000, 0.447, 0.698},    // blue
       {0.835, 0.369, 0.000},    // vermilion
       {0.000, 0.620, 0.451},    // bluish green
       {0.800, 0.475, 0.655},    // reddish purple
       {0.902, 0.624, 0.000},    // orange
       {0.337, 0.706, 0.914},    // sky blue
       {0.000, 0.000, 0.000},    // black
       {0.700, 0.650, 0.100}}};  // yellow, darkened for white paper
  return colours[index % colours.size()];
}

Colour component_colour(Component component) {
  switch (component) {
    case Component::arch:
      return {0.87, 0.70, 0.52};
    case Component::pier:
      return {0.83, 0.78, 0.68};
    case Component::abutment:
      return {0.74, 0.71, 0.64};
    case Component::infill:
      return {0.80, 0.74, 0.74};
    case Component::backing:
      return {0.72, 0.66, 0.58};
    case Component::spandrel:
      return {0.93, 0.88, 0.74};
    case Component::parapet:
      return {0.86, 0.86, 0.78};
    case Component::backfill:
      return {0.66, 0.60, 0.48};
    case Component::base:
      return kFixed;
    case Component::restraint:
      return {0.66, 0.69, 0.73};
    case Component::wall:
      return {0.88, 0.80, 0.66};
    case Component::block:
      return kStone;
  }
  return kStone;
}

Colour other_side_colour(double share) {
  constexpr Colour vermilion = {0.835, 0.369, 0.0}, shade = {0.42, 0.10, 0.0};
  share = std::clamp(share, 0.0, 1.0);
  return share < 0.5 ? mixture(kStone, vermilion, 2.0 * share) : mixture(vermilion, shade, 2.0 * share - 1.0);
}

Colour scale_colour(double share) {
  static constexpr std::array<Colour, 11> viridis = {{{0.993, 0.906, 0.144},
                                                      {0.741, 0.873, 0.150},
                                                      {0.478, 0.821, 0.318},
                                                      {0.267, 0.749, 0.441},
                                                      {0.135, 0.659, 0.518},
                                                      {0.128, 0.567, 0.551},
                                                      {0.164, 0.471, 0.558},
                                                      {0.207, 0.372, 0.553},
                                                      {0.254, 0.265, 0.530},
                                                      {0.283, 0.141, 0.458},
                                                      {0.267, 0.005, 0.329}}};
  constexpr double kJoin = 0.12;  // below this share the colour passes from stone into the scale, without its bright
                                  // yellow end
  share = std::clamp(share, 0.0, 1.0);
  if (share < kJoin) return mixture(kStone, scale_colour(kJoin), share / kJoin);
  const double place = share * (viridis.size() - 1);
  const auto low = std::min<std::size_t>(std::size_t(place), viridis.size() - 2);
  const double t = place - double(low);
  return mixture(viridis[low], viridis[low + 1], t);
}

}  // namespace voussoir
