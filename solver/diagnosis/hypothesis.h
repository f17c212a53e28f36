// What may be wrong with a model: parameters that every model is unsure of, and candidates, each an effect at a place.
#pragma once
#include <functional>
#include <string>
#include <vector>

#include "solver/diagnosis/response.h"
#include "solver/effects/effect.h"

namespace voussoir {

/// A parameter with its prior. Fits work in x, standard deviations of the prior from its middle.
struct FitParameter {
  std::string name, unit;
  double usual = 1.0, spread = 1.0;  // of the logarithm where `logarithmic`
  bool logarithmic = false;
  double low = 0.0, high = 1.0;
  double value(double x) const;  // within the bounds
  double x(double value) const;
};

/// A property of a material that every model is unsure of: a factor of the effect `calibration`.
struct Calibration {
  std::string where, property;  // "masonry", "stiffness"
  FitParameter parameter;       // x = 0 is the case as it is
};
/// Those that the assembly's materials have.
std::vector<Calibration> calibrations(const Assembly& assembly);

/// An effect at a place, what is wrong with the readings of a sensor, or a factor on a part that has no name.
struct Candidate {
  enum class Kind { effect, damping, gain, swap, turn, clock, motion, factor };
  Kind kind = Kind::effect;
  std::string name, where;
  double prior = 1.0;  // probability before any data, that one of all candidates acts being 1
  std::vector<FitParameter> parameters;
  std::vector<std::vector<double>> starts;              // x to begin fits at
  std::vector<std::size_t> sensors;                     // gain, clock: one; swap: two
  std::size_t support = 0;                              // motion: of supports()
  double gain = 1.0;                                    // gain without a parameter: −1, a polarity; 0, dead
  double turn = 0.0, tilt = 0.0;                        // turn: deg, as the effect sensor_fault has them
  Vec3 direction = Vec3::Zero();                        // turn: of the sensor as it is mounted then
  std::function<void(Assembly&, double factor)> apply;  // factor
  std::string text() const;                             // "abutment_restraint at both"
  std::string full_text() const;                        // of a channel with what is wrong with it: "…, reversed"
  EffectSetting setting(const double* x) const;
  bool of_sensors() const {  // what is wrong with a channel
    return kind == Kind::gain || kind == Kind::swap || kind == Kind::turn || kind == Kind::clock;
  }
};

struct CandidateChoice {
  bool damping = false;              // the data say something of it
  bool clocks = false;               // of phases between sensors
  bool driven = false;               // of the ground's motion
  std::vector<std::string> without;  // names that are not to be tried
};
/// Every effect of the library at each of its places in this assembly, and the faults of sensors: of those that are in
/// `sensors`.
std::vector<Candidate> candidates(const Assembly& assembly, const std::vector<Sensor>& sensors,
                                  const CandidateChoice& choice);

/// Factors on the stiffness and on the mass of each part of the bridge, and springs between its ends and the ground,
/// along it and across: what is left to try when no effect fits.
std::vector<Candidate> nameless_factors(const Assembly& assembly);

/// What instruments would show of a model's modes.
struct Observed {
  Eigen::VectorXd log_frequency;   // of Hz
  Eigen::MatrixXd readings;        // sensor × mode
  Eigen::MatrixXcd participation;  // axis × mode, of M-normalised modes; empty: not asked for
  Eigen::VectorXd delays;          // s, of each sensor's clock
  double damping = 0.0;            // share of critical
};

/// A model that is tried: the case's, with factors on its materials and candidates in place.
struct Hypothesis {
  std::vector<Calibration> materials;
  std::vector<Candidate> effects;

  std::size_t size() const;  // of x: materials first
  std::vector<FitParameter> parameters() const;
  /// The effects of a case that is this hypothesis; nameless factors have none.
  std::vector<EffectSetting> settings(const Eigen::VectorXd& x) const;
  /// Throws InputError where an effect cannot act.
  Assembly assembly(const Assembly& base, const Eigen::VectorXd& x) const;
  /// The same in a copy of the base that is there already.
  void change(Assembly& copy, const Eigen::VectorXd& x) const;
  /// What would be observed of modes, with faults of sensors and motions of supports; `damping` (share of critical) is
  /// that of the case.
  Observed observe(const ModalData& modes, double damping, const Eigen::VectorXd& x) const;
  /// The same with a further candidate.
  Hypothesis with(const Candidate& candidate) const;
};

}  // namespace voussoir
