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
  double minutes = 0.0;              // of ambient vibration that is recorded instead of modes
  double shaken = 0.0;               // s of an earthquake, recorded on the ground too
};
const std::vector<BlindTrial>& blind_trials();

}  // namespace voussoir
