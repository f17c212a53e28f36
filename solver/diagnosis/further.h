// What would be worth measuring next: sensors and modes that lower the least amounts of effects most.
#pragma once
#include "solver/diagnosis/screening.h"

namespace voussoir {

/// A channel or a mode that was not measured yet.
struct Addition {
  std::string text;     // "a sensor at (12.0, 0.0, 8.1) m on parapet along y", "the mode transverse, 4th order, …"
  std::string sensor;   // "12,0,8.1,y", as a row of sensors.csv; empty: it is a mode
  double factor = 1.0;  // of least amounts with it and those of its kind before it, on (geometric) average
  struct Helped {
    std::string name, where;
    double factor = 1.0;
    bool above = false;     // which of its two least values: that above neutral
    std::size_t trace = 0;  // of those given to best_additions()
  };
  std::vector<Helped> most;  // the least amounts that fall most by it alone, at most three
  std::vector<int> rows;     // of the extended problem: what it measures
};

/// A problem with all that could be measured besides, as if a model had been measured: channels at further places of
/// the bridge, and modes of that model which were not measured. Their errors are usual ones: those of the model follow
/// from the same nuisances.
struct Extended {
  DiagnosisProblem problem;
  Response plain;             // of the model, at all sensors
  std::vector<int> had;       // rows of what was measured and fitted
  std::vector<bool> further;  // by mode of the problem: it was not measured; empty: all were
  struct Option {
    Addition addition;
    std::vector<int> rows;
  };
  std::vector<Option> options;
};

/// About the model of a hypothesis at x, which is the origin. `options`: false: only what was measured.
Extended extended(const DiagnosisProblem& problem, const Origin& origin, const Hypothesis& hypothesis,
                  const Eigen::VectorXd& x, bool options, int threads);

/// What an effect does to all rows, of an amount whose distance from none must be `needed` to be found.
struct Trace {
  std::string name, where;
  Eigen::VectorXd rows;
  double needed = 1.0;
  std::size_t candidate = 0;  // of those asked about
  bool above = false;         // of its neutral value
};

/// The `count` sensors, or modes, that lower least amounts most, one after the other (greedily). In proportion to its
/// amount an effect's distance from none grows, so least amounts fall as distances of one amount grow: with rows A
/// beside S the square of the distance d grows by gᵀ (C_AA − C_AS C_SS⁻¹ C_SA)⁻¹ g, g = d_A − C_AS C_SS⁻¹ d_S
/// (conditional normal distributions). `covariance`: of all rows, with what fitted parameters explain.
std::vector<Addition> best_additions(const Extended& all, bool sensors, const Eigen::MatrixXd& covariance,
                                     const std::vector<Trace>& traces, int count);

}  // namespace voussoir
