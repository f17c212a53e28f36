// Where in the bridge a model disagrees with the measured modes.
#pragma once
#include "solver/diagnosis/fit.h"

namespace voussoir {

/// How much of what is missing sits in a part of the bridge.
struct PartResidual {
  std::string part;    // "arch 0", "pier 1", "abutment left", "spandrel y-", "backing", "backfill", …
  double share = 0.0;  // of the energy of the correcting displacements
  char axis = 'x';     // along which the residual force does most work
};

struct Location {
  std::vector<PartResidual> parts;  // largest first
  std::vector<double> blocks;       // energy by block, the largest 1
  double size = 0.0;                // energy of the corrections over that of the modes: 0.01 is about 10 % in λ
};

/// The dynamic force residual f = (K − ω²M) φ of each measured mode expanded over the model's modes, and the energy of
/// u = K⁻¹ f, joint by joint (minimum dynamic residual expansion: Balmès 2000, §4). A mode without a shape is the
/// computed one that it is paired with.
Location locate(const DiagnosisProblem& problem, const Evaluation& at);

/// The sensitivity of a mode's frequency to the stiffness and the mass of each part: d ln f/d ln k and d ln f/d ln m.
struct PartSensitivity {
  std::string part;
  double stiffness = 0.0, mass = 0.0;
};
std::vector<PartSensitivity> sensitivities(const Evaluation& at, int mode);

}  // namespace voussoir
