#include "tools/campaign/sample.h"

#include <cmath>

#include "solver/base/error.h"
#include "solver/base/random.h"

namespace voussoir::campaign {

namespace {

constexpr int most_tries = 10000;

double draw_once(const Sampled& s, double mean, double deviation, RandomStream& random) {
  switch (s.distribution) {
    case Sampled::Distribution::lognormal: {
      const double cov = deviation / mean, variance = std::log1p(cov * cov);
      return std::exp(std::log(mean) - 0.5 * variance + std::sqrt(variance) * random.normal());
    }
    case Sampled::Distribution::normal:
      return mean + deviation * random.normal();
    case Sampled::Distribution::uniform:
      break;
  }
  const double half = std::sqrt(3.0) * deviation;  // the variance of a uniform distribution is (b − a)²/12
  return mean + half * (2.0 * random.uniform() - 1.0);
}

}  // namespace

double draw(const Sampled& s, const std::string& key, double mean, std::uint64_t seed, int number) {
  RandomStream random = stream_of(seed, s.keys.front(), number);
  const bool range = s.distribution == Sampled::Distribution::uniform && s.cov == 0.0 && s.deviation == 0.0;
  if (range) return s.low + (s.high - s.low) * random.uniform();
  if (s.own_mean) mean = s.mean;
  if (s.distribution == Sampled::Distribution::lognormal && !(mean > 0.0))
    throw InputError(
        "{} has the mean {}. A lognormal distribution needs a mean above 0: change 'mean' or the distribution", key,
        mean);
  const double deviation = s.cov > 0.0 ? s.cov * std::abs(mean) : s.deviation;
  if (!(deviation > 0.0))
    throw InputError("{} has the mean {}, so 'cov' gives no standard deviation. Give 'deviation' or another 'mean'",
                     key, mean);
  for (int i = 0; i < most_tries; ++i)
    if (const double x = draw_once(s, mean, deviation, random); x >= s.low && x <= s.high) return x;
  throw InputError(
      "{}: none of {} values drawn about the mean {} is between 'low' {} and 'high' {}. Increase this range", key,
      most_tries, mean, s.low, s.high);
}

}  // namespace voussoir::campaign
