#include "tools/campaign/sample.h"

#include <cmath>
#include <numbers>

#include "solver/base/arrays.h"
#include "solver/base/error.h"

namespace voussoir::campaign {

namespace {

constexpr int most_tries = 10000;

/// splitmix64 (Steele, Lea & Flood 2014).
std::uint64_t next(std::uint64_t& state) {
  std::uint64_t z = (state += 0x9e3779b97f4a7c15ULL);
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return z ^ (z >> 31);
}

/// In (0, 1]: the logarithm must exist.
double uniform(std::uint64_t& state) {
  return (double(next(state) >> 11) + 1.0) * 0x1.0p-53;
}

/// Standard normal (Box & Muller 1958).
double normal(std::uint64_t& state) {
  const double radius = std::sqrt(-2.0 * std::log(uniform(state)));
  return radius * std::cos(2.0 * std::numbers::pi * uniform(state));
}

/// A stream of its own for each seed, variable and sample.
std::uint64_t stream(std::uint64_t seed, const std::string& name, int number) {
  std::uint64_t state = hash_bytes(name.data(), name.size(), next(seed));
  for (int part : {0, number}) state = next(state) ^ std::uint64_t(part);
  return next(state);
}

double draw_once(const Sampled& s, double mean, double deviation, std::uint64_t& state) {
  switch (s.distribution) {
    case Sampled::Distribution::lognormal: {
      const double cov = deviation / mean, variance = std::log1p(cov * cov);
      return std::exp(std::log(mean) - 0.5 * variance + std::sqrt(variance) * normal(state));
    }
    case Sampled::Distribution::normal:
      return mean + deviation * normal(state);
    case Sampled::Distribution::uniform:
      break;
  }
  const double half = std::sqrt(3.0) * deviation;  // the variance of a uniform distribution is (b − a)²/12
  return mean + half * (2.0 * uniform(state) - 1.0);
}

}  // namespace

double draw(const Sampled& s, const std::string& key, double mean, std::uint64_t seed, int number) {
  std::uint64_t state = stream(seed, s.keys.front(), number);
  const bool range = s.distribution == Sampled::Distribution::uniform && s.cov == 0.0 && s.deviation == 0.0;
  if (range) return s.low + (s.high - s.low) * uniform(state);
  if (s.own_mean) mean = s.mean;
  if (s.distribution == Sampled::Distribution::lognormal && !(mean > 0.0))
    throw InputError("{} cannot be lognormal about a mean of {}: give 'mean' above 0 or another distribution", key,
                     mean);
  const double deviation = s.cov > 0.0 ? s.cov * std::abs(mean) : s.deviation;
  if (!(deviation > 0.0))
    throw InputError("{} has the mean {}, of which 'cov' is no spread: give 'deviation' or 'mean'", key, mean);
  for (int i = 0; i < most_tries; ++i)
    if (const double x = draw_once(s, mean, deviation, state); x >= s.low && x <= s.high) return x;
  throw InputError("{}: of {} values about the mean {} none lies between 'low' {} and 'high' {}: widen them", key,
                   most_tries, mean, s.low, s.high);
}

}  // namespace voussoir::campaign
