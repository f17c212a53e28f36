// Response of a model for comparison with measured features: modes at the sensors, and their derivatives.
#pragma once
#include "solver/diagnosis/linear_model.h"
#include "solver/diagnosis/model_change.h"
#include "solver/modal/modes.h"

namespace voussoir {

/// Values of the modes at instruments and for the motion of the ground, or their derivatives with respect to a
/// parameter.
struct ModalData {
  Eigen::VectorXd log_frequency;  // of Hz
  Eigen::MatrixXd sensors;        // sensor × mode, of M-normalised modes
  Eigen::MatrixXd motions;        // at the sensors along x, y, z: three rows for each sensor; empty: not requested
  /// φᵀ M r of each axis (rows) and mode, for a common motion of all supports. Empty: not requested.
  Eigen::MatrixXd participation;
  std::vector<Eigen::MatrixXd> at_support;  // the part of each of supports()
};

/// Forces of the motion of the ground on the unknowns, one column for each axis.
struct GroundForces {
  Eigen::MatrixXd inertia;            // M r, r a common translation
  std::vector<std::int64_t> bases;    // of each of supports()
  std::vector<Eigen::MatrixXd> pull;  // N/m, N: −K_uf e for the unit translations e of each single base; K_uf is the
                                      // stiffness between the unknowns and the base
};

/// Unit translations of all unknowns, one column for each axis.
Eigen::MatrixXd translations(const Unknowns& unknowns);
/// `inertia`: M times the translations.
GroundForces ground_forces(const Assembly& assembly, const Unknowns& unknowns, const Eigen::MatrixXd& inertia);

/// mode_words() for a vector over the unknowns.
ModeWords words_of(const Assembly& assembly, const Unknowns& unknowns, double eigenvalue,
                   const Eigen::VectorXd& vector);

struct Response : ModalData {
  Eigen::VectorXd eigenvalues;  // rad2/s2, ascending
  std::vector<ModeWords> words;
  Eigen::MatrixXd vectors;  // over the unknowns, M-normalised
  double shift = 0.0;       // rad2/s2, of the factor in the memory
  GroundForces ground;      // empty if participation was not requested
};

/// The `count` lowest modes, or fewer if there are fewer. `driven`: including participation in the motion of the
/// ground.
Response response(const Assembly& assembly, const LinearModel& model, const std::vector<Sensor>& sensors, int count,
                  EigenMemory& memory, bool driven = false);

/// Quasi-static response to the motion of a support: accelerations at the sensors (rows) for a unit acceleration of
/// only the base of one support along x, y, z, from K⁻¹ times its pull. The memory must be that of the response.
Eigen::MatrixXd follow_support(const Assembly& assembly, const Response& response, const LinearModel& model,
                               std::size_t support, const std::vector<Sensor>& sensors, const EigenMemory& memory);

/// Displacements along the directions of the sensors: rows are sensors, columns are vectors.
Eigen::MatrixXd at_sensors(const Assembly& assembly, const Unknowns& unknowns, const std::vector<Sensor>& sensors,
                           const Eigen::MatrixXd& vectors);
Eigen::MatrixXd at_sensors(const Assembly& assembly, const Unknowns& unknowns, const std::vector<Sensor>& sensors,
                           const Basis& vectors);

/// Displacements along x, y and z at the sensors: three rows for each sensor.
Eigen::MatrixXd motions_at(const Assembly& assembly, const Unknowns& unknowns, const std::vector<Sensor>& sensors,
                           const Eigen::MatrixXd& vectors);
/// For each sensor, three sensors along x, y and z at its position.
std::vector<Sensor> along_axes(const std::vector<Sensor>& sensors);

/// Unit forces at the sensors along their directions, one column for each: the transpose of at_sensors().
Eigen::MatrixXd sensor_loads(const Assembly& assembly, const Unknowns& unknowns, const std::vector<Sensor>& sensors);

}  // namespace voussoir
