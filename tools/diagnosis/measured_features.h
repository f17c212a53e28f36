// Measured features in the form in which a diagnosis compares them with a model.
#pragma once
#include "io/measured/measured.h"
#include "solver/diagnosis/features.h"
#include "solver/diagnosis/response.h"

namespace voussoir {

/// The feature of a mode, with default standard deviations if none are given.
MeasuredFeature feature_of(const MeasuredMode& mode, std::size_t sensors);
/// The features of all modes in order of frequency, with each sensor on its block. Throws InputError if a sensor is on
/// no block.
Features features_of(const Measured& measured, const Assembly& assembly);

/// Assumed precision of a planned measurement.
struct Precision {
  double periods = 0.01;        // relative standard deviation
  double shapes = 0.02;         // standard deviation, share of the largest component
  double damping_ratio = 0.05;  // share of critical damping, with a standard deviation of a tenth of it
};
/// The `most` lowest modes of a model that are not local, at its sensors: without errors, but with the standard
/// deviations of a measurement.
std::vector<MeasuredMode> expected_modes(const Response& model, int most, const Precision& precision);

/// "20 sensors", or "3 of 20 sensors" if the mode shapes contain only 3 of them.
std::string sensors_used(const Features& features);

}  // namespace voussoir
