// All models of one hypothesis near a solved model, in one reduced basis. Fits and screening use them without a matrix
// factorisation for each model.
#pragma once
#include "solver/diagnosis/hypothesis.h"
#include "solver/diagnosis/reduced_model.h"

namespace voussoir {

/// Results that a diagnosis needs from each model.
struct Question {
  std::vector<Sensor> sensors;
  int modes = 20;       // number of modes
  int wanted = 12;      // the lowest of them must be accurate
  bool driven = false;  // including the response to the motion of the ground
};

/// For use in one thread.
class ModelFamily {
 public:
  /// `often`: models at many x will be needed, so units that change by the same factor are projected once. The origin
  /// is a model of `base`; both must outlive the family at the same address.
  enum class Use { once, often };
  ModelFamily(const Origin& origin, const Assembly& base, const Hypothesis& hypothesis, const Question& question,
              const Eigen::VectorXd& x, Use use);

  /// Forces of the motion of the ground along the basis, one row for each axis.
  struct GroundRows {
    Eigen::MatrixXd inertia;            // (M r)ᵀ V
    std::vector<Eigen::MatrixXd> pull;  // of each support
  };
  /// A model of the family.
  struct Member {
    Eigen::VectorXd x;
    ReducedModel::Matrices matrices;
    GroundRows ground;  // if requested
    ReducedModes modes;
  };
  /// Throws InputError where an effect cannot act.
  Member member(const Eigen::VectorXd& x) const;
  /// Without vectors over the unknowns.
  Response response(const Member& member) const;
  /// Derivatives of the lowest modes with respect to the x with that index: λ′ = φᵀ (K′ − λ M′) φ (Fox and Kapoor 1968,
  /// eq. 8), φ′ by all modes of the basis.
  ModalData derivative(const Member& member, Eigen::Index index) const;
  /// Adds vectors until the wanted modes of this model are accurate to `tolerance` in λ, in at most eight rounds.
  /// Returns the estimated error before the last of them.
  double converge(const Eigen::VectorXd& x, double tolerance);
  /// One round; returns the estimated error before it.
  double refine(const Eigen::VectorXd& x);
  /// Adds vectors over the unknowns of the origin that other families also have.
  void append(const Vectors& more);

 private:
  ReducedModel reduced_model(const Eigen::VectorXd& x, Use use) const;
  void project_sensors();
  const Assembly& assembly_at(const Eigen::VectorXd& x) const;
  Change change_at(const Eigen::VectorXd& x) const;
  /// The member without its modes.
  Member without_modes(const Eigen::VectorXd& x) const;

  const Origin* origin_;
  const Assembly* base_;
  const Hypothesis hypothesis_;
  Question question_;
  std::shared_ptr<Assembly> copy_;  // of the base, with the changes of the last request
  ReducedModel reduced_;
  Eigen::MatrixXd seen_, motions_;  // sensors × basis; three rows for each sensor × basis
};

/// Static response of the origin to the change of the residual forces of its wanted modes with each material. Every
/// family that fits materials needs these vectors.
Vectors material_vectors(const Origin& origin, const Assembly& base, const Hypothesis& materials,
                         const Eigen::VectorXd& x, int wanted);

}  // namespace voussoir
