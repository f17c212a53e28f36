// The only place that knows about threads. Loops have fixed order and one writer per output, so results have the same
// bits for any number of threads.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace voussoir {

/// Threads the machine offers to this process (its affinity mask counts).
int available_threads();

/// While one lives, libraries that this thread calls open no teams of OpenMP's. CHOLMOD opens one for each of the many
/// small parts of a factor, and waking its threads costs more than they save.
class Alone {
 public:
  Alone();
  ~Alone();
  Alone(const Alone&) = delete;
  Alone& operator=(const Alone&) = delete;

 private:
  int levels_;
};

struct Range {
  std::size_t begin = 0, end = 0;
};

/// Items of work in two stages: the second of an item may begin once its own first stage and those of all items before
/// it are done. In the next step its first stage may begin once its own second stage and those of its followers are.
struct Dependencies {
  std::vector<std::vector<std::int32_t>> followers;  // of each item: later items whose second stage waits for it
  std::vector<std::int32_t> waits;  // of each item: first stages its second waits for, its own included
  std::vector<double> cost;         // of each item, in any unit: the threads begin with equal shares
};

enum class RoundKind { before, both, first_only, between, second_only, end };

/// What comes next: `both` may be several steps, in which items go ahead of each other as far as they may.
struct NextRound {
  RoundKind kind = RoundKind::end;
  int steps = 1;
  NextRound(RoundKind k, int n = 1) : kind(k), steps(n) {}
};

struct RoundWork {
  std::function<void(std::size_t item, int step)> first, second;  // step: of the round
  std::function<void(std::size_t)> between;
  std::function<void(std::size_t)> before_first, before_second;  // of a round `before`, which waits as `both` does
  std::function<NextRound(RoundKind)> next;  // called by one thread when a round is over: what comes next
};

/// Works through rounds over all items in a team of up to `threads` threads. A thread takes the lowest item of its
/// share that may go on, so that in a round of several steps the same few items are worked on step after step while
/// they are in the cache. Who finds none takes from the others' shares, and a thread that the system has put aside
/// holds up nobody unless it is within an item. An exception of any of the work ends the rounds, with what is begun
/// then done or not, and is thrown again.
void run_rounds(int threads, const Dependencies& items, NextRound begin, const RoundWork& work);

/// Runs `work(thread, team)` once in each of `team` threads: `threads`, or fewer where the system grants fewer. What
/// one of them throws is thrown again when all have ended; of several the one of the lowest number.
void run_team(int threads, const std::function<void(int, int)>& work);

/// Runs `work(thread, range)` over [0, n) in as many threads as get `least` each. A thread takes some in a row, and
/// more when it has done them, because one half may take longer than the other: who does what is not the same each
/// time.
template <class Work>
void share_out(std::size_t n, int threads, std::size_t least, const Work& work) {
  constexpr std::size_t turns = 8;  // of each thread
  const auto team = std::clamp<std::size_t>(n / least, 1, std::size_t(std::max(1, threads)));
  const std::size_t some = team == 1 ? n : std::max<std::size_t>(1, n / (turns * team));
  std::atomic<std::size_t> next{0};
  run_team(int(team), [&](int thread, int) {
    for (std::size_t begin; (begin = next.fetch_add(some, std::memory_order_relaxed)) < n;)
      work(thread, Range{begin, std::min(n, begin + some)});
  });
}
/// The same item by item: `work(i)`.
template <class Work>
void for_each(std::size_t n, int threads, std::size_t least, const Work& work) {
  share_out(n, threads, least, [&](int, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i) work(i);
  });
}

/// Calls work(i) for all i < n in `threads` threads. The first exception (by i) is thrown at the end.
void for_all(std::size_t n, int threads, const std::function<void(std::size_t)>& work);

}  // namespace voussoir
