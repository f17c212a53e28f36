#include "solver/step/step_count.h"

#include <fmt/format.h>

namespace voussoir {

namespace {

constexpr double most_steps = 1e11;
constexpr double least_cost = 1e-6;  // s of wall time: a step of two or three blocks
constexpr double day = 86400.0, year = 365.25 * day;

std::string wall_time(double seconds) {
  return seconds > year ? fmt::format("{:.3g} years", seconds / year) : fmt::format("{:.3g} days", seconds / day);
}

}  // namespace

std::string too_many_steps(double time, double dt) {
  const double steps = dt > 0.0 ? time / dt : 0.0;
  if (steps <= most_steps) return "";
  return fmt::format(
      "is {:g} s: {:g} s of simulated time would need {:.2g} time steps, which take at least {} at one microsecond "
      "each. At most {:g} time steps are allowed",
      dt, time, steps, wall_time(least_cost * steps), most_steps);
}

}  // namespace voussoir
