// Bootstrap (Efron 1979) over records, not over runs: the runs of one record stay together, because they are not
// independent.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "solver/base/random.h"

namespace voussoir {

/// Indices of runs, record by record.
using Clusters = std::vector<std::vector<std::size_t>>;

/// Groups runs with the same record, in the order of the first occurrence of records. `record[i]` is the number of the
/// record of run i.
inline Clusters clusters_of(const std::vector<std::size_t>& record) {
  std::map<std::size_t, std::size_t> place;
  Clusters clusters;
  for (std::size_t i = 0; i < record.size(); ++i) {
    const auto [at, is_new] = place.emplace(record[i], clusters.size());
    if (is_new) clusters.emplace_back();
    clusters[at->second].push_back(i);
  }
  return clusters;
}

/// Draws as many records as there are, with replacement. Returns the indices of their runs.
inline std::vector<std::size_t> resampled(const Clusters& clusters, RandomStream& random) {
  std::vector<std::size_t> drawn;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const std::vector<std::size_t>& runs = clusters[random.below(clusters.size())];
    drawn.insert(drawn.end(), runs.begin(), runs.end());
  }
  return drawn;
}

}  // namespace voussoir
