// What was measured, as the diagnosis uses it: frequencies, damping and shapes at sensors, each with its uncertainty.
#pragma once
#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include "geometry/assembly.h"

namespace voussoir {

/// A measured mode. Shapes have any scale; entries that were not measured are not finite.
struct MeasuredFeature {
  std::string name;
  double frequency = 0.0;      // Hz
  double frequency_std = 0.0;  // of its logarithm
  std::optional<double> damping;
  double damping_std = 0.0;   // of its logarithm
  std::string direction;      // longitudinal, transverse, vertical, torsional; empty: not known
  Eigen::VectorXd shape;      // per sensor; empty: none
  Eigen::VectorXd shape_std;  // in the units of the shape
  double unit = 0.0;          // the component that rows are shares of; 0: the largest of those that were measured
  /// Imaginary parts of the shape, with the same standard deviations: of a structure with the damping of its parts
  /// alike they are noise, of a channel whose clock is late they are not. Empty: not known.
  Eigen::VectorXd quadrature;
  /// Acceleration of a sensor where the shape is 1 that resonance adds, per acceleration of the ground along x, y, z
  /// (the residue of the transfer function over the shape); complex where supports do not move together. Not finite:
  /// not known.
  Eigen::Vector3cd participation = Eigen::Vector3cd::Constant(std::nan(""));
  Eigen::Vector3d participation_std = Eigen::Vector3d::Zero();  // of each of real and imaginary part
  bool held_back = false;                                       // not fitted: to be predicted
};

/// Known at three sensors or more: of fewer it says nothing, because its scale is free.
bool has_shape(const MeasuredFeature& mode);
/// What the rows of a mode's shape are shares of.
double unit_of(const MeasuredFeature& mode);

struct Features {
  std::vector<Sensor> sensors;
  std::vector<MeasuredFeature> modes;  // descending in period
  bool driven() const {                // by a motion of the ground that was recorded
    return std::any_of(modes.begin(), modes.end(),
                       [](const auto& m) { return m.participation.array().isFinite().any(); });
  }
};

/// How far a right model may be from a right measurement: the mesh, the scatter of materials, dimensions.
struct ModelError {
  double frequency = 0.01;   // of its logarithm
  double shape = 0.02;       // share of a shape's largest component, from sensor to sensor
  double mixing = 0.015;     // how much of a neighbour a shape holds, over the relative distance of their eigenvalues
  double damping = 0.2;      // of its logarithm
  double quadrature = 0.03;  // imaginary parts of a shape, share of its largest component
  double participation = 0.05;  // share of a mode's largest
};

}  // namespace voussoir
