// How many steps a run may take.
#pragma once
#include <string>

namespace voussoir {

/// Why `time` s of simulated time in steps of `dt` s are too many steps to begin with, with their number and the least
/// wall time; empty when they are not, or when `dt` is not known yet (0).
std::string too_many_steps(double time, double dt);

}  // namespace voussoir
