// What a picture is drawn with: faces, lines and lamps, as actors of a renderer.
#pragma once
#include <vtkPolyData.h>
#include <vtkRenderer.h>

#include "viz/page/palette.h"
#include "viz/view.h"

namespace voussoir {

/// Stones, fill and joints in their active colours: matt, flat-shaded. `ambient` is the share of the light that comes
/// from all sides: the more, the less a face darkens that is turned away from the reader.
void add_faces(vtkRenderer* renderer, vtkPolyData* faces, double ambient = 0.4);

/// Cracks: of one colour, whatever the light.
void add_crack_faces(vtkRenderer* renderer, vtkPolyData* cracks);

/// Lines, `width` pixels wide, moved towards the reader by `lift` (m), so that they lie before the faces they border.
/// The picture of a point does not change: it moves along its own line of sight.
void add_lines(vtkRenderer* renderer, vtkPolyData* lines, double width, const Colour& colour, double lift);

/// The borders of those coloured polygons that the reader sees from their edge, in their colours; `lift` as above.
void add_edge_on(vtkRenderer* renderer, vtkPolyData* faces, const View& view, double lift);

/// A lamp over the reader's left shoulder and a weak one from the right; together they show a face turned to the reader
/// in its own colour, so that the colour scale can be read.
void add_lights(vtkRenderer* renderer, const View& view);

}  // namespace voussoir
