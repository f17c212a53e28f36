// Resultants of bed joints as arrows over a picture, and the lines of thrust through them.
#pragma once
#include <vtkRenderer.h>

#include <vector>

#include "solver/statics/bed_joints.h"
#include "viz/annotation.h"

namespace voussoir {

/// Height in pixels above the content that their key takes, below the strip above it.
double resultants_strip(const Sheet& sheet);

/// What the left side of each joint puts on the right, as the view sees it in space: an arrow whose length is the
/// force, with its middle where the force goes through the joint; through these places a line along each ring. The
/// largest arrow is about as long as joints lie apart; where they lie closer than can be drawn, not every one has an
/// arrow. What an arrow means stands above the picture, on the right. Joints without compression have none, and the
/// line breaks there.
void draw_resultants(Overlay& overlay, vtkRenderer* renderer, const Sheet& sheet, const View& view,
                     const std::vector<BedJoint>& beds);

}  // namespace voussoir
