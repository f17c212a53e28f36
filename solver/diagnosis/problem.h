// Input of a diagnosis: measured features, model, and errors of a correct model.
#pragma once
#include <memory>

#include "solver/diagnosis/features.h"
#include "solver/diagnosis/mesh_error.h"
#include "solver/diagnosis/model_family.h"
#include "solver/diagnosis/nuisance.h"

namespace voussoir {

/// A row of the residuals: measured minus computed, in the unit of the row.
struct ResidualRow {
  enum class Kind { frequency, shape, damping, quadrature, participation, lag };
  Kind kind = Kind::frequency;
  int mode = 0;      // of the features
  int sensor = 0;    // shape and quadrature; the axis of participation (its real part) and lag (its imaginary part)
  double std = 1.0;  // of the logarithm of a frequency or ratio, or a share of the largest component of a shape:
                     // measurement errors and model errors without structure
};

/// Factors on the stated standard deviations of the errors.
struct ErrorScale {
  double structure = 1.0;  // of the model errors
  double shapes = 1.0;     // of measured shapes, their phases and participation
};

/// Covariance of all rows to first order: C = own + free + structure structureᵀ. An ErrorScale scales `own` and
/// `structure`, but not `free`.
struct RowCovariance {
  Eigen::MatrixXd own;        // measurement, mesh, the mixing of near modes
  Eigen::MatrixXd free;       // the unknown scale of each shape (and its phase, if the phase is known)
  Eigen::MatrixXd structure;  // row × nuisance: effect of one standard deviation
  Eigen::VectorXd of_shape;   // 1 for rows to which ErrorScale::shapes applies, else 0
  std::vector<Sensitivity> nuisances;
  Eigen::VectorXd std;  // of each row, without the part `free`
  Eigen::MatrixXd at(const ErrorScale& scale) const;
};

struct DiagnosisProblem {
  Assembly base;
  Features features;
  ModelError error;
  /// Model error without the mesh error. `error` includes the mesh error if a coarser mesh is available to estimate it.
  ModelError apart_from_mesh;
  std::shared_ptr<const CoarserMesh> coarser;
  MeshError mesh;
  std::shared_ptr<const Origin> origin;  // of the base; null: it is solved when it is needed
  double damping = 0.0;                  // ratio of the case; 0: it has none
  int modes = 20;                        // to compute
  std::vector<Nuisance> nuisances;

  // Set by set_covariance().
  RowCovariance covariance;
  ErrorScale scale;  // for the fits
  /// L⁻¹ and L of C = L Lᵀ for that scale, with fitted rows before held-back rows. They convert differences to
  /// residuals and back.
  Eigen::MatrixXd whitening, colouring;
  std::vector<Eigen::MatrixXd>
      shape_metric;  // for each measured mode, of the rows of its shape: for the best-fitting scale
};

/// Computes the mesh error with a hypothesis, whose response is given, and sets `error` accordingly. Both are unchanged
/// without a coarser mesh, or if the hypothesis cannot be applied to it.
void set_mesh_error(DiagnosisProblem& problem, const Response& response, const Hypothesis& hypothesis,
                    const Eigen::VectorXd& x);
/// Sets the covariance of all rows about the model of the hypothesis at x (docs/theory/diagnosis.md).
void set_covariance(DiagnosisProblem& problem, const Origin& origin, const Hypothesis& hypothesis,
                    const Eigen::VectorXd& x, int threads);
/// The same if the origin was solved for other sensors: `plain` contains its modes at the sensors of the problem.
void set_covariance(DiagnosisProblem& problem, const Origin& origin, const Response& plain,
                    const Hypothesis& hypothesis, const Eigen::VectorXd& x, int threads);
/// The same about the base, which it solves.
void set_covariance(DiagnosisProblem& problem);
/// Sets the scale for later fits.
void set_scale(DiagnosisProblem& problem, const ErrorScale& scale);

/// All rows of the features, including held-back ones.
std::vector<ResidualRow> residual_rows(const DiagnosisProblem& problem);
/// Rows of the fitted modes, and of the modes that are held back.
struct RowSplit {
  std::vector<int> fitted, held;
};
RowSplit split_rows(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows);

/// The computed mode of each measured mode, or −1 if none is similar.
struct ModePairs {
  std::vector<int> computed;
  std::vector<double> assurance;  // MAC at the sensors; not finite without a shape
};
/// Measured modes with shapes are paired by MAC and frequency, one to one, with the least total cost. Modes with only a
/// direction are paired by their order in this direction, and other modes by their order.
ModePairs pair_features(const Features& features, const Response& response, const Eigen::MatrixXd& readings);

/// The results that models must give, for models with this response.
Question question_of(const DiagnosisProblem& problem, const Response& response);

/// Measured − computed for each row, in the unit of the row. Shapes have their best-fitting scale, and participations
/// have the same scale.
Eigen::VectorXd differences(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows,
                            const ModePairs& pairing, const Observed& observed);
/// The same in independent standard deviations.
Eigen::VectorXd residuals(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows,
                          const ModePairs& pairing, const Observed& observed);

/// Modes and their values at the instruments after a step along a derivative.
ModalData along(const ModalData& modes, const ModalData& derivative, double step);

}  // namespace voussoir
