// The general arrangement drawing as files.
#pragma once
#include <string>

#include "viz/arrangement/arrangement.h"

namespace voussoir {

/// Writes STEM.svg, STEM.pdf and STEM.png, the same drawing each; SVG and PDF are printed true to scale. Throws
/// InputError when there is nothing to draw, RunError when a file cannot be written.
void write_arrangement(const Assembly& assembly, const ArrangementNotes& notes, const std::string& stem);

}  // namespace voussoir
