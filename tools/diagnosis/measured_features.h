// What was measured, as a diagnosis compares it with a model.
#pragma once
#include "io/measured/measured.h"
#include "solver/diagnosis/features.h"
#include "solver/diagnosis/response.h"

namespace voussoir {

/// With usual standard deviations where none are given.
MeasuredFeature feature_of(const MeasuredMode& mode, std::size_t sensors);
/// Features of the modes, in the order of their frequencies. Sensors are on their blocks; throws InputError where one
/// is off every block.
Features features_of(const Measured& measured, const Assembly& assembly);

/// How well modes are known that a measurement will give.
struct Precision {
  double periods = 0.01;        // standard deviation, share
  double shapes = 0.02;         // share of the largest component
  double damping_ratio = 0.05;  // share of critical, known to a tenth
};
/// The lowest modes of a model that are not local, at most so many, as its sensors have them: without errors, but with
/// the deviations that a measurement of them has.
std::vector<MeasuredMode> expected_modes(const Response& model, int most, const Precision& precision);

/// "20 sensors", or "3 of 20 sensors" when the shapes of all modes know no others.
std::string sensors_used(const Features& features);

}  // namespace voussoir
