// How the stones and the fill of a picture are coloured, and the scale or legend that explains it.
#pragma once
#include <vtkPolyData.h>

#include <functional>
#include <string>
#include <vector>

#include "geometry/assembly.h"
#include "viz/page/palette.h"

namespace voussoir {

/// A colour scale, or a legend.
struct Colouring {
  std::string title = {};  // of the scale: "largest joint opening (mm)"; empty: no scale
  double top = 0.0;        // upper end of the scale, in the title's unit
  double bottom = 0.0;     // its lower end, 0 or below
  bool exceeded = false;   // some values lie above it
  std::vector<std::pair<std::string, Colour>> legend = {};
};

/// Of a value on the scale.
Colour colour_on_scale(const Colouring& colouring, double value);
/// How many parts give a scale from 0 to `top` round numbers.
int scale_steps(double top);

/// A round top of the scale: `range`, or where that is 0 one from the values. A few of them far beyond all others do
/// not set it: then it is cut at the 98th percentile of those above zero.
void set_top(Colouring& colouring, std::vector<double> values, double range);
/// Every face in the colour that `colour` gives for its number, as active scalars ("colour"); no faces: nothing.
void paint_faces(vtkPolyData* faces, const std::function<Colour(vtkIdType)>& colour);

/// Whether it is the fill that is coloured by this word, and the stones are all alike.
bool colours_fill(const std::string& by);

/// Adds the colours to the faces as active scalars ("colour") and returns what explains them. `by` is opening, slip,
/// displacement, mode, component or stone (all alike), or of the fill plastic, yield or stress (largest compression);
/// `range` is the top of the scale, mm, % or kPa, 0 for one from the data. `fill` may be null. Fixed stones are grey.
/// Throws InputError for another word, and for one of the fill without a fill.
Colouring colour_faces(vtkPolyData* stones, vtkPolyData* fill, const std::string& by, double range);

}  // namespace voussoir
