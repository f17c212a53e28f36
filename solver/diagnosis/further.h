// Proposals for further measurements: sensors and modes that lower the least detectable amounts of effects most.
#pragma once
#include "solver/diagnosis/screening.h"

namespace voussoir {

/// A channel or a mode that has not been measured.
struct Addition {
  std::string text;     // "a sensor at (12.0, 0.0, 8.1) m on parapet along y", "the mode transverse, 4th order, …"
  std::string sensor;   // "12,0,8.1,y", as a row of sensors.csv; empty: it is a mode
  double factor = 1.0;  // factor on the detection limits due to it and the earlier ones of its kind, geometric mean
  struct Helped {
    std::string name, where;
    double factor = 1.0;
    bool above = false;     // the limit above the neutral value, else that below
    std::size_t trace = 0;  // index among the traces given to best_additions()
  };
  std::vector<Helped> most;  // at most three detection limits, those that it alone lowers most
  std::vector<int> rows;     // rows of the extended problem that it measures
};

/// A problem with all possible further measurements, as if a model had been measured: channels at further places of the
/// bridge, and modes of that model that were not measured. Measurement errors have their usual values, and model errors
/// follow from the same nuisances.
struct Extended {
  DiagnosisProblem problem;
  Response plain;             // of the model, at all sensors
  std::vector<int> had;       // rows that were measured and fitted
  std::vector<bool> further;  // for each mode of the problem: it was not measured; empty: all were measured
  struct Option {
    Addition addition;
    std::vector<int> rows;
  };
  std::vector<Option> options;
};

/// Extends the problem about the model of a hypothesis at x, which is the origin. `options` false: only the measured
/// rows.
Extended extended(const DiagnosisProblem& problem, const Origin& origin, const Hypothesis& hypothesis,
                  const Eigen::VectorXd& x, bool options, int threads);

/// Change of all rows by an amount of an effect. The effect is found if its distance from "none" is at least `needed`.
struct Trace {
  std::string name, where;
  Eigen::VectorXd rows;
  double needed = 1.0;
  std::size_t candidate = 0;  // index of the candidate
  bool above = false;         // above its neutral value
};

/// The `count` sensors, or modes, that lower the detection limits most, one after the other (greedily). The distance of
/// an effect from "none" is in proportion to its amount, so the detection limit decreases as the distance for a fixed
/// amount increases. With rows A in addition to S, the square of the distance grows by gᵀ (C_AA − C_AS C_SS⁻¹ C_SA)⁻¹ g
/// with g = d_A − C_AS C_SS⁻¹ d_S (conditional normal distributions), where d is the change of the rows and C is
/// `covariance`: that of all rows, including the fitted parameters.
std::vector<Addition> best_additions(const Extended& all, bool sensors, const Eigen::MatrixXd& covariance,
                                     const std::vector<Trace>& traces, int count);

}  // namespace voussoir
