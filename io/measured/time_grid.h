// Finds equal time steps in times that a logger has rounded. Private to io/measured.
#pragma once
#include <optional>
#include <string_view>
#include <vector>

namespace voussoir {

/// Number of digits after the decimal point of a number in a text; empty for a number with an exponent.
std::optional<int> decimals_of(std::string_view word);

/// The time step (s) of the uniform grid from which every time differs by at most `half` (s), half of the last written
/// digit. If several time steps fit, one with a whole number of samples per second is used, otherwise the one with the
/// best fit. Empty if no time step fits.
std::optional<double> grid_step(const std::vector<double>& times, double half);

}  // namespace voussoir
