// What was measured, as a diagnosis compares it with a model.
#pragma once
#include "io/measured/measured.h"
#include "solver/diagnosis/features.h"

namespace voussoir {

/// With usual standard deviations where none are given.
MeasuredFeature feature_of(const MeasuredMode& mode, std::size_t sensors);
/// Features of the modes, in the order of their frequencies. Sensors are on their blocks; throws InputError where one
/// is off every block.
Features features_of(const Measured& measured, const Assembly& assembly);

/// "20 sensors", or "3 of 20 sensors" when the shapes of all modes know no others.
std::string sensors_used(const Features& features);

}  // namespace voussoir
