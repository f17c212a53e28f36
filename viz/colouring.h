// How the stones of a picture are coloured, and the scale or legend that explains it.
#pragma once
#include <vtkPolyData.h>

#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "viz/palette.h"

namespace voussoir {

/// A colour scale in mm, or a legend of components.
struct Colouring {
  std::string title;                  // of the scale: "largest joint opening (mm)"; empty: no scale
  double top_mm = 0.0;                // upper end of the scale
  bool exceeded = false;              // some values lie above it
  std::vector<Component> components;  // of the legend
};

/// Adds the colours to the faces as active scalars ("colour") and returns what explains them. `by` is opening, slip,
/// displacement, mode, component or stone (all alike); `range_mm` is the top of the scale, 0 for one from the data.
/// Fixed stones are grey. Throws InputError for another word.
Colouring colour_faces(vtkPolyData* faces, const std::string& by, double range_mm);

}  // namespace voussoir
