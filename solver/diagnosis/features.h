// What was measured, as the diagnosis uses it: frequencies, damping and shapes at sensors, each with its uncertainty.
#pragma once
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
  bool held_back = false;     // not fitted: to be predicted
};

struct Features {
  std::vector<Sensor> sensors;
  std::vector<MeasuredFeature> modes;  // descending in period
};

/// How far a right model may be from a right measurement: the mesh, the scatter of materials, dimensions.
struct ModelError {
  double frequency = 0.01;  // of its logarithm
  double shape = 0.02;      // share of a shape's largest component, from sensor to sensor
  double mixing = 0.03;     // how much of a neighbour a shape holds, over the relative distance of their eigenvalues
  double damping = 0.2;     // of its logarithm
};

}  // namespace voussoir
