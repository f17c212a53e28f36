// A crack map as files.
#pragma once
#include "viz/crack_map/crack_map.h"

namespace voussoir {

/// Writes STEM.svg, STEM.pdf and STEM.png as `formats` ("svg", "pdf", "png") ask; a PDF has a page for each state, of
/// SVG and PNG the second is STEM_now. Returns the names. Throws RunError when a file cannot be written.
std::vector<std::string> write_crack_map(const CrackMap& map, const std::vector<CrackState>& states,
                                         const std::vector<std::string>& formats, const std::string& stem);

}  // namespace voussoir
