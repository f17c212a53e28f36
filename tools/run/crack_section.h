// The section of a run's page on cracks: the map, the widest cracks, and what they mean for a bridge.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace voussoir {

/// From DIRECTORY/images/crack_map.svg, DIRECTORY/cracks.csv and `bridge_damage` of the run's summary; what is missing
/// is left out, and empty when all is.
std::string crack_section(const std::string& directory, const nlohmann::json& summary);

}  // namespace voussoir
