// The section of a run's page on the thrust in the rings of its vaults.
#pragma once
#include <string>

namespace voussoir {

/// Made from joints.csv of a run directory: a table of the largest values of each ring, the lines of thrust, and charts
/// of normal force, eccentricity and utilisation along the rings. Empty without the file. Without lines of thrust if an
/// earlier version wrote the file without the axes of the joints. As HTML. Throws InputError for a damaged file.
std::string stress_section(const std::string& directory);

}  // namespace voussoir
