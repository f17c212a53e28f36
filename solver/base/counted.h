// Counts in words for messages and pages.
#pragma once
#include <fmt/format.h>

#include <concepts>
#include <string>
#include <string_view>

namespace voussoir {

/// A number and what it counts: "1 joint", "2 joints". `many` is the plural where it is not `one` with an s.
template <std::integral Count>
std::string counted(Count n, std::string_view one, std::string_view many = {}) {
  if (n == 1) return fmt::format("{} {}", n, one);
  return many.empty() ? fmt::format("{} {}s", n, one) : fmt::format("{} {}", n, many);
}

}  // namespace voussoir
