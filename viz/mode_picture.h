// Pictures of vibration modes: the shape over the outline of what is at rest.
#pragma once
#include "solver/modal/modes.h"
#include "viz/render.h"

namespace voussoir {

/// Draws a mode with its largest displacement as long as `share` of the assembly's diagonal. Title, size, view and
/// hidden components are those of the options; `notes` are two lines beside the scale. Throws as render_picture().
void draw_mode(const Assembly& assembly, const Mode& mode, RenderOptions options,
               const std::array<std::string, 2>& notes, const std::string& png, double share = 0.04);

}  // namespace voussoir
