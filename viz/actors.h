// The parts of a picture: faces, lines and lights of a renderer.
#pragma once
#include <vtkPolyData.h>
#include <vtkRenderer.h>

#include "viz/page/palette.h"
#include "viz/view.h"

namespace voussoir {

/// Stones, fill and joints in their active colours, matt and flat-shaded. `ambient` is the share of light from all
/// sides: the larger it is, the less faces darken that are turned away from the reader.
void add_faces(vtkRenderer* renderer, vtkPolyData* faces, double ambient = 0.4);

/// Cracks in one colour that does not depend on the light.
void add_crack_faces(vtkRenderer* renderer, vtkPolyData* cracks);

/// Lines, `width` pixels wide, moved towards the reader by `lift` (m), so that they are in front of the faces they
/// border. Each point moves along its own line of sight, so its position in the picture does not change.
void add_lines(vtkRenderer* renderer, vtkPolyData* lines, double width, const Colour& colour, double lift);

/// The borders of the coloured polygons that the reader sees edge-on, in their colours; `lift` as above.
void add_edge_on(vtkRenderer* renderer, vtkPolyData* faces, const View& view, double lift);

/// Adds a light from above on the left side of the reader, and a weak one from the right. Together they show a face
/// turned to the reader in its own colour, so that the colour scale can be read.
void add_lights(vtkRenderer* renderer, const View& view);

}  // namespace voussoir
