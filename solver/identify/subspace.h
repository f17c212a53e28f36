// Poles of a linear system from the covariances of its responses: covariance-driven stochastic subspace identification
// with reference channels (Peeters & De Roeck 1999; docs/theory/identification.md).
#pragma once
#include <Eigen/Dense>
#include <complex>
#include <vector>

namespace voussoir {

/// Sums of products of the signals with those of the reference channels, for each segment of the recordings.
struct LaggedProducts {
  int lags = 0;
  std::vector<double> samples;  // for each segment: number of products in each sum
  std::vector<Eigen::MatrixXd>
      sums;  // per segment: block row k − 1 is Σ y(t + k) yref(t)ᵀ; (lags · channels) × references
};

/// The signals (samples × channels, one matrix for each recording) are divided into about `segments` parts of similar
/// length, at least one for each recording. Recordings that are not longer than the lags give none.
LaggedProducts lagged_products(const std::vector<Eigen::MatrixXd>& signals, const std::vector<int>& references,
                               int lags, int segments);

/// Covariances over all segments except those left out (one flag for each segment; empty: none).
Eigen::MatrixXd covariances(const LaggedProducts& products, const std::vector<bool>& left_out = {});

/// Canonical weights: Cholesky factors (lower) of the covariance of block_rows successive samples of all channels, and
/// of the references, each with 0.001 added to the diagonal.
struct CanonicalWeights {
  Eigen::MatrixXd future, past;
};
/// The signals must be scaled to a variance of 1.
CanonicalWeights canonical_weights(const std::vector<Eigen::MatrixXd>& signals, const std::vector<int>& references,
                                   int block_rows);

struct Pole {
  int order = 0;                  // of the model
  std::complex<double> lambda;    // 1/s, imaginary part above 0
  Eigen::VectorXcd shape;         // for each used channel, largest component 1
  bool stable_frequency = false;  // relative to the nearest pole of the previous order
  bool stable_damping = false;
  bool stable_shape = false;
  double frequency() const;  // Hz, |λ| / 2π
  double damping() const;    // ratio, −Re λ / |λ|
  bool stable() const { return stable_frequency && stable_damping && stable_shape; }
};

/// Poles of the system whose observability matrix has the block rows C Aⁱ of `channels` channels: A from `transition`
/// (order × order), C its first block row. Returns the poles with an imaginary part above 0 and up to `highest` (Hz),
/// ascending in frequency. Shapes are multiplied by `scale` (for each channel).
std::vector<Pole> poles_of(const Eigen::MatrixXd& transition, const Eigen::MatrixXd& first, double dt, double highest,
                           const Eigen::VectorXd& scale);

/// Block (i, j) is the covariance of lag i + j + 1 of `channels` channels.
Eigen::MatrixXd hankel(const Eigen::MatrixXd& covariances, int channels, int block_rows);

/// The column space of the weighted block Hankel matrix of covariances; poles at any even order up to the largest.
class Subspace {
 public:
  /// `covariances` as above with at least 2 `block_rows` − 1 lags of `channels` channels.
  Subspace(const Eigen::MatrixXd& covariances, const CanonicalWeights& weights, int channels, int block_rows,
           int largest_order);
  /// The poles with an imaginary part above 0 and up to `highest` (Hz), ascending in frequency. Shapes are multiplied
  /// by `scale` (for each channel).
  std::vector<Pole> poles(int order, double dt, double highest, const Eigen::VectorXd& scale) const;
  int largest_order() const { return int(shifted_.cols()); }

 private:
  Eigen::MatrixXd triangle_;  // R of the QR of the space without its last block row
  Eigen::MatrixXd shifted_;   // Qᵀ times the space without its first block row
  Eigen::MatrixXd first_;     // its first block row
};

/// Modal assurance criterion |aᴴ b|² / (aᴴ a)(bᴴ b) (Allemang 2003, eq. 4).
double assurance(const Eigen::VectorXcd& a, const Eigen::VectorXcd& b);

/// |λ_a − λ_b| / max(|λ_a|, |λ_b|) + 1 − MAC (Reynders, Houbrechts & De Roeck 2012).
double distance(const Pole& a, const Pole& b);

/// Index of the pole nearest to `pole`, or −1 if there is none.
int nearest(const std::vector<Pole>& poles, const Pole& pole);

/// Index of the pole with the least sum of distances to the others, or −1 if there is none.
int medoid(const std::vector<Pole>& poles);

/// Scales a shape so that its largest component is 1.
void normalise(Eigen::VectorXcd& shape);

}  // namespace voussoir
