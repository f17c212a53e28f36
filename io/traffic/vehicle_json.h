// Vehicles as JSON, for programs that read what `voussoir vehicles --json` prints.
#pragma once
#include <nlohmann/json.hpp>

#include "io/traffic/vehicle.h"

namespace voussoir {

/// Everything of a vehicle, in N and m; null where a strip has no end.
nlohmann::json vehicle_json(const Vehicle& vehicle);

}  // namespace voussoir
