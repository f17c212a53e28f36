#include "solver/base/parallel.h"

#include <omp.h>

#include <array>
#include <atomic>
#include <deque>
#include <exception>

#include "solver/base/arrays.h"

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace voussoir {

int available_threads() {
  return omp_get_num_procs();
}

Alone::Alone() : levels_(omp_get_max_active_levels()) {
  omp_set_max_active_levels(0);
}
Alone::~Alone() {
  omp_set_max_active_levels(levels_);
}

namespace {
void pause_briefly() {
#if defined(__x86_64__)
  _mm_pause();
#endif
}
constexpr int spins = 4000;  // some tens of microseconds: longer than a balanced pass's scatter, far below a time slice
constexpr int spins_a_look = 16;

// Where two cores share no cache, one takes a line from the other in some hundred nanoseconds: so what several threads
// write has lines of its own.

/// One bit for each item of a share that may go on and that nobody has taken.
class ReadyItems {
 public:
  explicit ReadyItems(std::size_t items) : lines_((items + bits * words - 1) / (bits * words)), items_(items) {}

  void set_all() {
    for (std::size_t w = 0; w * bits < items_; ++w) {
      const std::size_t unused = w * bits + bits > items_ ? w * bits + bits - items_ : 0;
      word(w).fetch_or(~std::uint64_t(0) >> unused, std::memory_order_seq_cst);
    }
  }
  void set(std::size_t item) { word(item / bits).fetch_or(std::uint64_t(1) << item % bits, std::memory_order_seq_cst); }
  bool any() const {
    const auto any_of_line = [](const Line& l) {
      return std::any_of(l.begin(), l.end(), [](const auto& w) { return w.load(std::memory_order_seq_cst); });
    };
    return std::any_of(lines_.begin(), lines_.end(), any_of_line);
  }
  /// The lowest, −1 when there is none.
  std::int64_t take_lowest() {
    for (std::size_t w = 0; w * bits < items_; ++w)
      while (const std::uint64_t found = word(w).load(std::memory_order_acquire))
        if (const auto at = std::size_t(__builtin_ctzll(found)); claim(w, at)) return std::int64_t(w * bits + at);
    return -1;
  }
  std::int64_t take_highest() {
    for (std::size_t w = (items_ + bits - 1) / bits; w-- > 0;)
      while (const std::uint64_t found = word(w).load(std::memory_order_acquire))
        if (const auto at = std::size_t(bits - 1 - __builtin_clzll(found)); claim(w, at))
          return std::int64_t(w * bits + at);
    return -1;
  }

 private:
  static constexpr std::size_t bits = 64, words = cache_line / sizeof(std::uint64_t);
  struct alignas(cache_line) Line : std::array<std::atomic<std::uint64_t>, words> {};

  std::atomic<std::uint64_t>& word(std::size_t w) { return lines_[w / words][w % words]; }
  bool claim(std::size_t w, std::size_t at) {
    const std::uint64_t bit = std::uint64_t(1) << at;
    return word(w).fetch_and(~bit, std::memory_order_acq_rel) & bit;
  }

  std::vector<Line> lines_;
  std::size_t items_;
};

/// The neighbouring items that are one thread's to begin with.
struct alignas(cache_line) Share {
  std::size_t begin, end;
  ReadyItems ready;
  std::atomic<std::size_t> left{0};  // items that have not finished the round
  Share(std::size_t first, std::size_t past) : begin(first), end(past), ready(past - first) {}
};

/// Where an item stands in a round.
struct alignas(cache_line) Progress {
  std::atomic<std::int32_t> first_waits{0}, second_waits{0};
  int step = 0;            // of the round
  bool at_second = false;  // the stage for which it is ready
  std::size_t share = 0;   // the thread whose it is to begin with
};

class Rounds {
 public:
  Rounds(int team, const Dependencies& items, const RoundWork& work)
      : items_(items), work_(work), leaders_(items.waits.size()), at_(items.waits.size()) {
    // Neighbouring items to the same thread, by cost.
    double total = 0.0, sum = 0.0;
    for (double c : items.cost) total += c;
    std::vector<std::size_t> starts{0};
    for (std::size_t i = 0; i < items.cost.size(); ++i) {
      while (int(starts.size()) < team && sum >= total * double(starts.size()) / team) starts.push_back(i);
      sum += items.cost[i];
    }
    while (int(starts.size()) <= team) starts.push_back(items.cost.size());
    for (std::size_t k = 0; k < std::size_t(team); ++k) {
      shares_.emplace_back(starts[k], starts[k + 1]);
      for (std::size_t i = starts[k]; i < starts[k + 1]; ++i) at_[i].share = k;
    }
    for (std::size_t i = 0; i < items.followers.size(); ++i) {
      at_[i].first_waits = first_waits(i), at_[i].second_waits = items.waits[i];
      for (const std::int32_t follower : items.followers[i]) leaders_[std::size_t(follower)].push_back(std::int32_t(i));
    }
  }

  void begin(NextRound round) { publish(round); }

  void work(std::size_t thread) {
    for (;;) {
      const std::uint32_t news = news_.load(std::memory_order_acquire);
      if (over_.load(std::memory_order_acquire)) return;
      for (std::int64_t item = take(thread); item >= 0; item = take(thread)) try {
          work_on(std::size_t(item), thread);
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

  std::int64_t take(std::size_t thread) {
    for (std::size_t i = 0; i < shares_.size(); ++i) {
      Share& share = shares_[(thread + i) % shares_.size()];
      const std::int64_t item = i == 0 ? share.ready.take_lowest() : share.ready.take_highest();
      if (item >= 0) return std::int64_t(share.begin) + item;
    }
    return -1;
  }

  void work_on(std::size_t item, std::size_t thread) {
    const RoundKind kind = kind_;
    if (kind == RoundKind::between) return work_.between(item), finished(item);
    if (kind == RoundKind::second_only) return work_.second(item, 0), finished(item);
    if (at_[item].at_second) return second(item);
    if (kind == RoundKind::before)
      work_.before_first(item);
    else
      work_.first(item, at_[item].step);
    if (kind == RoundKind::first_only) return finished(item);
    first_done(item, thread);
    for (const std::int32_t follower : items_.followers[item]) first_done(std::size_t(follower), thread);
  }

  /// Of all that an item waits for the last one resets the count: it comes again only after the item has gone on.
  static bool last_of(std::atomic<std::int32_t>& waits, std::int32_t all) {
    if (waits.fetch_sub(1, std::memory_order_acq_rel) != 1) return false;
    waits.store(all, std::memory_order_relaxed);
    return true;
  }

  /// One of the first stages that the second of an item waits for. What an item reads and writes is in its own thread's
  /// cache, so the second is left to that one.
  void first_done(std::size_t item, std::size_t thread) {
    Progress& at = at_[item];
    if (!last_of(at.second_waits, items_.waits[item])) return;
    if (at.share == thread) return second(item);
    at.at_second = true;
    set_ready(item);
  }

  void second(std::size_t item) {
    Progress& at = at_[item];
    at.at_second = false;
    const int step = at.step++;
    if (kind_ == RoundKind::before)
      work_.before_second(item);
    else
      work_.second(item, step);
    if (step + 1 == steps_) return finished(item);
    second_done(item);
    for (const std::int32_t leader : leaders_[item]) second_done(std::size_t(leader));
  }

  /// One of the second stages that the next step of an item waits for.
  void second_done(std::size_t item) {
    if (last_of(at_[item].first_waits, first_waits(item))) set_ready(item);
  }

  void set_ready(std::size_t item) {
    Share& share = shares_[at_[item].share];
    share.ready.set(item - share.begin);
    if (sleepers_.load(std::memory_order_seq_cst) == 0) return;
    news_.fetch_add(1, std::memory_order_release);
    news_.notify_one();
  }

  /// The thread that finishes the last item of a round says what comes next; another round may have begun at return.
  void finished(std::size_t item) {
    if (shares_[at_[item].share].left.fetch_sub(1, std::memory_order_acq_rel) != 1) return;
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
    if (shares_.size() > 1) news_.notify_all();
  }

  /// Nobody is within an item; who takes one sees what stands here.
  void publish(NextRound round) {
    if (round.kind == RoundKind::end) return end();
    kind_ = round.kind;
    steps_ = round.kind == RoundKind::both ? round.steps : 1;
    for (Progress& at : at_) at.step = 0;
    std::size_t at_work = 0;
    for (Share& share : shares_) {
      share.left.store(share.end - share.begin, std::memory_order_relaxed);
      at_work += share.end > share.begin;
    }
    left_.store(at_work, std::memory_order_relaxed);
    for (Share& share : shares_) share.ready.set_all();
    tell_all();
  }

  void wait(std::uint32_t news) {
    const auto changed = [&] {
      return news_.load(std::memory_order_acquire) != news ||
             std::any_of(shares_.begin(), shares_.end(), [](const Share& s) { return s.ready.any(); });
    };
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
  std::deque<Share> shares_;
  std::vector<Progress> at_;  // of each item
  RoundKind kind_ = RoundKind::end;
  int steps_ = 1;
  alignas(cache_line) std::atomic<std::size_t> left_{0};  // shares that have not finished the round
  alignas(cache_line) std::atomic<std::uint32_t> news_{0};
  std::atomic<int> sleepers_{0};
  std::atomic<bool> failed_{false}, over_{false};
  std::exception_ptr failure_;
};

}  // namespace

void run_rounds(int threads, const Dependencies& items, NextRound begin, const RoundWork& work) {
  Rounds rounds(threads, items, work);  // if fewer threads are granted, they take the others' shares too
  rounds.begin(begin);
  run_team(threads, [&](int thread, int) { rounds.work(std::size_t(thread)); });
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

void for_all(std::size_t n, int threads, const std::function<void(std::size_t)>& work) {
  std::atomic<std::size_t> next{0};
  std::vector<std::exception_ptr> errors(n);
  run_team(std::min(threads, int(std::max<std::size_t>(n, 1))), [&](int, int) {
    for (std::size_t i = next++; i < n; i = next++) try {
        work(i);
      } catch (...) {
        errors[i] = std::current_exception();
      }
  });
  for (const std::exception_ptr& error : errors)
    if (error) std::rethrow_exception(error);
}

}  // namespace voussoir
