// How likely it is that what a fit leaves is noise.
#pragma once
#include "solver/diagnosis/fit.h"

namespace voussoir {

struct Tail {
  double probability = 1.0;
  std::string of;  // the rows that are worst
};

/// Probability of a misfit at least as large if the model were right and all standard deviations a tenth larger: with
/// hundreds of rows a tenth would make noise look like an effect. Of all rows, or of the kind of rows that is worst
/// (Bonferroni): hundreds of shape values that agree do not excuse a few frequencies that do not. The scale of each
/// shape is free, and its phase where that is known.
Tail tail(const DiagnosisProblem& problem, const Fit& fit);
/// "a misfit as large has probability 0.02 (frequencies)".
std::string misfit_text(const Tail& tail);

/// Materials that the fit has pulled farther than their priors like.
std::vector<std::string> alarms_of(const Fit& fit);

}  // namespace voussoir
