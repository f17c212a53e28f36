// Locates the parts of the bridge in which a model disagrees with the measured modes.
#pragma once
#include "solver/diagnosis/fit.h"

namespace voussoir {

/// Share of the disagreement in a part of the bridge.
struct PartResidual {
  std::string part;    // "arch 0", "pier 1", "abutment left", "spandrel y-", "backing", "backfill", …
  double share = 0.0;  // share of the energy of the correcting displacements
  char axis = 'x';     // axis along which the residual force does most work
};

struct Location {
  std::vector<PartResidual> parts;  // largest first
  std::vector<double> blocks;       // energy by block, the largest 1
  double size = 0.0;                // energy of the corrections over that of the modes: 0.01 is about 10 % in ω²
};

/// The dynamic force residual f = (K − ω²M) φ of each measured mode expanded over the model's modes, and the energy of
/// u = K⁻¹ f, joint by joint (minimum dynamic residual expansion: Balmès 2000, §4). For a mode without a shape, the
/// paired computed mode is used.
Location locate(const DiagnosisProblem& problem, const Evaluation& at);

/// Sensitivity of the frequency of a mode to the stiffness and mass of each part: d ln f/d ln k and d ln f/d ln m.
struct PartSensitivity {
  std::string part;
  double stiffness = 0.0, mass = 0.0;
};
std::vector<PartSensitivity> sensitivities(const Evaluation& at, int mode);

}  // namespace voussoir
