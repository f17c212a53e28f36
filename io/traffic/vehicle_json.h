// Vehicles as JSON, for `voussoir vehicles --json`.
#pragma once
#include <nlohmann/json.hpp>

#include "io/traffic/vehicle.h"

namespace voussoir {

/// All data of a vehicle, in N and m; null for a strip without end.
nlohmann::json vehicle_json(const Vehicle& vehicle);

}  // namespace voussoir
