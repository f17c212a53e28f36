// Largest number of time steps of a run.
#pragma once
#include <string>

namespace voussoir {

/// Message if `time` s of simulated time need too many time steps of `dt` s, with their number and the least wall-clock
/// time. It begins with "is … s"; the caller writes the name of the key before it. Empty if the number is acceptable,
/// or if `dt` is not yet known (0).
std::string too_many_steps(double time, double dt);

}  // namespace voussoir
