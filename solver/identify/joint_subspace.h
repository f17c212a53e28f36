// One model of several setups that share reference channels: merging before the identification (PreGER;
// docs/theory/identification.md).
#pragma once
#include "solver/identify/subspace.h"

namespace voussoir {

/// Contribution of a setup to the joint model.
struct JointPart {
  const Eigen::MatrixXd& covariances;      // of its channels with the references, as in Subspace
  const Eigen::MatrixXd& past;             // its canonical weights
  const std::vector<int>& references;      // its channels that all setups have, in the same order in each setup
  const std::vector<int>& moved;           // the rest of its channels
  const std::vector<Eigen::Index>& whole;  // for each channel of the setup: its number among all channels
};

/// The observability matrix over the channels of all setups, in one basis (Mevel, Basseville, Benveniste & Goursat
/// 2002; Döhler & Mevel 2012). The excitation may differ between the setups, but the structure must be the same.
class JointSubspace {
 public:
  /// The covariances have at least 2 `block_rows` − 1 lags. `future`: canonical weights of the references over all
  /// setups; `channels`: number of all channels.
  JointSubspace(const std::vector<JointPart>& parts, const Eigen::MatrixXd& future, Eigen::Index channels,
                int block_rows, int largest_order);
  /// As Subspace::poles(), with shapes over all channels.
  std::vector<Pole> poles(int order, double dt, double highest, const Eigen::VectorXd& scale) const;
  int largest_order() const { return int(references_.rows.cols()); }

 private:
  /// Rows of the observability matrix, block row by block row, for a set of channels.
  struct Rows {
    Eigen::MatrixXd rows;             // (block rows · channels) × largest order
    Eigen::MatrixXd share;            // Gram matrix of the setup's part of the right singular vectors
    std::vector<Eigen::Index> whole;  // numbers of the channels among all
  };
  Eigen::MatrixXd at_order(const Rows& moved, int order) const;

  int block_rows_;
  Eigen::Index channels_;
  Eigen::VectorXd singular_;
  Rows references_;
  std::vector<Rows> moved_;
};

}  // namespace voussoir
