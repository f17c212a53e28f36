// Random numbers of the case.
#pragma once
#include "tools/campaign/settings.h"

namespace voussoir::campaign {

/// Value of a key in sample `number` (from 1), where its mean is `mean` (in the key's unit). It depends on seed, the
/// first key's name, number and distribution only, so that other samples, keys, cases and records can be added without
/// changing it. A lognormal variable with mean m and cov v is exp(μ + σ z), σ² = ln(1 + v²), μ = ln m − σ²/2. Throws
/// InputError when the mean does not allow the distribution, or `low` and `high` leave nothing to draw.
double draw(const Sampled& sampled, const std::string& key, double mean, std::uint64_t seed, int number);

}  // namespace voussoir::campaign
