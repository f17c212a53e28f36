// Even steps behind times that a logger has rounded. Private to io/measured.
#pragma once
#include <optional>
#include <string_view>
#include <vector>

namespace voussoir {

/// Digits behind the decimal point of a number as it is written; none for one with an exponent.
std::optional<int> decimals_of(std::string_view word);

/// The step of an even grid from which every time differs by no more than `half` (s), half of the last digit that is
/// written. Of all such steps that of a whole number of samples a second, when there is one; else the one that the
/// times fit best. None when no grid fits.
std::optional<double> grid_step(const std::vector<double>& times, double half);

}  // namespace voussoir
