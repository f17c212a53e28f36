// Named arrows over a picture: what a point of the scene is measured along.
#pragma once
#include <vtkRenderer.h>

#include <string>
#include <vector>

#include "viz/annotation.h"
#include "viz/projection.h"
#include "viz/render.h"

namespace voussoir {

/// Colour of an arrow by the axis it lies along, of Okabe & Ito (2008): x blue, y vermilion, z green; ink for others.
Colour arrow_colour(const Vec3& direction);

/// A shaft with a head, from `from` and `length` pixels along a unit vector on the sheet; `s` is the letters' height,
/// which its width goes by.
void draw_shaft(Overlay& overlay, const Spot& from, const Spot& along, double length, double s, const Colour& colour);

/// Height in pixels above the content that keeps arrows and their names off the strip above it.
double arrow_strip(const Sheet& sheet);

/// Draws them all equally long on the sheet, so that none is hidden or too small to read; one that points at the
/// reader, or away, is a ring with a dot, or a cross. Names stand at the tips, moved aside where they would cover one
/// another, then with a line to their arrow. What the colours mean stands in the strip above the picture, on the right.
void draw_arrows(Overlay& overlay, vtkRenderer* renderer, const Sheet& sheet, const View& view,
                 const std::vector<Arrow>& arrows);

}  // namespace voussoir
