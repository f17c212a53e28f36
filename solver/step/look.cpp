#include "solver/step/look.h"

namespace voussoir {

namespace {

constexpr std::int64_t most_unseen = 16;  // steps

/// Steps in which no body comes as far as `distance` (m), even if the fastest doubles its speed, and falls.
std::int64_t steps_within(double distance, double fastest, double dt) {
  constexpr double faster = 2.0, falling = 10.0;  // m/s2
  std::int64_t steps = most_unseen;
  while (steps > 1 && !(double(steps) * (faster * fastest + falling * double(steps) * dt * dt) <= distance)) --steps;
  return steps;
}

}  // namespace

Look look(const BodyReport& bodies, std::int64_t step, double distance, double dt) {
  constexpr double early = 0.25;        // of the distance
  constexpr std::int64_t short_of = 8;  // steps: as many as a round may have
  const std::int64_t left = steps_within(distance - bodies.farthest, bodies.fastest, dt);
  const bool hovers = left < short_of && steps_within(early * distance, bodies.fastest, dt) >= short_of;
  // Where a round ends anyway, if there is one before: a look elsewhere cuts one short.
  const std::int64_t last = step + left, whole = last - last % short_of;
  return {bodies.farthest > distance || hovers, whole > step ? whole : last};
}

}  // namespace voussoir
