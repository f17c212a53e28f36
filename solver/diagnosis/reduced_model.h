// Models that differ from a model with known modes, in a basis of few vectors: its modes, and its static response to
// the residual forces of these modes in a changed model (docs/theory/diagnosis.md).
#pragma once
#include <memory>
#include <mutex>

#include "solver/diagnosis/model_change.h"
#include "solver/diagnosis/response.h"

namespace voussoir {

/// A model with known modes and factorisation, and the contributions of its parts to K and M. Several threads may use
/// it at the same time.
class Origin {
 public:
  /// Computes the lowest modes as response() does. Throws InputError if no joint holds anything.
  Origin(const Assembly& assembly, const std::vector<Sensor>& sensors, int modes, bool driven = false);
  Origin(const Origin&) = delete;

  const Assembly& assembly() const { return assembly_; }
  const LinearModel& model() const { return model_; }
  const Response& response() const { return response_; }
  const Contributions& parts() const { return parts_; }
  /// M times the vector of each mode.
  const Vectors& momenta() const { return momenta_; }
  /// (K − σ M)⁻¹ F over the origin's unknowns, further rows zero; σ is negligible against all eigenvalues.
  Vectors static_response(const Vectors& forces) const;
  double shift() const { return response_.shift; }  // rad2/s2, σ
  /// A copy of the base that effects may change while the pointer is held. Copies are reused for the same base because
  /// copying all cells of all blocks takes longer than changing them.
  std::shared_ptr<Assembly> copy_of(const Assembly& base) const;

 private:
  Assembly assembly_;
  Contributions parts_;
  LinearModel model_;
  EigenMemory memory_;
  Response response_;
  Vectors momenta_;
  struct Copies {
    std::mutex one_at_a_time;
    const Assembly* base = nullptr;
    std::vector<std::unique_ptr<Assembly>> free;
  };
  std::shared_ptr<Copies> copies_ = std::make_shared<Copies>();  // outlives the origin while a copy is held
};

/// Modes in a basis: λ ascending; one column of q for each mode, qᵀ (Vᵀ M V) q = 1.
struct ReducedModes {
  Eigen::VectorXd eigenvalues;  // rad2/s2
  Eigen::MatrixXd q;
};

/// A basis for models of one kind. Every vector needs one projection of each class.
class ReducedModel {
 public:
  /// Begins with the modes of the origin and with unit motions of the blocks that move only in `changed`. Without
  /// classes, all changes are in Change::others, which is suitable for a model that is used once.
  ReducedModel(const Origin& origin, const Assembly& changed, Classes classes);

  auto basis() const { return v_.leftCols(count_); }
  const Unknowns& unknowns() const { return unknowns_; }
  const Classes& classes() const { return classes_; }

  /// Vᵀ K V and Vᵀ M V of a changed model.
  struct Matrices {
    Eigen::MatrixXd k, m;
  };
  Matrices matrices(const Change& change) const;
  /// As many modes as the basis has independent vectors.
  ReducedModes modes(const Matrices& matrices) const;

  /// Adds the static response w of the origin to the residual forces f = λ M y − K y of the lowest `wanted` modes of a
  /// changed model. Returns the largest w · f / λ: an estimate of the relative error of the previous eigenvalues.
  double refine(const Change& change, int wanted);
  /// Repeats refine() until the estimate is below `tolerance`, at most `most` times. Modes far below the tolerance are
  /// skipped. Returns the last estimate.
  double converge(const Change& change, int wanted, double tolerance, int most);
  void append(const Vectors& more) { append(more, nullptr, nullptr); }

  /// φⱼᵀ M₀ y of the modes of the origin (rows) and the lowest `count` of the given modes.
  Eigen::MatrixXd along_origin(const ReducedModes& modes, Eigen::Index count) const;
  /// The lowest `count` modes over the unknowns.
  Eigen::MatrixXd vectors(const ReducedModes& modes, Eigen::Index count) const;
  /// K X and M X of a changed model.
  Vectors times_stiffness(const Change& change, const Vectors& x) const;
  Vectors times_mass(const Change& change, const Vectors& x) const;

 private:
  struct Projected {
    Eigen::MatrixXd whole;                 // of the origin
    std::vector<Eigen::MatrixXd> classes;  // of the origin's part of each
    std::vector<bool> wide;                // classes with so many rows that selecting them is not worthwhile
  };
  /// Refined modes with their estimated errors w · f / λ.
  struct Worked {
    std::vector<Eigen::Index> modes;
    Eigen::VectorXd errors;
    double most() const { return errors.size() > 0 ? errors.maxCoeff() : 0.0; }
  };
  Eigen::MatrixXd sum(const Projected& p, const std::vector<double>& factors) const;
  Worked refine(const Change& change, const ReducedModes& found, std::vector<Eigen::Index> which);
  /// `stiffness`, `momenta`: products with K₀ and M₀, if they are known.
  void append(const Vectors& more, const Vectors* stiffness, const Vectors* momenta);

  const Origin* origin_;
  Classes classes_;
  Unknowns unknowns_;
  Vectors v_;  // the basis, with room for more
  Eigen::Index count_ = 0;
  Projected k_, m_;
};

}  // namespace voussoir
