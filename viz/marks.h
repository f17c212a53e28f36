// Marks over a picture, visible through everything in front of them: numbered places and ties.
#pragma once
#include <vtkPolyData.h>
#include <vtkRenderer.h>

#include <string>
#include <utility>
#include <vector>

#include "viz/annotation.h"
#include "viz/render.h"

namespace voussoir {

/// A disc with its name at each place.
void draw_marks(Overlay& overlay, vtkRenderer* renderer, const Sheet& sheet, const std::vector<Mark>& marks);

/// The ties among stored joints, from anchor to anchor, displaced like the stones. Yielded ties have another colour.
/// Nothing if the frame does not say which joints are ties.
void draw_ties(Overlay& overlay, vtkRenderer* renderer, const Sheet& sheet, vtkPolyData* joints, double amplification);
/// Legend of the colours of the ties, for the strip above the picture.
std::vector<std::pair<std::string, Colour>> words_of_ties(vtkPolyData* joints);

}  // namespace voussoir
