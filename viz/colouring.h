// Colouring of the stones and the fill of a picture, and the scale or legend that explains it.
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
  std::string title = {};  // title of the scale: "largest joint opening, mm"; empty: no scale
  double top = 0.0;        // upper end of the scale, in the unit of the title
  double bottom = 0.0;     // its lower end, 0 or below
  bool exceeded = false;   // some values are above it
  std::vector<std::pair<std::string, Colour>> legend = {};
};

/// Colour of a value on the scale.
Colour colour_on_scale(const Colouring& colouring, double value);
/// Number of parts of a scale from 0 to `top` with round numbers.
int scale_steps(double top);

/// Sets the upper end of the scale: `range` or, if that is 0, a round number not below the values (1 if all are below
/// 1e-6). If the largest value is more than three times the 98th percentile of the positive values, the scale ends at
/// that percentile.
void set_top(Colouring& colouring, std::vector<double> values, double range);
/// The faces with the colour that `colour` gives for their number, as active scalars ("colour"). Nothing if there are
/// no faces.
void paint_faces(vtkPolyData* faces, const std::function<Colour(vtkIdType)>& colour);

/// Whether this word colours the fill, with all stones in one colour.
bool colours_fill(const std::string& by);

/// Adds the colours to the faces as active scalars ("colour") and returns their scale or legend. `by` is opening,
/// slip, displacement, mode, component or stone (one colour), or for the fill plastic, yield or stress (largest
/// compression). `range` is the upper end of the scale, mm, % or kPa, 0 for one from the data. `fill` may be null.
/// Fixed stones are grey. Throws InputError for another word, and for a word of the fill without a fill.
Colouring colour_faces(vtkPolyData* stones, vtkPolyData* fill, const std::string& by, double range);

}  // namespace voussoir
