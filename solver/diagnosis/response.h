// What a model says of the measured features: modes as the sensors see them, and their derivatives.
#pragma once
#include "solver/diagnosis/linear_model.h"
#include "solver/modal/modes.h"

namespace voussoir {

struct Response {
  Eigen::VectorXd eigenvalues;    // rad2/s2, ascending
  Eigen::VectorXd log_frequency;  // of Hz
  Eigen::MatrixXd sensors;        // sensor × mode, of M-normalised modes
  std::vector<ModeWords> words;
  Eigen::MatrixXd vectors;  // over the unknowns, M-normalised
  double shift = 0.0;       // rad2/s2, of the memory's factor
};

/// Change of a response with a parameter.
struct ResponseDerivative {
  Eigen::VectorXd log_frequency;
  Eigen::MatrixXd sensors;
};

/// The `count` lowest modes; fewer where there are fewer.
Response response(const Assembly& assembly, const LinearModel& model, const std::vector<Sensor>& sensors, int count,
                  EigenMemory& memory);

/// λ′ = φᵀ (K′ − λ M′) φ (Fox and Kapoor 1968, eq. 8), and φ′ from all modes that are known and a static solution for
/// the others (Wang 1991, eq. 20): of what those others take part with a share λ/λ_n is left out. Only of
/// the modes that are `wanted`; the memory must be that of the response.
ResponseDerivative response_derivative(const Assembly& assembly, const Response& response, const LinearModel& model,
                                       const Derivative& d, const std::vector<Sensor>& sensors,
                                       const EigenMemory& memory, const std::vector<bool>& wanted);

/// Displacement along the sensors' directions: rows of sensors, columns of vectors.
Eigen::MatrixXd at_sensors(const Assembly& assembly, const Unknowns& unknowns, const std::vector<Sensor>& sensors,
                           const Eigen::MatrixXd& vectors);

}  // namespace voussoir
