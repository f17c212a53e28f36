// The only code that starts threads. Loops have a fixed order and one writer for each output, so that results have the
// same bits for any number of threads.
#pragma once
#include <algorithm>
#include <atomic>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace voussoir {

/// Number of threads that this process may use (according to its affinity mask).
int available_threads();

/// As long as an object of this class exists, libraries that this thread calls use no OpenMP threads. CHOLMOD would use
/// them for each of the many small parts of a factorisation, and waking them costs more time than they save.
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

/// Items of work with two stages. The second stage of an item can begin when its own first stage and those of all items
/// that it follows are done. In the next step its first stage can begin when its own second stage and those of its
/// followers are done.
struct Dependencies {
  std::vector<std::vector<std::int32_t>> followers;  // of each item: later items whose second stage waits for it
  std::vector<std::int32_t> waits;  // of each item: number of first stages that its second stage waits for, including
                                    // its own
  std::vector<double> cost;         // of each item, in any unit; the threads begin with equal shares
};

enum class RoundKind { before, both, first_only, between, second_only, end };

/// The kind of the next round. `both` can contain several steps, in which items can be ahead of each other as far as
/// the dependencies allow.
struct NextRound {
  RoundKind kind = RoundKind::end;
  int steps = 1;
  NextRound(RoundKind k, int n = 1) : kind(k), steps(n) {}
};

struct RoundWork {
  std::function<void(std::size_t item, int step)> first, second;  // step: its number in the round, from 0
  std::function<void(std::size_t)> between;
  std::function<void(std::size_t)> before_first, before_second;  // of a round `before`, with the dependencies of `both`
  std::function<NextRound(RoundKind)> next;  // called by one thread at the end of a round; returns the next round
};

/// Executes rounds over all items with at most `threads` threads. A thread takes the lowest available item of its
/// share, so that in a round of several steps it processes the same few items step after step while they are in the
/// cache. A thread without available items takes items from other shares. A suspended thread therefore delays the
/// others only if it is within an item. An exception ends the rounds and is thrown again; the state of work in progress
/// is then undefined.
void run_rounds(int threads, const Dependencies& items, NextRound begin, const RoundWork& work);

/// Runs `work(thread, team)` once in each of `team` threads: `threads`, or fewer if the system provides fewer. An
/// exception is thrown again when all threads have ended; of several, that of the lowest thread number.
void run_team(int threads, const std::function<void(int, int)>& work);

/// Runs `work(thread, range)` over [0, n) with so many threads that each gets at least `least` items. A thread takes a
/// range and then the next free one, because items can take different times. The assignment of ranges to threads is
/// therefore not reproducible.
template <class Work>
void share_out(std::size_t n, int threads, std::size_t least, const Work& work) {
  constexpr std::size_t turns = 8;  // for each thread
  const auto team = std::clamp<std::size_t>(n / least, 1, std::size_t(std::max(1, threads)));
  const std::size_t some = team == 1 ? n : std::max<std::size_t>(1, n / (turns * team));
  std::atomic<std::size_t> next{0};
  run_team(int(team), [&](int thread, int) {
    for (std::size_t begin; (begin = next.fetch_add(some, std::memory_order_relaxed)) < n;)
      work(thread, Range{begin, std::min(n, begin + some)});
  });
}
/// The same for single items: `work(i)`.
template <class Work>
void for_each(std::size_t n, int threads, std::size_t least, const Work& work) {
  share_out(n, threads, least, [&](int, Range range) {
    for (std::size_t i = range.begin; i < range.end; ++i) work(i);
  });
}

/// Calls work(i) for all i < n in `threads` threads. The exception with the lowest i is thrown at the end.
void for_all(std::size_t n, int threads, const std::function<void(std::size_t)>& work);

}  // namespace voussoir
