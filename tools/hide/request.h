// The request of voussoir hide.
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
  std::string sensors = "sparse";  // sparse, rich, none, a number of channels, or a file like measured/sensors.csv
  std::vector<EffectSetting> effects;
  std::vector<Loosening> loosenings;                       // changes outside the library of effects
  std::vector<std::pair<std::string, std::string>> truth;  // generator keys with other values in the true bridge
  double noise = 0.01;                                     // relative standard deviation of periods
  double noise_said = 1.0;                                 // stated standard deviations divided by the true ones
  double scatter = 0.05;                                   // standard deviation of ln stiffness of each part
  double materials = 0.1;                                  // standard deviation of ln stiffness of each material
  double defects = 0.01;                                   // m, standard deviation of each dimension
  double mesh = 0.85;                                      // block_scale of the true bridge divided by that of the case
  int parapet_gaps = 0;  // movement joints in the parapets that the case does not have
  int modes = 6;
  double minutes = 0.0;  // min, duration of ambient vibration that replaces modes; 0: none
  double shaken = 0.0;   // s, duration of a recorded ground motion that replaces modes; 0: none
  bool trace = false;    // compute how much of the effects the modes show
  std::uint64_t seed = 1;
};

/// The random stream for one purpose, such as "dimension width" or "noise of channel A01x". Further streams or missing
/// ones do not change the others.
inline RandomStream stream_of(const HideRequest& request, const std::string& purpose, int number = 0) {
  return stream_of(request.seed, "hide: " + purpose, number);
}

}  // namespace voussoir
