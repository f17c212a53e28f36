// Fits a hypothesis to measured features: residuals in standard deviations, priors, Laplace's evidence.
#pragma once
#include "solver/diagnosis/model_family.h"
#include "solver/diagnosis/problem.h"

namespace voussoir {

/// The features of a hypothesis at x.
struct Evaluation {
  Eigen::VectorXd x;
  Assembly assembly;
  LinearModel model;
  Response response;
  Eigen::MatrixXd readings;  // of the sensors, sensor × mode
  ModePairs pairing;
  Eigen::VectorXd differences;  // measured − computed for each row, in the unit of the row
  Eigen::VectorXd residuals;    // the same in independent standard deviations
};
Evaluation evaluate(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows, const Hypothesis& hypothesis,
                    const Eigen::VectorXd& x, EigenMemory& memory);
/// The same in a reduced basis, without the model and its vectors.
Evaluation evaluate(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows, const Hypothesis& hypothesis,
                    const ModelFamily& family, const ModelFamily::Member& member);
/// Derivatives of the residuals, row × parameter.
Eigen::MatrixXd jacobian(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows,
                         const Hypothesis& hypothesis, const ModelFamily& family, const ModelFamily::Member& member,
                         const Evaluation& at);
struct Fit {
  Hypothesis hypothesis;
  Evaluation best;
  Eigen::MatrixXd jacobian;   // at `best`, row × parameter
  Eigen::VectorXd std;        // of x, over the distribution of the scale
  double misfit = 0.0;        // sum of squares of the fitted rows and of x: χ² with one degree of freedom for each
                              // fitted row
  double log_evidence = 0.0;  // summed over the scales, up to a constant that is the same for all fits under one
                              // covariance
  ErrorScale scale;           // mean of its distribution given the data
  int evaluations = 0;
  double basis_error = 0.0;    // estimated error of eigenvalues at the end of the fit
  std::vector<bool> at_bound;  // by parameter
  /// Root mean square residual of the fitted rows, and of the rows that are held back.
  double gap = 0.0, held_gap = 0.0;
  /// Root mean square error of the prediction of each mode from the other modes, in standard deviations of that
  /// prediction (leave one mode out, linearised about the fit).
  double predicted_gap = 0.0;
};

/// Levenberg–Marquardt (Ceres) from x, whose prior is standard normal, within the parameters' bounds. The models are
/// those of a reduced basis about `origin`, which begins with the vectors `shared` by all such fits. If that basis does
/// not converge, the fit is repeated about the model at its end. The full model at the end is not computed.
Fit fit(const DiagnosisProblem& problem, const Hypothesis& hypothesis, const Eigen::VectorXd& x, int iterations,
        const Origin& origin, const Vectors& shared);
/// The same about the model at x, including the full model at the end.
Fit fit(const DiagnosisProblem& problem, const Hypothesis& hypothesis, const Eigen::VectorXd& x, int iterations);
/// The full model of the origin, which is the model of the hypothesis at x.
Evaluation evaluate(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows, const Hypothesis& hypothesis,
                    const Eigen::VectorXd& x, const Origin& origin);
/// Solves the full model at the end of a fit.
void make_whole(const DiagnosisProblem& problem, Fit& fit);
/// Error of the prediction of the shape rows of a sensor from all other rows: the sum of squares in standard deviations
/// of that prediction, and the number of rows. Linearised about the fit.
struct LeftOutSensor {
  double misfit = 0.0;
  int rows = 0;
};
std::vector<LeftOutSensor> leave_out_sensors(const DiagnosisProblem& problem, const Fit& fit);
/// Laplace's approximation about x of ln ∫ exp(−½|r|² − ½|x|²) dx/(2π)^(n/2), where r are the residuals of the fitted
/// rows, j their Jacobian, and n the number of parameters.
double log_evidence(const Eigen::VectorXd& r, const Eigen::MatrixXd& j, const Eigen::VectorXd& x);
/// Probability that a sum of squares of n standard normal numbers is larger, by the approximation of Wilson & Hilferty
/// (1931); 1 for n <= 0.
double chi_square_tail(double sum, int n);

}  // namespace voussoir
