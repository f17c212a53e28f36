// Probability that the residuals of a fit are noise.
#pragma once
#include "solver/diagnosis/fit.h"

namespace voussoir {

struct Tail {
  double probability = 1.0;
  std::string of;  // name of the worst rows
};

/// Probability of a misfit at least as large if the model is correct and all standard deviations are a tenth larger.
/// The standard deviations are known only to about a tenth, and with hundreds of rows an error of a tenth would make
/// noise look like an effect. The result is the smaller of the values for all rows and for the worst kind of rows
/// (Bonferroni), so that hundreds of agreeing shape values cannot hide a few wrong frequencies. The scale of each shape
/// is free, and also its phase if the phase is known.
Tail tail(const DiagnosisProblem& problem, const Fit& fit);
/// "a misfit as large has probability 0.02 (frequencies)".
std::string misfit_text(const Tail& tail);

/// Materials that the fit has moved far from their usual values.
std::vector<std::string> alarms_of(const Fit& fit);

}  // namespace voussoir
