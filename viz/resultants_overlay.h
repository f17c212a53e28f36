// Resultants of bed joints as arrows over a picture, and the thrust lines through them.
#pragma once
#include <vtkRenderer.h>

#include <vector>

#include "solver/statics/bed_joints.h"
#include "viz/annotation.h"

namespace voussoir {

/// Height in pixels of their key above the content, below the strip above it.
double resultants_strip(const Sheet& sheet);

/// The force that the left side of each joint exerts on the right side, in the projection of the view: an arrow whose
/// length is the force, with its middle at the point where the force crosses the joint. A line along each ring goes
/// through these points. The largest arrow is about as long as the distance between joints. Where joints are too
/// close, only some have an arrow. The key of the arrows is above the picture, on the right. Joints without
/// compression have no arrow, and the line is interrupted there.
void draw_resultants(Overlay& overlay, vtkRenderer* renderer, const Sheet& sheet, const View& view,
                     const std::vector<BedJoint>& beds);

}  // namespace voussoir
