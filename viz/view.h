// The view of a picture, and how its content is fitted to the sheet.
#pragma once
#include <vtkCamera.h>
#include <vtkPoints.h>

#include <string>
#include <vector>

#include "geometry/polyhedron.h"

namespace voussoir {

/// A viewing direction. Bridges extend along x; y is transverse and z is up.
struct View {
  std::string name;
  Vec3 forward, up, right;   // unit, orthogonal
  bool perspective = false;  // orthographic otherwise
};
/// front (looking along y), side (from the end, looking along −x), plan (from above), oblique.
/// Throws InputError listing the known names when there is none of that name.
View find_view(const std::string& name);

/// The part of the sheet for the content, in shares of width and height.
struct Frame {
  double left = 0.0, right = 1.0, bottom = 0.0, top = 1.0;
};

/// Width divided by height of the content in the view (orthographic projection of the points).
double content_aspect(const View& view, vtkPoints* points);

/// Sets the camera so that all points fit into the frame, centred in it. `aspect` is width divided by height of the
/// sheet.
void fit_camera(vtkCamera* camera, const View& view, vtkPoints* points, const Frame& frame, double aspect);

}  // namespace voussoir
