// Named arrows over a picture: the directions in which something is measured at a point.
#pragma once
#include <vtkRenderer.h>

#include <string>
#include <vector>

#include "viz/annotation.h"
#include "viz/projection.h"
#include "viz/render.h"

namespace voussoir {

/// Colour of an arrow by its axis, from Okabe & Ito (2008): x blue, y vermilion, z green; ink for other directions.
Colour arrow_colour(const Vec3& direction);

/// An arrow from `from`, `length` pixels long along a unit vector on the sheet. `s` is the height of letters, which
/// determines its width.
void draw_shaft(Overlay& overlay, const Spot& from, const Spot& along, double length, double s, const Colour& colour);

/// Height in pixels above the content that separates arrows and their names from the strip above it.
double arrow_strip(const Sheet& sheet);

/// Draws all arrows with the same length on the sheet, so that none is hidden or too small to read. An arrow towards
/// the reader is a ring with a dot, and one away from the reader a ring with a cross. Names are at the tips; they are
/// moved aside if they would overlap, with a line to their arrow. The legend of the colours is in the strip above the
/// picture, on the right.
void draw_arrows(Overlay& overlay, vtkRenderer* renderer, const Sheet& sheet, const View& view,
                 const std::vector<Arrow>& arrows);

}  // namespace voussoir
