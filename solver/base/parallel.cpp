#include "solver/base/parallel.h"

#include <omp.h>
#include <unistd.h>

#include <atomic>
#include <cstdlib>
#include <exception>
#include <filesystem>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace voussoir {

void ensure_passive_waiting(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY")) return;
  setenv("OMP_WAIT_POLICY", "passive", 1);
  // By its own path, so that the process keeps the name that users look for. execv() returns only on failure: then the
  // default policy stays, which is slower, not wrong.
  std::error_code error;
  const std::filesystem::path program = std::filesystem::read_symlink("/proc/self/exe", error);
  if (!error) execv(program.c_str(), argv);
}

int available_threads() {
  return omp_get_num_procs();
}

Alone::Alone() : levels_(omp_get_max_active_levels()) {
  omp_set_max_active_levels(0);
}
Alone::~Alone() {
  omp_set_max_active_levels(levels_);
}

Range share(std::size_t n, int thread, int threads) {
  return {n * std::size_t(thread) / std::size_t(threads), n * std::size_t(thread + 1) / std::size_t(threads)};
}

namespace {
void pause_briefly() {
#if defined(__x86_64__)
  _mm_pause();
#endif
}
constexpr int spins = 4000;  // some tens of microseconds: longer than a balanced pass's scatter, far below a time slice

/// A thread's share of a round: round number, first and one past the last item that nobody has taken, in one word.
class Share {
 public:
  void set(std::uint64_t round, std::uint64_t begin, std::uint64_t end) {
    word_.store(round % rounds << 2 * bits | begin << bits | end, std::memory_order_release);
  }
  /// The first item, or the last; −1 when there is none left or another round has begun.
  std::int64_t take(std::uint64_t round, bool last) {
    std::uint64_t word = word_.load(std::memory_order_acquire);
    for (;;) {
      const std::uint64_t begin = word >> bits & most, end = word & most;
      if (word >> 2 * bits != round % rounds || begin == end) return -1;
      const std::uint64_t left = last ? word - 1 : word + (std::uint64_t(1) << bits);
      if (word_.compare_exchange_weak(word, left, std::memory_order_acq_rel, std::memory_order_acquire))
        return std::int64_t(last ? end - 1 : begin);
    }
  }

 private:
  static constexpr std::uint64_t bits = 20, most = (1u << bits) - 1, rounds = 1u << (64 - 2 * bits);
  alignas(64) std::atomic<std::uint64_t> word_{0};
};

class Rounds {
 public:
  Rounds(int team, const Dependencies& items, const RoundWork& work)
      : items_(items), work_(work), shares_(std::size_t(team)), arrived_(items.waits.size()) {
    // Neighbouring items to the same thread, by cost.
    double total = 0.0, sum = 0.0;
    for (double c : items.cost) total += c;
    starts_.push_back(0);
    for (std::size_t i = 0; i < items.cost.size(); ++i) {
      while (int(starts_.size()) < team && sum >= total * double(starts_.size()) / team) starts_.push_back(i);
      sum += items.cost[i];
    }
    while (int(starts_.size()) <= team) starts_.push_back(items.cost.size());
  }

  void begin(RoundKind kind) { publish(kind); }

  void work(int thread) {
    for (;;) {
      const std::uint32_t now = round_.load(std::memory_order_acquire);
      const auto kind = RoundKind(now & kind_mask);
      if (kind == RoundKind::end) return;
      for (std::int64_t item = take(thread, now >> kind_bits); item >= 0; item = take(thread, now >> kind_bits)) try {
          work_on(std::size_t(item), kind);
        } catch (...) {
          fail();
        }
      wait_for_change(now);
    }
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::int64_t take(int thread, std::uint64_t round) {
    const int team = int(shares_.size());
    std::int64_t item = shares_[std::size_t(thread)].take(round, false);
    for (int i = 1; i < team && item < 0; ++i) item = shares_[std::size_t((thread + i) % team)].take(round, true);
    return item;
  }

  void work_on(std::size_t item, RoundKind kind) {
    if (kind == RoundKind::between) return work_.between(item), finished(kind);
    if (kind == RoundKind::second_only) return work_.second(item), finished(kind);
    (kind == RoundKind::before ? work_.before_first : work_.first)(item);
    if (kind == RoundKind::first_only) return finished(kind);
    arrive(item, kind);
    for (const std::int32_t follower : items_.followers[item]) arrive(std::size_t(follower), kind);
  }

  void arrive(std::size_t item, RoundKind kind) {
    if (arrived_[item].fetch_add(1, std::memory_order_acq_rel) + 1 != items_.waits[item]) return;
    arrived_[item].store(0, std::memory_order_relaxed);
    (kind == RoundKind::before ? work_.before_second : work_.second)(item);
    finished(kind);
  }

  /// The thread that finishes the last item of a round says what comes next.
  void finished(RoundKind kind) {
    if (finished_.fetch_add(1, std::memory_order_acq_rel) + 1 != items_.waits.size()) return;
    finished_.store(0, std::memory_order_relaxed);
    publish(work_.next(kind));
  }

  /// The item that failed is never finished, so nobody else says what comes next.
  void fail() {
    if (failed_.exchange(true, std::memory_order_acq_rel)) return;
    failure_ = std::current_exception();
    publish(RoundKind::end);
  }

  void publish(RoundKind kind) {
    const std::uint32_t round = (round_.load(std::memory_order_relaxed) >> kind_bits) + 1;
    for (std::size_t i = 0; i < shares_.size(); ++i) shares_[i].set(round, starts_[i], starts_[i + 1]);
    round_.store(round << kind_bits | std::uint32_t(kind), std::memory_order_release);
    if (shares_.size() > 1) round_.notify_all();
  }

  void wait_for_change(std::uint32_t now) {
    for (int i = 0; i < spins; ++i) {
      if (round_.load(std::memory_order_acquire) != now) return;
      pause_briefly();
    }
    round_.wait(now, std::memory_order_acquire);
  }

  static constexpr std::uint32_t kind_bits = 3, kind_mask = 7;
  const Dependencies& items_;
  const RoundWork& work_;
  std::vector<std::size_t> starts_;
  std::vector<Share> shares_;
  std::vector<std::atomic<std::int32_t>> arrived_;
  alignas(64) std::atomic<std::size_t> finished_{0};
  alignas(64) std::atomic<std::uint32_t> round_{0};
  std::atomic<bool> failed_{false};
  std::exception_ptr failure_;
};

}  // namespace

void run_rounds(int threads, const Dependencies& items, RoundKind begin, const RoundWork& work) {
  Rounds rounds(threads, items, work);  // if fewer threads are granted, they take the others' shares too
  rounds.begin(begin);
  run_team(threads, [&](int thread, int) { rounds.work(thread); });
  rounds.rethrow();
}

void run_team(int threads, const std::function<void(int, int)>& work) {
  if (threads == 1) return work(0, 1);
  std::vector<std::exception_ptr> failures(std::size_t(std::max(threads, 1)));
  // These order what OpenMP's fork, barrier and join order anyway, in words that the thread sanitizer understands.
  // Static, so that they are never made anew while a thread of the team before still looks.
  static std::atomic<int> begun, ended;
  begun.fetch_add(1, std::memory_order_release);
#pragma omp parallel num_threads(threads)
  {
    begun.load(std::memory_order_acquire);
    const int thread = omp_get_thread_num();
    try {
      work(thread, omp_get_num_threads());
    } catch (...) {
      failures[std::size_t(thread)] = std::current_exception();
    }
    ended.fetch_add(1, std::memory_order_release);
  }
  ended.load(std::memory_order_acquire);
  for (const std::exception_ptr& failure : failures)
    if (failure) std::rethrow_exception(failure);
}

}  // namespace voussoir
