// What a rating found: as text, as a table and as JSON.
#pragma once
#include <nlohmann/json.hpp>

#include "tools/rate/rate.h"

namespace voussoir {

/// "span 1 at 0.27", from its left end: where the middle of a vehicle's axles is; "beside the spans".
std::string where_on(const Rating& rating, const Vehicle& vehicle, const VehiclePlace& place);
/// "4.31" or "at least 30".
std::string factor_text(const RatedPlace& at, const RateRequest& request);

/// One line a vehicle, the worst place of each.
std::string rating_text(const Rating& rating, const RateRequest& request);
/// Every place a row.
std::string rating_csv(const Rating& rating, const RateRequest& request);
nlohmann::json rating_json(const Rating& rating, const RateRequest& request);

/// x of the middle of the axles, m, in the axes of the bridge.
double middle_of(const Vehicle& vehicle, const VehiclePlace& place);

}  // namespace voussoir
