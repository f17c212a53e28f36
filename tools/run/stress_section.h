// What the rings of a run's vaults bear, for its page.
#pragma once
#include <string>

namespace voussoir {

/// From joints.csv of a run directory: a table of the most of each ring, the lines of thrust, and charts of normal
/// force, eccentricity and utilisation along the rings. Empty without the file; without lines of thrust where it was
/// written before it had the axes of the joints. As HTML. Throws InputError for a damaged file.
std::string stress_section(const std::string& directory);

}  // namespace voussoir
