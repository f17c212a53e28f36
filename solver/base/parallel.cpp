#include "solver/base/parallel.h"

#include <omp.h>
#include <unistd.h>

#include <cstdlib>
#include <optional>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

namespace voussoir {

void ensure_passive_waiting(char** argv) {
  if (std::getenv("OMP_WAIT_POLICY")) return;
  setenv("OMP_WAIT_POLICY", "passive", 1);
  execv("/proc/self/exe", argv);  // returns only on failure: then the default policy stays, which is slower, not wrong
}

int available_threads() {
  return omp_get_num_procs();
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
}  // namespace

void Barrier::wait() {
  if (threads_ == 1) return;
  const int generation = generation_.load(std::memory_order_acquire);
  if (arrived_.fetch_add(1, std::memory_order_acq_rel) + 1 == threads_) {
    arrived_.store(0, std::memory_order_relaxed);
    generation_.store(generation + 1, std::memory_order_release);
    generation_.notify_all();
    return;
  }
  for (int i = 0; i < spins; ++i) {
    if (generation_.load(std::memory_order_acquire) != generation) return;
    pause_briefly();
  }
  generation_.wait(generation, std::memory_order_acquire);
}

void run_team(int threads, const std::function<void(int, int, Barrier&)>& work) {
  std::optional<Barrier> barrier;
  if (threads == 1) {
    work(0, 1, barrier.emplace(1));
    return;
  }
  // These order what OpenMP's fork, barrier and join order anyway, in words that the thread sanitizer understands.
  // Static, so that they are never made anew while a thread of the team before still looks.
  static std::atomic<int> begun, ready, ended;
  begun.fetch_add(1, std::memory_order_release);
#pragma omp parallel num_threads(threads)
  {
    begun.load(std::memory_order_acquire);
    if (omp_get_thread_num() == 0) {
      barrier.emplace(omp_get_num_threads());  // the runtime may grant fewer than asked for
      ready.fetch_add(1, std::memory_order_release);
    }
#pragma omp barrier
    ready.load(std::memory_order_acquire);
    work(omp_get_thread_num(), omp_get_num_threads(), *barrier);
    ended.fetch_add(1, std::memory_order_release);
  }
  ended.load(std::memory_order_acquire);
}

}  // namespace voussoir
