// Recordings of one setup, ready for subspace identification. Private to solver/identify.
#pragma once
#include "solver/identify/ssi.h"

namespace voussoir {

/// All that the models of one set of recordings share.
struct SsiProblem {
  Prepared prepared;
  std::vector<int> references;  // columns of the signals
  Eigen::VectorXd scale;        // m/s2 per channel in use: the signals are divided by it
  LaggedProducts products;
  CanonicalWeights weights;
  SsiSettings settings;
  std::vector<ShortRecording> too_short;
  Subspace subspace(const std::vector<bool>& left_out = {}) const;
};

/// Throws InputError as identify_modes() does.
SsiProblem set_up(const std::vector<Recording>& recordings, const SsiSettings& settings);

/// Half a period of the lowest frequency (Reynders & De Roeck 2008), enough for an order with so many references, and
/// no more than is quick for Hankel matrices of `rows` channels and `columns` references.
int usual_block_rows(const SsiSettings& settings, double dt, int references, int rows, int columns);

/// That recordings of this length allow.
int most_block_rows(const Prepared& prepared);

/// What a result says of its recordings, without modes.
SsiResult described(const SsiProblem& problem);

/// Kurtosis and stops of a mode with a shape over the channels in use.
void listen(const Prepared& prepared, IdentifiedMode& mode);

}  // namespace voussoir
