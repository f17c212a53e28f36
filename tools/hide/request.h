// What voussoir hide is asked for, and its random numbers.
#pragma once
#include <random>

#include "solver/effects/effect.h"

namespace voussoir {

struct HideRequest {
  std::string case_file, directory, sensors = "sparse";
  std::vector<EffectSetting> effects;
  double noise = 0.01;     // standard deviation of periods, share
  double scatter = 0.05;   // of the stiffness of each part, of the logarithm
  double materials = 0.1;  // of the stiffness of each material, of the logarithm
  double defects = 0.01;   // m, of every dimension
  double mesh = 0.85;      // block_scale of the true bridge over the case's
  int modes = 6;
  double minutes = 0.0;  // of ambient vibration instead of modes
  double shaken = 0.0;   // s of a recorded motion of the ground instead of modes
  bool trace = false;    // say how much of the effects shows
  std::uint64_t seed = 1;
};

/// The same numbers everywhere: std's distributions differ between libraries.
class Noise {
 public:
  explicit Noise(std::uint64_t seed, double size = 1.0) : bits_(seed), size_(size) {}
  double normal() {  // Box and Muller (1958)
    const double u = (double(bits_() >> 11) + 0.5) * 0x1p-53, v = (double(bits_() >> 11) + 0.5) * 0x1p-53;
    return size_ * std::sqrt(-2.0 * std::log(u)) * std::cos(2.0 * EIGEN_PI * v);
  }

 private:
  std::mt19937_64 bits_;
  double size_ = 1.0;
};

}  // namespace voussoir
