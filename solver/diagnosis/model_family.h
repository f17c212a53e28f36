// All models of one hypothesis near a model that is solved, in one basis: what fits and screening ask for, without a
// factor of their own.
#pragma once
#include "solver/diagnosis/hypothesis.h"
#include "solver/diagnosis/reduced_model.h"

namespace voussoir {

/// What all models of a diagnosis are asked.
struct Question {
  std::vector<Sensor> sensors;
  int modes = 20;       // to be told of
  int wanted = 12;      // the lowest of them must be right
  bool driven = false;  // with what the ground's motion does
};

/// For one thread.
class ModelFamily {
 public:
  /// Whether models at many x will be asked for: then what changes alike is projected once. The origin is a model of
  /// `base`; both must stay where they are.
  enum class Use { once, often };
  ModelFamily(const Origin& origin, const Assembly& base, const Hypothesis& hypothesis, const Question& question,
              const Eigen::VectorXd& x, Use use);

  /// Forces of the ground's motion along the basis, a row an axis.
  struct GroundRows {
    Eigen::MatrixXd inertia;            // (M r)ᵀ V
    std::vector<Eigen::MatrixXd> pull;  // of each support
  };
  /// A model of the family.
  struct Member {
    Eigen::VectorXd x;
    ReducedModel::Matrices matrices;
    GroundRows ground;  // where that is asked for
    ReducedModes modes;
  };
  /// Throws InputError where an effect cannot act.
  Member member(const Eigen::VectorXd& x) const;
  /// Without vectors over the unknowns.
  Response response(const Member& member) const;
  /// Of the lowest modes, by the x with that index: λ′ = φᵀ (K′ − λ M′) φ (Fox and Kapoor 1968, eq. 8), φ′ by all modes
  /// of the basis.
  ModalData derivative(const Member& member, Eigen::Index index) const;
  /// Adds vectors until the wanted modes of this model are right within `tolerance` of λ, in at most eight rounds.
  /// Returns the estimated error before the last of them.
  double converge(const Eigen::VectorXd& x, double tolerance);
  /// One round; returns the estimated error before it.
  double refine(const Eigen::VectorXd& x);
  /// Vectors over the origin's unknowns that other families have too.
  void append(const Vectors& more);

 private:
  ReducedModel reduced_model(const Eigen::VectorXd& x, Use use) const;
  void project_sensors();
  const Assembly& assembly_at(const Eigen::VectorXd& x) const;
  Change change_at(const Eigen::VectorXd& x) const;
  /// All but the modes.
  Member without_modes(const Eigen::VectorXd& x) const;

  const Origin* origin_;
  const Assembly* base_;
  const Hypothesis hypothesis_;
  Question question_;
  std::shared_ptr<Assembly> copy_;  // of the base, with what was asked for last
  ReducedModel reduced_;
  Eigen::MatrixXd seen_, motions_;  // sensors × basis; three rows a sensor × basis
};

/// The origin's static response to the change of its wanted modes' residual forces with each material: what every
/// family that fits materials needs.
Vectors material_vectors(const Origin& origin, const Assembly& base, const Hypothesis& materials,
                         const Eigen::VectorXd& x, int wanted);

}  // namespace voussoir
