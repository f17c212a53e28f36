// How the stones and the fill of a picture are coloured, and the scale or legend that explains it.
#pragma once
#include <vtkPolyData.h>

#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "viz/page/palette.h"

namespace voussoir {

/// A colour scale, or a legend.
struct Colouring {
  std::string title;      // of the scale: "largest joint opening (mm)"; empty: no scale
  double top = 0.0;       // upper end of the scale, in the title's unit
  bool exceeded = false;  // some values lie above it
  std::vector<std::pair<std::string, Colour>> legend;
};

/// Whether it is the fill that is coloured by this word, and the stones are all alike.
bool colours_fill(const std::string& by);

/// Adds the colours to the faces as active scalars ("colour") and returns what explains them. `by` is opening, slip,
/// displacement, mode, component or stone (all alike), or of the fill plastic or yield; `range` is the top of the
/// scale, mm or %, 0 for one from the data. `fill` may be null. Fixed stones are grey. Throws InputError for another
/// word, and for one of the fill without a fill.
Colouring colour_faces(vtkPolyData* stones, vtkPolyData* fill, const std::string& by, double range);

}  // namespace voussoir
