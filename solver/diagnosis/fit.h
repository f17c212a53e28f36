// Fitting a hypothesis to measured features: residuals in standard deviations, priors, Laplace's evidence.
#pragma once
#include <memory>

#include "solver/diagnosis/features.h"
#include "solver/diagnosis/mesh_error.h"
#include "solver/diagnosis/model_family.h"

namespace voussoir {

/// What is to be explained, and from which model.
struct DiagnosisProblem {
  Assembly base;
  Features features;
  ModelError error;
  /// What the model would be wrong by if its mesh were perfect; `error` has the mesh's beside it where a coarser one is
  /// there to measure it by.
  ModelError apart_from_mesh;
  std::shared_ptr<const CoarserMesh> coarser;
  MeshError mesh;
  std::shared_ptr<const Origin> origin;  // of the base; null: it is solved where it is needed
  double damping = 0.0;                  // ratio of the case; 0: it has none
  int modes = 20;                        // to compute
  /// By measured mode: what turns the differences of its shape, in the order of its rows, into independent ones of
  /// standard deviation 1. Empty: no shape.
  std::vector<Eigen::MatrixXd> whitening;
  /// By measured mode: what close neighbours may add to the imaginary parts of its shape, per sensor, and to its
  /// participation, per axis, as shares of the largest component of the shape.
  std::vector<Eigen::VectorXd> quadrature_mixing;
  std::vector<Eigen::Vector3d> participation_mixing;
};
/// Measures what the mesh does with a hypothesis in place (of which this is the response) and sets `error` by it.
/// Leaves both as they are without a coarser mesh, or where the hypothesis cannot act on it.
void set_mesh_error(DiagnosisProblem& problem, const Response& response, const Hypothesis& hypothesis,
                    const Eigen::VectorXd& x);
/// Fills in `whitening`. Errors of the model mix a mode with its neighbours; what the measurement and the mesh do is
/// independent from sensor to sensor (docs/theory/diagnosis.md).
void set_shape_errors(DiagnosisProblem& problem);
/// The same about a model that has other modes than the base.
void set_shape_errors(DiagnosisProblem& problem, const Response& response);

/// Which computed mode each measured one is; −1: none is like it.
struct ModePairs {
  std::vector<int> computed;
  std::vector<double> assurance;  // MAC at the sensors; not finite without a shape
};

/// A row of the residuals.
struct ResidualRow {
  enum class Kind { frequency, shape, damping, quadrature, participation, lag };
  Kind kind = Kind::frequency;
  int mode = 0;      // of the features
  int sensor = 0;    // shape and quadrature; the axis of participation (its real part) and lag (its imaginary part)
  double std = 1.0;  // of the logarithm of a frequency or ratio; a share of the largest component of a shape
};
/// All rows of the features, held back ones too, and their standard deviations: of measurement and model together.
std::vector<ResidualRow> residual_rows(const DiagnosisProblem& problem);

/// Measured modes with shapes are paired by MAC and frequency, one to one, so that the sum of the costs is least; those
/// with a direction only by their order within it, those without by their order.
ModePairs pair_features(const Features& features, const Response& response, const Eigen::MatrixXd& readings);

/// (measured − computed)/std by row. Shapes are scaled to fit best, participation with them.
Eigen::VectorXd residuals(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows,
                          const ModePairs& pairing, const Observed& observed);

/// What a hypothesis makes of the features at x.
struct Evaluation {
  Eigen::VectorXd x;
  Assembly assembly;
  LinearModel model;
  Response response;
  Eigen::MatrixXd readings;  // of the sensors, sensor × mode
  ModePairs pairing;
  Eigen::VectorXd residuals;  // (measured − computed)/std, by row
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
/// What its models are asked, of which this is a response.
Question question_of(const DiagnosisProblem& problem, const Response& response);

struct Fit {
  Hypothesis hypothesis;
  Evaluation best;
  Eigen::MatrixXd jacobian;   // there, row × parameter
  Eigen::VectorXd std;        // of x: of the fit, or of leaving each mode out where that is more
  double misfit = 0.0;        // sum of squares of the fitted rows and of x: χ² of as many degrees as fitted rows
  double log_evidence = 0.0;  // up to a constant that is the same for all fits to the same rows
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
/// Laplace's approximation about x of ln ∫ exp(−½|r|² − ½|x|²) dx/(2π)^(n/2): of fitted rows r and Jacobian j.
double log_evidence(const Eigen::VectorXd& r, const Eigen::MatrixXd& j, const Eigen::VectorXd& x);
/// Probability that a sum of squares of n standard normal numbers is larger.
double chi_square_tail(double sum, int n);

}  // namespace voussoir
