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
constexpr int spins_a_look = 16;

/// One bit for each item that may go on and that nobody has taken.
class ReadyItems {
 public:
  explicit ReadyItems(std::size_t items) : words_((items + bits - 1) / bits), items_(items) {}

  void set_all() {
    for (std::size_t w = 0; w < words_.size(); ++w) words_[w].fetch_or(mask(w, 0, items_), std::memory_order_seq_cst);
  }
  void set(std::size_t item) {
    words_[item / bits].fetch_or(std::uint64_t(1) << item % bits, std::memory_order_seq_cst);
  }
  bool any() const {
    return std::any_of(words_.begin(), words_.end(), [](const auto& w) { return w.load(std::memory_order_seq_cst); });
  }
  /// The lowest of [begin, end), −1 when there is none.
  std::int64_t take_lowest(std::size_t begin, std::size_t end) {
    for (std::size_t w = begin / bits; w * bits < end; ++w)
      while (const std::uint64_t found = words_[w].load(std::memory_order_acquire) & mask(w, begin, end))
        if (const auto at = std::size_t(__builtin_ctzll(found)); claim(w, at)) return std::int64_t(w * bits + at);
    return -1;
  }
  std::int64_t take_highest(std::size_t begin, std::size_t end) {
    for (std::size_t w = (end + bits - 1) / bits; w-- > begin / bits;)
      while (const std::uint64_t found = words_[w].load(std::memory_order_acquire) & mask(w, begin, end))
        if (const auto at = std::size_t(bits - 1 - __builtin_clzll(found)); claim(w, at))
          return std::int64_t(w * bits + at);
    return -1;
  }

 private:
  static constexpr std::size_t bits = 64;
  /// The bits of a word that stand for [begin, end).
  static std::uint64_t mask(std::size_t word, std::size_t begin, std::size_t end) {
    const std::size_t from = word * bits;
    std::uint64_t m = ~std::uint64_t(0);
    if (begin > from) m &= begin - from < bits ? m << (begin - from) : 0;
    if (end < from + bits) m &= end > from ? m >> (from + bits - end) : 0;
    return m;
  }
  bool claim(std::size_t word, std::size_t at) {
    const std::uint64_t bit = std::uint64_t(1) << at;
    return words_[word].fetch_and(~bit, std::memory_order_acq_rel) & bit;
  }

  std::vector<std::atomic<std::uint64_t>> words_;
  std::size_t items_;
};

class Rounds {
 public:
  Rounds(int team, const Dependencies& items, const RoundWork& work)
      : items_(items),
        work_(work),
        leaders_(items.waits.size()),
        step_(items.waits.size(), 0),
        ready_(items.waits.size()),
        first_waits_(items.waits.size()),
        second_waits_(items.waits.size()) {
    // Neighbouring items to the same thread, by cost.
    double total = 0.0, sum = 0.0;
    for (double c : items.cost) total += c;
    starts_.push_back(0);
    for (std::size_t i = 0; i < items.cost.size(); ++i) {
      while (int(starts_.size()) < team && sum >= total * double(starts_.size()) / team) starts_.push_back(i);
      sum += items.cost[i];
    }
    while (int(starts_.size()) <= team) starts_.push_back(items.cost.size());
    for (std::size_t i = 0; i < items.followers.size(); ++i) {
      first_waits_[i] = first_waits(i), second_waits_[i] = items.waits[i];
      for (const std::int32_t follower : items.followers[i]) leaders_[std::size_t(follower)].push_back(std::int32_t(i));
    }
  }

  void begin(NextRound round) { publish(round); }

  void work(int thread) {
    for (;;) {
      const std::uint32_t news = news_.load(std::memory_order_acquire);
      if (over_.load(std::memory_order_acquire)) return;
      for (std::int64_t item = take(thread); item >= 0; item = take(thread)) try {
          work_on(std::size_t(item));
        } catch (...) {
          fail();
        }
      wait(news);
    }
  }

  void rethrow() const {
    if (failure_) std::rethrow_exception(failure_);
  }

 private:
  std::int32_t first_waits(std::size_t item) const { return 1 + std::int32_t(items_.followers[item].size()); }

  std::int64_t take(int thread) {
    const int team = int(starts_.size()) - 1;
    std::int64_t item = ready_.take_lowest(starts_[std::size_t(thread)], starts_[std::size_t(thread) + 1]);
    for (int i = 1; i < team && item < 0; ++i) {
      const auto other = std::size_t((thread + i) % team);
      item = ready_.take_highest(starts_[other], starts_[other + 1]);
    }
    return item;
  }

  void work_on(std::size_t item) {
    const RoundKind kind = kind_;
    if (kind == RoundKind::between) return work_.between(item), finished();
    if (kind == RoundKind::second_only) return work_.second(item, 0), finished();
    if (kind == RoundKind::before)
      work_.before_first(item);
    else
      work_.first(item, step_[item]);
    if (kind == RoundKind::first_only) return finished();
    first_done(item);
    for (const std::int32_t follower : items_.followers[item]) first_done(std::size_t(follower));
  }

  /// Of all that an item waits for the last one resets the count: it comes again only after the item has gone on.
  static bool last_of(std::atomic<std::int32_t>& waits, std::int32_t all) {
    if (waits.fetch_sub(1, std::memory_order_acq_rel) != 1) return false;
    waits.store(all, std::memory_order_relaxed);
    return true;
  }

  /// One of the first stages that the second of an item waits for.
  void first_done(std::size_t item) {
    if (!last_of(second_waits_[item], items_.waits[item])) return;
    const int step = step_[item]++;
    if (kind_ == RoundKind::before)
      work_.before_second(item);
    else
      work_.second(item, step);
    const bool goes_on = step + 1 < steps_;
    finished();
    if (!goes_on) return;  // another round may have begun
    second_done(item);
    for (const std::int32_t leader : leaders_[item]) second_done(std::size_t(leader));
  }

  /// One of the second stages that the next step of an item waits for.
  void second_done(std::size_t item) {
    if (!last_of(first_waits_[item], first_waits(item))) return;
    ready_.set(item);
    if (sleepers_.load(std::memory_order_seq_cst) == 0) return;
    news_.fetch_add(1, std::memory_order_release);
    news_.notify_one();
  }

  /// The thread that finishes the last item of a round says what comes next.
  void finished() {
    if (left_.fetch_sub(1, std::memory_order_acq_rel) == 1) publish(work_.next(kind_));
  }

  /// The item that failed is never finished, so nobody else says what comes next.
  void fail() {
    if (failed_.exchange(true, std::memory_order_acq_rel)) return;
    failure_ = std::current_exception();
    end();
  }

  void end() {
    over_.store(true, std::memory_order_release);
    tell_all();
  }
  void tell_all() {
    news_.fetch_add(1, std::memory_order_release);
    if (starts_.size() > 2) news_.notify_all();
  }

  /// Nobody is within an item; who takes one sees what stands here.
  void publish(NextRound round) {
    if (round.kind == RoundKind::end) return end();
    kind_ = round.kind;
    steps_ = round.kind == RoundKind::both ? round.steps : 1;
    std::fill(step_.begin(), step_.end(), 0);
    left_.store(items_.waits.size() * std::size_t(steps_), std::memory_order_relaxed);
    ready_.set_all();
    tell_all();
  }

  void wait(std::uint32_t news) {
    const auto changed = [&] { return news_.load(std::memory_order_acquire) != news || ready_.any(); };
    for (int i = 0; i < spins; ++i) {
      if (i % spins_a_look == 0 && changed()) return;
      pause_briefly();
    }
    sleepers_.fetch_add(1, std::memory_order_seq_cst);
    if (!changed()) news_.wait(news, std::memory_order_acquire);
    sleepers_.fetch_sub(1, std::memory_order_seq_cst);
  }

  const Dependencies& items_;
  const RoundWork& work_;
  std::vector<std::vector<std::int32_t>> leaders_;  // of each item: those that it follows
  std::vector<std::size_t> starts_;
  RoundKind kind_ = RoundKind::end;
  int steps_ = 1;
  std::vector<int> step_;  // of each item, within the round
  ReadyItems ready_;
  std::vector<std::atomic<std::int32_t>> first_waits_, second_waits_;
  alignas(64) std::atomic<std::size_t> left_{0};
  alignas(64) std::atomic<std::uint32_t> news_{0};
  std::atomic<int> sleepers_{0};
  std::atomic<bool> failed_{false}, over_{false};
  std::exception_ptr failure_;
};

}  // namespace

void run_rounds(int threads, const Dependencies& items, NextRound begin, const RoundWork& work) {
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
