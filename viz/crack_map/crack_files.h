// A crack map as files.
#pragma once
#include "viz/crack_map/crack_map.h"

namespace voussoir {

/// Writes STEM.svg, STEM.pdf and STEM.png according to `formats` ("svg", "pdf", "png"). A PDF has a page for each
/// state; for SVG and PNG the second state is in STEM_now. Returns the names. Throws RunError if a file cannot be
/// written.
std::vector<std::string> write_crack_map(const CrackMap& map, const std::vector<CrackState>& states,
                                         const std::vector<std::string>& formats, const std::string& stem);

}  // namespace voussoir
