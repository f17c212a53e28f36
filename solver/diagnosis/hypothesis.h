// Hypotheses about the errors of a model: uncertain parameters of every model, and candidates, each an effect at a
// place.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "solver/diagnosis/response.h"
#include "solver/effects/effect.h"

namespace voussoir {

/// A parameter with its prior. The variable of a fit is x, the distance from the middle of the prior in standard
/// deviations.
struct FitParameter {
  std::string name, unit;
  double usual = 1.0, spread = 1.0;  // of the logarithm where `logarithmic`
  bool logarithmic = false;
  double low = 0.0, high = 1.0;
  double value(double x) const;  // within the bounds
  double x(double value) const;
};

/// An uncertain property of a material: a factor of the effect `calibration`.
struct Calibration {
  std::string where, property;  // "masonry", "stiffness"
  FitParameter parameter;       // x = 0 is the unchanged case
};
/// The calibrations for the materials of the assembly.
std::vector<Calibration> calibrations(const Assembly& assembly);

/// An effect at a place, a fault of a channel, or an unnamed factor on a part.
struct Candidate {
  enum class Kind { effect, damping, gain, swap, turn, clock, motion, factor };
  Kind kind = Kind::effect;
  std::string name, where;
  double prior = 1.0;  // prior probability; the sum over all candidates is 1
  std::vector<FitParameter> parameters;
  std::vector<std::vector<double>> starts;              // start values of x for fits
  std::vector<std::size_t> sensors;                     // gain, clock: one; swap: two
  std::size_t support = 0;                              // motion: of supports()
  double gain = 1.0;                                    // gain without a parameter: −1 reversed, 0 dead
  double turn = 0.0, tilt = 0.0;                        // turn: deg, as in the effect sensor_fault
  Vec3 direction = Vec3::Zero();                        // turn: direction of the sensor with this fault
  std::function<void(Assembly&, double factor)> apply;  // factor
  std::string text() const;                             // "abutment_restraint at both"
  std::string full_text() const;                        // with the fault of a channel: "…, reversed"
  EffectSetting setting(const double* x) const;
  bool of_sensors() const {  // a fault of a channel
    return kind == Kind::gain || kind == Kind::swap || kind == Kind::turn || kind == Kind::clock;
  }
};

struct CandidateChoice {
  bool damping = false;              // the data contain damping ratios
  bool clocks = false;               // the data contain phases between sensors
  bool driven = false;               // the data contain the motion of the ground
  std::vector<std::string> without;  // names of excluded effects
};
/// Every effect of the library at each of its places in this assembly, and the faults of the given sensors.
std::vector<Candidate> candidates(const Assembly& assembly, const std::vector<Sensor>& sensors,
                                  const CandidateChoice& choice);

/// Factors on the stiffness and mass of each part of the bridge, and springs between its ends and the ground in the
/// longitudinal and transverse directions. They are tried when no effect fits.
std::vector<Candidate> nameless_factors(const Assembly& assembly);

/// Modes of a model as the instruments would measure them.
struct Observed {
  Eigen::VectorXd log_frequency;   // of Hz
  Eigen::MatrixXd readings;        // sensor × mode
  Eigen::MatrixXcd participation;  // axis × mode, of M-normalised modes; empty: not requested
  Eigen::VectorXd delays;          // s, of each sensor's clock
  double damping = 0.0;            // damping ratio
};

/// A trial model: the model of the case with factors on its materials and with candidates applied.
struct Hypothesis {
  std::vector<Calibration> materials;
  std::vector<Candidate> effects;

  std::size_t size() const;  // of x: materials first
  std::vector<FitParameter> parameters() const;
  /// The effects of the case that corresponds to this hypothesis. Unnamed factors have no effect.
  std::vector<EffectSetting> settings(const Eigen::VectorXd& x) const;
  /// Throws InputError if an effect cannot act.
  Assembly assembly(const Assembly& base, const Eigen::VectorXd& x) const;
  /// The same, applied to an existing copy of the base.
  void change(Assembly& copy, const Eigen::VectorXd& x) const;
  /// Observations of the modes, with the faults of sensors and motions of supports; `damping` is the damping ratio of
  /// the case.
  Observed observe(const ModalData& modes, double damping, const Eigen::VectorXd& x) const;
  /// The same with a further candidate.
  Hypothesis with(const Candidate& candidate) const;
};

}  // namespace voussoir
