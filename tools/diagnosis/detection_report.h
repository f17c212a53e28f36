// The report on detectable effects: least amounts and useful further measurements, as text, JSON and HTML.
#pragma once
#include <nlohmann/json.hpp>
#include <string_view>

#include "solver/diagnosis/detectable.h"

namespace voussoir {

/// The number, or null if it is not finite.
nlohmann::json number(double x);
/// "below 0.35 or above 2.1 t/m" or "no amount within its bounds", after the name of the parameter.
std::string detectable_text(const Detectable& d);
/// The report as lines for the terminal.
std::string detection_text(const Detection& d);
/// Adds `detectable` and `further`.
void add_detection(const Detection& d, nlohmann::json& j);
/// Two tables in HTML with an explanation before them. Empty if there are no least amounts.
std::string detection_section(const Detection& d, std::string_view title);

}  // namespace voussoir
