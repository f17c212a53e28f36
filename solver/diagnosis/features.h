// Measured data for the diagnosis: frequencies, damping ratios and mode shapes at sensors, each with its uncertainty.
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

/// A measured mode. The scale of a shape is arbitrary; entries that were not measured are not finite.
struct MeasuredFeature {
  std::string name;
  double frequency = 0.0;      // Hz
  double frequency_std = 0.0;  // of its logarithm
  std::optional<double> damping;
  double damping_std = 0.0;   // of its logarithm
  std::string direction;      // longitudinal, transverse, vertical, torsional; empty: unknown
  Eigen::VectorXd shape;      // per sensor; empty: none
  Eigen::VectorXd shape_std;  // in the units of the shape
  double unit = 0.0;          // component that scales the rows; 0: the largest measured one
  /// Imaginary parts of the shape, with the same standard deviations. They are noise if all parts of the structure have
  /// the same damping; a channel with a late clock has systematic values. Empty: unknown.
  Eigen::VectorXd quadrature;
  /// Resonant acceleration of a sensor at which the shape is 1, per acceleration of the ground along x, y, z (the
  /// residue of the transfer function over the shape). It is complex if the supports do not move together. Not finite:
  /// unknown.
  Eigen::Vector3cd participation = Eigen::Vector3cd::Constant(std::nan(""));
  Eigen::Vector3d participation_std = Eigen::Vector3d::Zero();  // of each of real and imaginary part
  bool held_back = false;                                       // not fitted, but predicted
};

/// Whether the shape is known at three or more sensors. With fewer it gives no information because its scale is free.
bool has_shape(const MeasuredFeature& mode);
/// The component that scales the rows of a mode shape.
double unit_of(const MeasuredFeature& mode);

struct Features {
  std::vector<Sensor> sensors;
  std::vector<MeasuredFeature> modes;  // descending in period
  bool driven() const {                // by a recorded motion of the ground
    return std::any_of(modes.begin(), modes.end(),
                       [](const auto& m) { return m.participation.array().isFinite().any(); });
  }
};

/// Error of a correct model relative to a correct measurement: mesh, scatter of materials, dimensions.
struct ModelError {
  double frequency = 0.01;      // of its logarithm
  double shape = 0.02;          // share of a shape's largest component, from sensor to sensor
  double mixing = 0.015;        // share of a neighbouring mode in a shape, times the relative distance of their
                                // eigenvalues
  double damping = 0.2;         // of its logarithm
  double quadrature = 0.03;     // imaginary parts of a shape, share of its largest component
  double participation = 0.05;  // share of the largest value of a mode
};

}  // namespace voussoir
