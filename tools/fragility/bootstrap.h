// Resampling (Efron 1979) of records, not of runs: those of one record stay together, for they are not independent.
#pragma once
#include <map>
#include <string>
#include <vector>

#include "solver/base/random.h"

namespace voussoir {

/// Places of runs, record by record.
using Clusters = std::vector<std::vector<std::size_t>>;

/// Runs with the same record, in the order in which records first appear. `record[i]` numbers that of run i.
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

/// As many records as there are, drawn with replacement: the places of their runs.
inline std::vector<std::size_t> resampled(const Clusters& clusters, RandomStream& random) {
  std::vector<std::size_t> drawn;
  for (std::size_t i = 0; i < clusters.size(); ++i) {
    const std::vector<std::size_t>& runs = clusters[random.below(clusters.size())];
    drawn.insert(drawn.end(), runs.begin(), runs.end());
  }
  return drawn;
}

}  // namespace voussoir
