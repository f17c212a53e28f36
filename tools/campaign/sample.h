// Sampling of numbers of a case.
#pragma once
#include "tools/campaign/settings.h"

namespace voussoir::campaign {

/// The value of a key in sample `number` (from 1) with the mean `mean`, in the unit of the key. It depends only on the
/// seed, the name of the first key, the number and the distribution, so that further samples, keys, cases and records
/// do not change it. A lognormal variable with mean m and coefficient of variation v is exp(μ + σ z), σ² = ln(1 + v²),
/// μ = ln m − σ²/2. Throws InputError if the mean does not allow the distribution, or if no value lies between `low`
/// and `high`.
double draw(const Sampled& sampled, const std::string& key, double mean, std::uint64_t seed, int number);

}  // namespace voussoir::campaign
