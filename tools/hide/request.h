// What voussoir hide is asked for.
#pragma once
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "solver/base/random.h"
#include "solver/effects/effect.h"
#include "tools/hide/loosening.h"

namespace voussoir {

struct HideRequest {
  std::string case_file, directory;
  std::string sensors = "sparse";  // or rich, none, a number of channels, or a file like measured/sensors.csv
  std::vector<EffectSetting> effects;
  std::vector<Loosening> loosenings;                       // changes that no effect makes
  std::vector<std::pair<std::string, std::string>> truth;  // keys of the generator that the true bridge has otherwise
  double noise = 0.01;                                     // standard deviation of periods, share
  double noise_said = 1.0;                                 // deviations as written, over the true ones
  double scatter = 0.05;                                   // of the stiffness of each part, of the logarithm
  double materials = 0.1;                                  // of the stiffness of each material, of the logarithm
  double defects = 0.01;                                   // m, of every dimension
  double mesh = 0.85;                                      // block_scale of the true bridge over the case's
  int parapet_gaps = 0;                                    // joints in the parapets that the case does not have
  int modes = 6;
  double minutes = 0.0;  // of ambient vibration instead of modes
  double shaken = 0.0;   // s of a recorded motion of the ground instead of modes
  bool trace = false;    // say how much of the effects shows
  std::uint64_t seed = 1;
};

/// Random numbers of one purpose: "dimension width", "noise of channel A01x". A further one, or one that is left out,
/// changes none of the others.
inline RandomStream stream_of(const HideRequest& request, const std::string& purpose, int number = 0) {
  return stream_of(request.seed, "hide: " + purpose, number);
}

}  // namespace voussoir
