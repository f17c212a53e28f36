// The section on cracks of a run's page: the map, the widest cracks, and the damage class of the bridge.
#pragma once
#include <nlohmann/json.hpp>
#include <string>

namespace voussoir {

/// Made from DIRECTORY/images/crack_map.svg, DIRECTORY/cracks.csv and `bridge_damage` of the run's summary. A part
/// whose source is missing is left out; empty if all are missing. As HTML.
std::string crack_section(const std::string& directory, const nlohmann::json& summary);

}  // namespace voussoir
