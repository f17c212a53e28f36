// Tests say what they measured, so that docs/validation.md can be filled from their output.
#pragma once
#include <cstdio>
#include <string>

namespace voussoir::test {

/// Prints one line "measured: what | expected … | got … | error … % | unit". It checks nothing: the test does. Where
/// nothing is expected (a residual, a difference) a percentage would mean nothing and is left out.
inline void measured(const std::string& what, double expected, double got, const std::string& unit) {
  std::printf("measured: %s | expected %.6g | got %.6g |", what.c_str(), expected, got);
  if (expected != 0.0) std::printf(" error %+.2g %% |", 100.0 * (got / expected - 1.0));
  std::printf(" %s\n", unit.c_str());
}

}  // namespace voussoir::test
