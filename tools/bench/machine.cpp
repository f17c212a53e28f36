#include "tools/bench/machine.h"

#if defined(__linux__)
#include <sys/mman.h>
#include <sys/resource.h>
#include <time.h>
#include <unistd.h>
#endif

#include <algorithm>
#include <chrono>
#include <cstdlib>
#include <cstring>

#include "solver/base/arrays.h"
#include "solver/base/error.h"
#include "solver/base/lanes.h"
#include "solver/base/parallel.h"

namespace voussoir {

namespace {

using Clock = std::chrono::steady_clock;

/// Shortest wall-clock time (s) of `tries` runs of a team of threads.
template <class Work>
double best_time(int tries, int threads, const Work& work) {
  double best = 1e300;
  for (int i = 0; i < tries; ++i) {
    const auto begin = Clock::now();
    run_team(threads, work);
    best = std::min(best, std::chrono::duration<double>(Clock::now() - begin).count());
  }
  return best;
}

}  // namespace

double copy_bandwidth(double bytes, int threads) {
  const auto n = std::max<std::size_t>(1024, std::size_t(bytes / 16.0));  // half is read, half is written
  const int rounds = int(std::clamp(4e8 / (16.0 * double(n)), 1.0, 20000.0));
  Array<double> from(n, 1.0), to(n, 0.0);
  const double seconds = best_time(7, threads, [&](int thread, int team) {
    const std::size_t begin = n * std::size_t(thread) / std::size_t(team),
                      end = n * std::size_t(thread + 1) / std::size_t(team);
    for (int i = 0; i < rounds; ++i) {
      std::memcpy(&to[begin], &from[begin], (end - begin) * sizeof(double));
      asm volatile("" ::: "memory");
    }
  });
  return 16.0 * double(n) * rounds / seconds;
}

double multiply_add_peak(int threads) {
  // Enough independent chains to hide the latency of a multiply–add, in all registers: 32 of eight lanes, or 16.
  constexpr int chains = register_lanes == lane_count ? 16 : 12 * register_lanes / lane_count, rounds = 2000000;
  const double seconds = best_time(5, threads, [&](int, int) {
    Lanes x[chains];
    for (int c = 0; c < chains; ++c)
      x[c] = splat(2.0 + c);  // not 1: the compiler would remove a computation that does not change the value
    const Lanes a = splat(0.999999), b = splat(1e-6);
    for (int i = 0; i < rounds; ++i)
      for (Lanes& one : x) one = one * a + b;
    Lanes sum = splat(0.0);
    for (const Lanes& one : x) sum += one;
    asm volatile("" ::"m"(sum));
  });
  return 2.0 * lane_count * chains * double(rounds) * threads / seconds;
}

void reserve_memory(double bytes) {
  if (bytes <= 0.0) return;
#if defined(__linux__)
  // The system would grant more memory than it has, and end the program when the memory is written to.
  const double all = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
  if (bytes > 0.9 * all)
    throw InputError("--reserve is {:.1f} GB, but this machine has {:.1f} GB. Give less than nine tenths of that",
                     1e-9 * bytes, 1e-9 * all);
#endif
  constexpr std::size_t page = 4096;
  const auto size = std::size_t(bytes);
  char* memory = static_cast<char*>(std::malloc(size));
  if (!memory) throw InputError("--reserve: the system does not provide {:.1f} GB of memory. Give less", 1e-9 * bytes);
#if defined(__linux__)
  const std::size_t aside = large_page - reinterpret_cast<std::uintptr_t>(memory) % large_page;
  if (size > aside + large_page) madvise(memory + aside, (size - aside) / large_page * large_page, MADV_HUGEPAGE);
#endif
  for (std::size_t at = 0; at < size; at += page) static_cast<volatile char*>(memory)[at] = 1;
  std::free(memory);
}

double processor_time() {
  timespec t;
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &t);
  return double(t.tv_sec) + 1e-9 * double(t.tv_nsec);
}

double peak_memory() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * double(usage.ru_maxrss);
}

}  // namespace voussoir
