// Random number generator of the program. A seed gives the same bits and uniform numbers on every machine. Normal
// numbers use the C library (log, sin, cos) and can differ in their last digits.
#pragma once
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string>

#include "solver/base/constants.h"

namespace voussoir {

/// splitmix64 (Steele, Lea & Flood 2014); normal numbers by the method of Box & Muller (1958).
class RandomStream {
 public:
  explicit RandomStream(std::uint64_t seed) : state_(seed) {}
  std::uint64_t bits() {
    state_ += 0x9e3779b97f4a7c15ULL;
    std::uint64_t z = state_;
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
    return z ^ (z >> 31);
  }
  /// In (0, 1], so that the logarithm exists.
  double uniform() { return (double(bits() >> 11) + 1.0) * 0x1.0p-53; }
  /// In 0 … n − 1, n > 0; uniform within n / 2^64.
  std::size_t below(std::size_t n) { return std::size_t(bits() % n); }
  /// Mean 0, standard deviation 1.
  double normal() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    const double radius = std::sqrt(-2.0 * std::log(uniform())), angle = 2.0 * pi * uniform();
    spare_ = radius * std::sin(angle);
    has_spare_ = true;
    return radius * std::cos(angle);
  }

 private:
  std::uint64_t state_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

/// A separate stream for each seed, purpose and number. The numbers of a stream do not depend on other streams.
RandomStream stream_of(std::uint64_t seed, const std::string& purpose, int number = 0);

}  // namespace voussoir
