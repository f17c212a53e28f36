// Prepared recordings of one setup for subspace identification. Private to solver/identify.
#pragma once
#include "solver/identify/ssi.h"

namespace voussoir {

/// Common data of the models of one set of recordings.
struct SsiProblem {
  Prepared prepared;
  std::vector<int> references;  // columns of the signals
  Eigen::VectorXd scale;        // m/s2 for each used channel: the signals are divided by it
  LaggedProducts products;
  CanonicalWeights weights;
  SsiSettings settings;
  std::vector<ShortRecording> too_short;
  Subspace subspace(const std::vector<bool>& left_out = {}) const;
};

/// Throws InputError as identify_modes().
SsiProblem set_up(const std::vector<Recording>& recordings, const SsiSettings& settings);

/// Default number of block rows: half a period of the lowest frequency (Reynders & De Roeck 2008), enough for the order
/// with this number of references, and limited so that Hankel matrices of `rows` channels and `columns` references are
/// fast.
int usual_block_rows(const SsiSettings& settings, double dt, int references, int rows, int columns);

/// Largest number of block rows for the length of these recordings.
int most_block_rows(const Prepared& prepared);

/// The result for the recordings, without modes.
SsiResult described(const SsiProblem& problem);

/// Computes kurtosis and stops of a mode with a shape over the used channels.
void listen(const Prepared& prepared, IdentifiedMode& mode);

}  // namespace voussoir
