// The general arrangement drawing as files.
#pragma once
#include <string>

#include "viz/arrangement/arrangement.h"

namespace voussoir {

/// Writes STEM.svg, and the same drawing as STEM.png, which takes longer and needs what viz/display.h says. Throws
/// RunError when a file cannot be written, InputError when there is no display to draw the PNG on; the SVG is there
/// then.
void write_arrangement(const Assembly& assembly, const ArrangementNotes& notes, const std::string& stem);

}  // namespace voussoir
