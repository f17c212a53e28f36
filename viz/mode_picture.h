// Pictures of vibration modes: the mode shape over the undeformed outline.
#pragma once
#include "solver/modal/modes.h"
#include "viz/render.h"

namespace voussoir {

/// Draws a mode with its largest displacement equal to `share` of the diagonal of the assembly. Title, size, view and
/// hidden components are those of the options. `notes` are two lines next to the scale. Throws like render_picture().
void draw_mode(const Assembly& assembly, const Mode& mode, RenderOptions options,
               const std::array<std::string, 2>& notes, const std::string& png, double share = 0.04);

}  // namespace voussoir
