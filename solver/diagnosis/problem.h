// What a diagnosis is to explain, from which model, and by how much a right model may miss it.
#pragma once
#include <memory>

#include "solver/diagnosis/features.h"
#include "solver/diagnosis/mesh_error.h"
#include "solver/diagnosis/model_family.h"
#include "solver/diagnosis/nuisance.h"

namespace voussoir {

/// A row of the residuals: measured less computed, in its own unit.
struct ResidualRow {
  enum class Kind { frequency, shape, damping, quadrature, participation, lag };
  Kind kind = Kind::frequency;
  int mode = 0;      // of the features
  int sensor = 0;    // shape and quadrature; the axis of participation (its real part) and lag (its imaginary part)
  double std = 1.0;  // of the logarithm of a frequency or ratio; a share of the largest component of a shape: of the
                     // measurement and of errors of the model that have no structure
};

/// How much larger than said errors are: by how much a standard deviation is multiplied.
struct ErrorScale {
  double structure = 1.0;  // of the bridge against the model
  double shapes = 1.0;     // of measured shapes, their phases and participation
};

/// Covariance of all rows to first order: C = own + free + structure structureᵀ, each scaled.
struct RowCovariance {
  Eigen::MatrixXd own;        // measurement, mesh, the mixing of near modes
  Eigen::MatrixXd free;       // the scale of each shape (and its phase, where that is known), which nothing is known of
  Eigen::MatrixXd structure;  // row × nuisance: what one standard deviation of each does
  Eigen::VectorXd of_shape;   // 1 for rows that ErrorScale::shapes is of, else 0
  std::vector<Sensitivity> nuisances;
  Eigen::VectorXd std;  // of each row, but for what nothing is known of
  Eigen::MatrixXd at(const ErrorScale& scale) const;
};

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
  std::vector<Nuisance> nuisances;

  // Set by set_covariance().
  RowCovariance covariance;
  ErrorScale scale;  // under which models are fitted
  /// L⁻¹ and L of C = L Lᵀ for that scale, the rows that are fitted before those that are held back: what turns
  /// differences into residuals, and back.
  Eigen::MatrixXd whitening, colouring;
  std::vector<Eigen::MatrixXd>
      shape_metric;  // by measured mode, of the rows of its shape: for the scale that fits best
};

/// Measures what the mesh does with a hypothesis in place (of which this is the response) and sets `error` by it.
/// Leaves both as they are without a coarser mesh, or where the hypothesis cannot act on it.
void set_mesh_error(DiagnosisProblem& problem, const Response& response, const Hypothesis& hypothesis,
                    const Eigen::VectorXd& x);
/// Sets the covariance of all rows about a model, which is that of the hypothesis at x (docs/theory/diagnosis.md).
void set_covariance(DiagnosisProblem& problem, const Origin& origin, const Hypothesis& hypothesis,
                    const Eigen::VectorXd& x, int threads);
/// The same with `plain`: what the sensors of the problem have of the origin's modes, where it was solved for others.
void set_covariance(DiagnosisProblem& problem, const Origin& origin, const Response& plain,
                    const Hypothesis& hypothesis, const Eigen::VectorXd& x, int threads);
/// About the base, which is solved for it.
void set_covariance(DiagnosisProblem& problem);
/// Fits are made under another scale from here on.
void set_scale(DiagnosisProblem& problem, const ErrorScale& scale);

/// All rows of the features, held back ones too.
std::vector<ResidualRow> residual_rows(const DiagnosisProblem& problem);
/// Rows of the modes that are fitted, and of those that are held back.
struct RowSplit {
  std::vector<int> fitted, held;
};
RowSplit split_rows(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows);

/// Which computed mode each measured one is; −1: none is like it.
struct ModePairs {
  std::vector<int> computed;
  std::vector<double> assurance;  // MAC at the sensors; not finite without a shape
};
/// Measured modes with shapes are paired by MAC and frequency, one to one, so that the sum of the costs is least; those
/// with a direction only by their order within it, those without by their order.
ModePairs pair_features(const Features& features, const Response& response, const Eigen::MatrixXd& readings);

/// What models are asked, of which this is a response.
Question question_of(const DiagnosisProblem& problem, const Response& response);

/// Measured − computed by row, each in its own unit. Shapes are scaled to fit best, participation with them.
Eigen::VectorXd differences(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows,
                            const ModePairs& pairing, const Observed& observed);
/// The same in independent standard deviations.
Eigen::VectorXd residuals(const DiagnosisProblem& problem, const std::vector<ResidualRow>& rows,
                          const ModePairs& pairing, const Observed& observed);

/// Modes and what instruments have of them, a step along a derivative.
ModalData along(const ModalData& modes, const ModalData& derivative, double step);

}  // namespace voussoir
