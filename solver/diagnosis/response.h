// What a model says of the measured features: modes as the sensors see them, and their derivatives.
#pragma once
#include "solver/diagnosis/linear_model.h"
#include "solver/diagnosis/model_change.h"
#include "solver/modal/modes.h"

namespace voussoir {

/// What instruments, and the ground's motion, have of the modes; or how that changes with a parameter.
struct ModalData {
  Eigen::VectorXd log_frequency;  // of Hz
  Eigen::MatrixXd sensors;        // sensor × mode, of M-normalised modes
  Eigen::MatrixXd motions;        // of their places along x, y, z: three rows a sensor; empty: not asked for
  /// φᵀ M r of each axis (rows) and mode: how a common motion of all supports drives it. Empty: not asked for.
  Eigen::MatrixXd participation;
  std::vector<Eigen::MatrixXd> at_support;  // the part of it that comes through each of supports()
};

/// What the ground's motion does to the unknowns, a column an axis.
struct GroundForces {
  Eigen::MatrixXd inertia;            // M r, r a common translation
  std::vector<std::int64_t> bases;    // of each of supports()
  std::vector<Eigen::MatrixXd> pull;  // −K_uf e of each base that moves alone
};

/// Unit translations of all that moves, a column an axis.
Eigen::MatrixXd translations(const Unknowns& unknowns);
/// `inertia`: M of those.
GroundForces ground_forces(const Assembly& assembly, const Unknowns& unknowns, const Eigen::MatrixXd& inertia);

/// A vector over the unknowns as mode_words() wants it.
ModeWords words_of(const Assembly& assembly, const Unknowns& unknowns, double eigenvalue,
                   const Eigen::VectorXd& vector);

struct Response : ModalData {
  Eigen::VectorXd eigenvalues;  // rad2/s2, ascending
  std::vector<ModeWords> words;
  Eigen::MatrixXd vectors;  // over the unknowns, M-normalised
  double shift = 0.0;       // rad2/s2, of the memory's factor
  GroundForces ground;      // empty where participation was not asked for
};

/// The `count` lowest modes; fewer where there are fewer. `driven`: with what the ground's motion does to them.
Response response(const Assembly& assembly, const LinearModel& model, const std::vector<Sensor>& sensors, int count,
                  EigenMemory& memory, bool driven = false);

/// How the bridge follows its supports without resonance: accelerations that the sensors read (rows) for a unit
/// acceleration of one support's base alone along x, y, z, K⁻¹ of its pull; the memory must be that of the response.
Eigen::MatrixXd follow_support(const Assembly& assembly, const Response& response, const LinearModel& model,
                               std::size_t support, const std::vector<Sensor>& sensors, const EigenMemory& memory);

/// Displacement along the sensors' directions: rows of sensors, columns of vectors.
Eigen::MatrixXd at_sensors(const Assembly& assembly, const Unknowns& unknowns, const std::vector<Sensor>& sensors,
                           const Eigen::MatrixXd& vectors);
Eigen::MatrixXd at_sensors(const Assembly& assembly, const Unknowns& unknowns, const std::vector<Sensor>& sensors,
                           const Basis& vectors);

/// Along x, y and z at the sensors' places: three rows a sensor.
Eigen::MatrixXd motions_at(const Assembly& assembly, const Unknowns& unknowns, const std::vector<Sensor>& sensors,
                           const Eigen::MatrixXd& vectors);
/// The three sensors along x, y and z in the place of each.
std::vector<Sensor> along_axes(const std::vector<Sensor>& sensors);

/// Unit forces at the sensors along their directions, a column each: the transpose of at_sensors().
Eigen::MatrixXd sensor_loads(const Assembly& assembly, const Unknowns& unknowns, const std::vector<Sensor>& sensors);

}  // namespace voussoir
