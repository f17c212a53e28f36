// Random numbers of the program's own, so that a seed means the same everywhere: splitmix64 (Steele, Lea & Flood 2014).
#pragma once
#include <cmath>
#include <cstdint>
#include <numbers>

namespace voussoir {

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

  /// In (0, 1]: the logarithm must exist.
  double uniform() { return (double(bits() >> 11) + 1.0) * 0x1.0p-53; }

  /// One of 0 … count − 1; uneven by less than count/2⁶⁴.
  std::uint64_t below(std::uint64_t count) { return bits() % count; }

  /// Standard normal, by the method of Box & Muller (1958).
  double normal() {
    if (has_spare_) {
      has_spare_ = false;
      return spare_;
    }
    const double radius = std::sqrt(-2.0 * std::log(uniform())), angle = 2.0 * std::numbers::pi * uniform();
    spare_ = radius * std::sin(angle);
    has_spare_ = true;
    return radius * std::cos(angle);
  }

 private:
  std::uint64_t state_;
  double spare_ = 0.0;
  bool has_spare_ = false;
};

}  // namespace voussoir
