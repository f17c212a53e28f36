// What no drawing gives exactly: the stiffness and density of each part, every dimension. What it does to the modes, to
// first order, is the structure of the model's error.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "solver/diagnosis/hypothesis.h"
#include "solver/diagnosis/reduced_model.h"

namespace voussoir {

/// A quantity of the bridge that is not exactly what the case says.
struct Nuisance {
  std::string name, unit;  // "stiffness of pier 1", "-"
  double spread = 0.0;     // standard deviation, in the unit
  double step = 0.0;       // of the finite difference, in the unit; less and to the other side where that fails
  /// The base with this amount more of it, in the unit. Throws InputError where that is no bridge.
  std::function<Assembly(const Assembly& base, double amount)> with;
};

/// Of parts that the assembly has: factors on the stiffness and density of each, and on the stiffness of the joints
/// between parts, of the fill's interfaces and of each base.
std::vector<Nuisance> part_nuisances(const Assembly& base);

/// What one standard deviation of a nuisance does to the modes; `modes.log_frequency` empty: it could not be said.
struct Sensitivity {
  std::string name, unit;
  double spread = 0.0;
  ModalData modes;
  std::string why;  // it could not
};

/// Derivatives of the lowest `wanted` modes of one model; those of the others are zero.
class Sensitivities {
 public:
  Sensitivities(const Origin& origin, const std::vector<Sensor>& sensors, int wanted);
  /// Of a hypothesis about the base at x, of which the origin is the model. λ′ as Fox and Kapoor (1968, eq. 8); φ′ by
  /// the known modes, and the static response of the others (mode acceleration, Sutter, Camarda, Walsh & Adelman 1988,
  /// eq. 9), which is read at the sensors through their own unit loads.
  Sensitivity of(const Nuisance& nuisance, const Assembly& base, const Hypothesis& hypothesis,
                 const Eigen::VectorXd& x) const;

 private:
  /// `amount`: by which `changed` differs from the origin.
  ModalData derivative_to(const Assembly& changed, double amount) const;

  const Origin* origin_;
  std::vector<Sensor> sensors_;
  std::vector<Sensor> places_;         // of the sensors, each once
  std::vector<std::size_t> place_of_;  // of each sensor
  Eigen::Index wanted_;
  Vectors modes_, loads_;    // all known modes; K⁻¹ of unit loads along x, y, z at the places and of M r of the axes
  Eigen::MatrixXd motions_;  // of the places in the wanted modes
};

}  // namespace voussoir
