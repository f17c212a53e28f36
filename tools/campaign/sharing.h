// Number of simultaneous runs, and threads of each.
#pragma once
#include <algorithm>

#include "tools/campaign/settings.h"

namespace voussoir::campaign {

struct Sharing {
  int runs = 1, threads = 1;
};

/// The total number of threads is at most the number of cores. Simultaneous runs come before threads within a run,
/// because runs share nothing.
inline Sharing share_cores(const EngineSettings& engine, int cores, std::size_t runs) {
  Sharing s;
  s.threads = std::clamp(engine.threads, 1, cores);
  s.runs = cores / s.threads;
  if (engine.runs_at_once > 0) s.runs = std::min(s.runs, engine.runs_at_once);
  s.runs = std::clamp<int>(s.runs, 1, int(std::min<std::size_t>(std::max<std::size_t>(runs, 1), 1 << 20)));
  if (engine.threads == 0) s.threads = cores / s.runs;
  return s;
}

}  // namespace voussoir::campaign
