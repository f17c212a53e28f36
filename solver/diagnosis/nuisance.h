// Nuisance quantities, which no drawing gives exactly: the stiffness and density of each part, and every dimension.
// Their first-order effect on the modes gives the structure of the model error.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "solver/diagnosis/hypothesis.h"
#include "solver/diagnosis/reduced_model.h"

namespace voussoir {

/// A quantity of the bridge that can differ from its value in the case.
struct Nuisance {
  std::string name, unit;  // "stiffness of pier 1", "-"
  double spread = 0.0;     // standard deviation, in the unit
  double step = 0.0;       // of the finite difference, in the unit; smaller or of opposite sign if that fails
  /// The base with the quantity increased by this amount, in the unit. Throws InputError if the result is not a valid
  /// bridge.
  std::function<Assembly(const Assembly& base, double amount)> with;
};

/// Nuisances of the parts of the assembly: factors on the stiffness and density of each part, and on the stiffness of
/// the joints between parts, of the interfaces of the fill and of each base.
std::vector<Nuisance> part_nuisances(const Assembly& base);

/// Effect of one standard deviation of a nuisance on the modes; `modes.log_frequency` is empty if it could not be
/// computed.
struct Sensitivity {
  std::string name, unit;
  double spread = 0.0;
  ModalData modes;
  std::string why;  // reason if it could not be computed
};

/// Derivatives of the lowest `wanted` modes of one model; those of the other modes are zero.
class Sensitivities {
 public:
  Sensitivities(const Origin& origin, const std::vector<Sensor>& sensors, int wanted);
  /// The sensitivity for a hypothesis about the base at x, whose model is the origin. λ′ as Fox and Kapoor (1968, eq.
  /// 8); φ′ by the known modes, and the static response of the others (mode acceleration, Sutter, Camarda, Walsh &
  /// Adelman 1988, eq. 9), which is evaluated at the sensors with unit loads.
  Sensitivity of(const Nuisance& nuisance, const Assembly& base, const Hypothesis& hypothesis,
                 const Eigen::VectorXd& x) const;

 private:
  /// `amount` is the difference between `changed` and the origin.
  ModalData derivative_to(const Assembly& changed, double amount) const;

  const Origin* origin_;
  std::vector<Sensor> sensors_;
  std::vector<Sensor> places_;         // positions of the sensors, each once
  std::vector<std::size_t> place_of_;  // of each sensor
  Eigen::Index wanted_;
  Vectors modes_, loads_;    // all known modes; K⁻¹ of unit loads along x, y, z at the places and of M r of the axes
  Eigen::MatrixXd motions_;  // of the places in the wanted modes
};

}  // namespace voussoir
