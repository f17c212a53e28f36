// Fitting a hypothesis to measured features: residuals in standard deviations, priors, Laplace's evidence.
#pragma once
#include "solver/diagnosis/model_family.h"
#include "solver/diagnosis/problem.h"

namespace voussoir {

/// What a hypothesis makes of the features at x.
struct Evaluation {
  Eigen::VectorXd x;
  Assembly assembly;
  LinearModel model;
  Response response;
  Eigen::MatrixXd readings;  // of the sensors, sensor × mode
  ModePairs pairing;
  Eigen::VectorXd differences;  // measured − computed, by row, each in its own unit
  Eigen::VectorXd residuals;    // the same in independent standard deviations
};
Evaluation evaluate(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows, const Hypothesis& hypothesis,
                    const Eigen::VectorXd& x, EigenMemory& memory);
/// The same in a basis: without the model and its vectors.
Evaluation evaluate(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows, const Hypothesis& hypothesis,
                    const ModelFamily& family, const ModelFamily::Member& member);
/// Derivatives of the residuals, row × parameter.
Eigen::MatrixXd jacobian(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows,
                         const Hypothesis& hypothesis, const ModelFamily& family, const ModelFamily::Member& member,
                         const Evaluation& at);
struct Fit {
  Hypothesis hypothesis;
  Evaluation best;
  Eigen::MatrixXd jacobian;   // there, row × parameter
  Eigen::VectorXd std;        // of x, over what is believed of the scale
  double misfit = 0.0;        // sum of squares of the fitted rows and of x: χ² of as many degrees as fitted rows
  double log_evidence = 0.0;  // over all scales, up to a constant that is the same for all fits under one covariance
  ErrorScale scale;           // as the data have it: its mean
  int evaluations = 0;
  double basis_error = 0.0;    // estimated, of eigenvalues, where the fit ended
  std::vector<bool> at_bound;  // by parameter
  /// Root mean square residual of the rows that were fitted, of those held back.
  double gap = 0.0, held_gap = 0.0;
  /// Root mean square of what the other modes leave unexplained of each mode, in standard deviations of that
  /// prediction: leave one mode out, linearised about the fit.
  double predicted_gap = 0.0;
};

/// Levenberg–Marquardt (Ceres) from x, whose prior is standard normal, within the parameters' bounds: in a basis about
/// `origin`, which begins with the vectors `shared` by all such fits; where that basis does not converge, once more
/// about the model at its end. Without the whole model of the end.
Fit fit(const DiagnosisProblem& problem, const Hypothesis& hypothesis, const Eigen::VectorXd& x, int iterations,
        const Origin& origin, const Vectors& shared);
/// About the model at x, and the whole model in the end.
Fit fit(const DiagnosisProblem& problem, const Hypothesis& hypothesis, const Eigen::VectorXd& x, int iterations);
/// The whole model of the origin, which is that of the hypothesis at x.
Evaluation evaluate(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows, const Hypothesis& hypothesis,
                    const Eigen::VectorXd& x, const Origin& origin);
/// Solves the whole model of its end.
void make_whole(const DiagnosisProblem& problem, Fit& fit);
/// Of each sensor: what all other rows leave of its shape rows, as a sum of squares in standard deviations of that
/// prediction, and how many rows it has. Linearised about the fit.
struct LeftOutSensor {
  double misfit = 0.0;
  int rows = 0;
};
std::vector<LeftOutSensor> leave_out_sensors(const DiagnosisProblem& problem, const Fit& fit);
/// Laplace's approximation about x of ln ∫ exp(−½|r|² − ½|x|²) dx/(2π)^(n/2): of fitted rows r and Jacobian j.
double log_evidence(const Eigen::VectorXd& r, const Eigen::MatrixXd& j, const Eigen::VectorXd& x);
/// Probability that a sum of squares of n standard normal numbers is larger.
double chi_square_tail(double sum, int n);

}  // namespace voussoir
