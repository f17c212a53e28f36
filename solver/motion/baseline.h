// Baseline correction of ground motions.
#pragma once
#include <vector>

#include "solver/model/settings.h"

namespace voussoir {

/// Velocity in m/s at the samples of a piecewise linear acceleration that starts from rest (trapezoidal rule: exact).
std::vector<double> integrate(const std::vector<double>& samples, double dt);

/// Subtracts from each component the acceleration of a cubic velocity baseline c1 t + c2 t² + c3 t³ that makes the mean
/// square velocity least (after Berg & Housner 1961) under the condition that the velocity is zero at the end.
/// A motion of fewer than five samples is returned as it is.
GroundMotion correct_baseline(const GroundMotion& motion);

}  // namespace voussoir
