// The blind suite: cases with something hidden in their measurements, and what a diagnosis should say of each.
#pragma once
#include <string>
#include <vector>

namespace voussoir {

struct BlindTrial {
  std::string bridge, sensors;       // "cs1"; sparse, rich, none
  double noise = 0.01;               // of periods; shapes twice that
  std::vector<std::string> effects;  // as hide takes them; empty: nothing is hidden
  std::string without;               // effects that diagnose may not try: it should end unexplained
  std::string where;                 // then: what the place it gives should contain
};
const std::vector<BlindTrial>& blind_trials();

}  // namespace voussoir
