// Mathematical and physical constants.
#pragma once
#include <numbers>

namespace voussoir {

constexpr double pi = std::numbers::pi, two_pi = 2.0 * pi;
constexpr double standard_gravity = 9.80665;  // m/s2, unit of records in g

constexpr double radians(double degrees) {
  return degrees * pi / 180.0;
}

}  // namespace voussoir
