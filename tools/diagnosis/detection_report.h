// What measurements would show, and what would show more, in words, JSON and on a page.
#pragma once
#include <nlohmann/json.hpp>
#include <string_view>

#include "solver/diagnosis/detectable.h"

namespace voussoir {

/// Null where it is not finite.
nlohmann::json number(double x);
/// "below 0.35 or above 2.1 t/m"; "not within its bounds".
std::string detectable_text(const Detectable& d);
/// Lines for the terminal.
std::string detection_text(const Detection& d);
/// Adds `detectable` and `further`.
void add_detection(const Detection& d, nlohmann::json& j);
/// Two tables in HTML, what they mean before them; empty: nothing was asked.
std::string detection_section(const Detection& d, std::string_view title);

}  // namespace voussoir
