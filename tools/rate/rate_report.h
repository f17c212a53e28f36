// The results of a rating as text, table and JSON.
#pragma once
#include <nlohmann/json.hpp>

#include "tools/rate/rate.h"

namespace voussoir {

/// Position of the middle of the axles of a vehicle: "span 1 at 0.27" (share of the span from its left end) or
/// "outside the spans".
std::string where_on(const Rating& rating, const Vehicle& vehicle, const VehiclePlace& place);
/// "4.31" or "at least 30".
std::string factor_text(const RatedPlace& at, const RateRequest& request);

/// What is missing in a rating that was stopped; empty for a complete one.
std::string missing_text(const Rating& rating);

/// One line for each vehicle with its worst place, then missing_text().
std::string rating_text(const Rating& rating, const RateRequest& request);
/// One row for each place.
std::string rating_csv(const Rating& rating, const RateRequest& request);
nlohmann::json rating_json(const Rating& rating, const RateRequest& request);

/// x of the middle of the axles, m, in the axes of the bridge.
double middle_of(const Vehicle& vehicle, const VehiclePlace& place);

}  // namespace voussoir
