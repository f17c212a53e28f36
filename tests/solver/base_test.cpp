// Hashes, shares of a loop, teams and rounds; the base's acceleration.
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cstdlib>
#include <new>
#include <numeric>
#include <thread>

#include "solver/base/arrays.h"
#include "solver/base/buckets.h"
#include "solver/base/error.h"
#include "solver/base/parallel.h"
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

TEST(HashArrays, SeesEveryBitNameAndSize) {
  Array<double> x = {1.0, 2.0, 3.0};
  Array<std::uint8_t> flags = {0, 1, 0};
  const auto list = [&] { return std::vector<NamedArray>{{"x", 1, "m", &x}, {"flags", 1, "-", &flags}}; };
  const std::uint64_t h = hash_arrays(list());
  EXPECT_EQ(hash_arrays(list()), h);
  for (double& value : x) {
    const double kept = value;
    value = std::nextafter(value, 10.0);
    EXPECT_NE(hash_arrays(list()), h);
    value = kept;
  }
  flags[2] = 1;
  EXPECT_NE(hash_arrays(list()), h);
  flags[2] = 0;
  EXPECT_NE(hash_arrays({{"y", 1, "m", &x}, {"flags", 1, "-", &flags}}), h);
  EXPECT_NE(hash_arrays({{"flags", 1, "-", &flags}, {"x", 1, "m", &x}}), h);
  x.push_back(0.0);
  EXPECT_NE(hash_arrays(list()), h);
}

TEST(HashArrays, TellsZeroFromMinusZero) {
  Array<double> x = {0.0};
  const std::uint64_t h = hash_arrays({{"x", 1, "m", &x}});
  x[0] = -0.0;
  EXPECT_NE(hash_arrays({{"x", 1, "m", &x}}), h);
}

/// Many to a place, none, and equal ones.
TEST(SortByPlace, GivesTheOrderOfSort) {
  for (const std::size_t n : {0u, 1u, 2u, 500u}) {
    std::vector<std::pair<std::int32_t, std::int32_t>> list;
    for (std::size_t i = 0; i < n; ++i)
      list.emplace_back(std::int32_t(i * 2654435761u % 97u % 40u), std::int32_t(i * 40503u % 11u));
    auto sorted = list;
    std::sort(sorted.begin(), sorted.end());
    sort_by_place(list, 64, [](const auto& item) { return item.first; });
    EXPECT_EQ(list, sorted) << n;
  }
}

TEST(ShareOut, EveryItemOnce) {
  for (const std::size_t n : {0u, 1u, 7u, 8u, 1000u})
    for (const int threads : {1, 2, 3, 8, 13}) {
      std::vector<int> done(n, 0);
      std::vector<std::size_t> by(std::size_t(threads), 0);
      share_out(n, threads, 2, [&](int thread, Range range) {
        for (std::size_t i = range.begin; i < range.end; ++i) ++done[i], ++by.at(std::size_t(thread));
      });
      EXPECT_EQ(done, std::vector<int>(n, 1)) << threads << " threads";
      EXPECT_EQ(std::accumulate(by.begin(), by.end(), std::size_t(0)), n);
    }
}

TEST(ShareOut, NoThreadForLessThanIsWorthIt) {
  share_out(99, 8, 50, [&](int thread, Range range) {
    EXPECT_EQ(thread, 0);
    EXPECT_EQ(range.end - range.begin, 99u);
  });
}

TEST(Team, EveryThreadOnce) {
  for (const int threads : {1, 2, 3, 8}) {  // more than the machine has, on most
    std::vector<int> ran(std::size_t(threads), 0);
    run_team(threads, [&](int thread, int team) {
      EXPECT_EQ(team, threads);
      ++ran[std::size_t(thread)];
    });
    EXPECT_EQ(ran, std::vector<int>(std::size_t(threads), 1));
  }
}

TEST(Team, ThrowsAgainWhatAThreadThrew) {
  for (const int threads : {1, 2, 3}) {
    std::atomic<int> ran{0};
    const auto work = [&](int thread, int team) {
      ++ran;
      if (thread > 0 || team == 1) throw RunError("thread {}", thread);
    };
    try {
      run_team(threads, work);
      ADD_FAILURE() << "nothing thrown";
    } catch (const RunError& e) {
      EXPECT_EQ(e.what(), std::string(threads == 1 ? "thread 0." : "thread 1."));
    }
    EXPECT_EQ(ran.load(), threads);
  }
  const auto without_memory = [](std::size_t i) {
    if (i == 90) throw std::bad_alloc();
  };
  EXPECT_THROW(for_each(100, 2, 10, without_memory), std::bad_alloc);
}

/// Items in a row, each followed by the next two.
Dependencies chain(std::size_t n) {
  Dependencies items;
  items.followers.resize(n);
  items.waits.assign(n, 1);
  items.cost.assign(n, 1.0);
  for (std::size_t i = 0; i < n; ++i)
    for (std::size_t next = i + 1; next < std::min(n, i + 3); ++next) {
      items.followers[i].push_back(std::int32_t(next));
      ++items.waits[next];
    }
  return items;
}

/// Every item passes both stages once a round, none its second before the first of those it waits for; plain numbers
/// written in one stage are seen in the next.
void go_round(int threads, std::size_t n, int rounds) {
  const Dependencies items = chain(n);
  std::vector<int> first(n, 0), between(n, 0), second(n, 0);
  std::atomic<int> wrong{0};
  int round = 1, sampled = 0;
  RoundWork work;
  work.first = [&](std::size_t i, int) { wrong += ++first[i] != round; };
  work.between = [&](std::size_t i) { ++between[i]; };
  work.second = [&](std::size_t i, int) {
    for (std::size_t before = i < 2 ? 0 : i - 2; before <= i; ++before) wrong += first[before] != round;
    wrong += ++second[i] != round;
  };
  work.next = [&](RoundKind done) -> NextRound {
    if (done == RoundKind::first_only) return RoundKind::between;
    if (done == RoundKind::between) return ++sampled, RoundKind::second_only;
    if (++round > rounds) return RoundKind::end;
    return round % 5 == 0 ? RoundKind::first_only : RoundKind::both;
  };
  run_rounds(threads, items, RoundKind::both, work);
  EXPECT_EQ(wrong.load(), 0);
  EXPECT_EQ(sampled, rounds / 5);
  EXPECT_EQ(first, std::vector<int>(n, rounds));
  EXPECT_EQ(second, std::vector<int>(n, rounds));
  EXPECT_EQ(between, std::vector<int>(n, sampled));
}

TEST(Rounds, EveryItemOnceAndInOrder) {
  go_round(1, 17, 200);
  go_round(2, 17, 20000);
  go_round(2, 1, 500);
  go_round(3, 100, 2000);
  go_round(8, 5, 500);  // more threads than items
}

/// Rounds of several steps: each item goes as far as those it reads and those that read it let it, no farther.
void go_ahead(int threads, std::size_t n, int rounds) {
  const Dependencies items = chain(n);
  constexpr int steps[] = {1, 5, 8, 2, 3};
  std::vector<int> first(n, 0), second(n, 0);
  std::atomic<int> wrong{0}, ahead{0};
  int round = 0, done = 0, all = 0;
  RoundWork work;
  work.first = [&](std::size_t i, int step) {
    wrong += first[i]++ != done + step || second[i] != done + step;
    for (const std::int32_t follower : items.followers[i]) wrong += second[std::size_t(follower)] != done + step;
    if (threads == 1 && i > 0) ahead += second[0] > done + step;
  };
  work.second = [&](std::size_t i, int step) {
    for (std::size_t before = i < 2 ? 0 : i - 2; before <= i; ++before) wrong += first[before] != done + step + 1;
    wrong += second[i]++ != done + step;
  };
  work.next = [&](RoundKind) -> NextRound {
    done = all;
    if (round++ == rounds) return RoundKind::end;
    all += steps[round % 5];
    return {RoundKind::both, steps[round % 5]};
  };
  all = 4;
  run_rounds(threads, items, {RoundKind::both, 4}, work);
  EXPECT_EQ(wrong.load(), 0);
  EXPECT_EQ(first, std::vector<int>(n, done));
  EXPECT_EQ(second, std::vector<int>(n, done));
  if (threads == 1 && n > 20) {
    EXPECT_GT(ahead.load(), 0) << "nobody was ahead of anybody";
  }
}

TEST(Rounds, ItemsGoAheadOfEachOther) {
  go_ahead(1, 100, 200);
  go_ahead(2, 100, 2000);
  go_ahead(2, 1, 500);
  go_ahead(3, 130, 1000);
  go_ahead(8, 5, 300);
}

/// A runtime that grants fewer threads than asked for (OMP_THREAD_LIMIT, OMP_DYNAMIC, a caller that is parallel
/// already) must not leave a round waiting for threads that never came.
TEST(Rounds, DoNotHangWhenFewerThreadsAreGranted) {
  GTEST_FLAG_SET(death_test_style, "threadsafe");  // the child starts afresh and reads the variable
  setenv("OMP_THREAD_LIMIT", "1", 1);
  const auto child = [] {
    alarm(5);
    go_round(4, 17, 100);
    std::_Exit(testing::Test::HasFailure());
  };
  EXPECT_EXIT(child(), testing::ExitedWithCode(0), "");
  unsetenv("OMP_THREAD_LIMIT");
}

TEST(Rounds, AnExceptionBetweenThemEndsThem) {
  for (int threads : {1, 3}) {
    int ends = 0;
    RoundWork work;
    work.first = work.second = [](std::size_t, int) {};
    work.next = [&](RoundKind) -> NextRound {
      if (++ends == 7) throw RunError("the disk is full");
      return RoundKind::both;
    };
    EXPECT_THROW(run_rounds(threads, chain(10), RoundKind::both, work), RunError);
    EXPECT_EQ(ends, 7);
  }
}

TEST(Rounds, AnExceptionOfAnItemEndsThem) {
  for (const int threads : {1, 3})
    for (const bool in_first : {true, false}) {
      std::atomic<int> calls{0};
      RoundWork work;
      work.first = work.second = [](std::size_t, int) {};
      (in_first ? work.first : work.second) = [&](std::size_t i, int) {
        if (++calls > 100 && i % 2 == 0) throw std::bad_alloc();  // several threads at once
      };
      work.next = [](RoundKind) { return NextRound(RoundKind::both, 3); };
      EXPECT_THROW(run_rounds(threads, chain(10), RoundKind::both, work), std::bad_alloc);
    }
}

TEST(BaseAcceleration, IsLinearBetweenSamplesAndZeroOutside) {
  GroundMotion motion;
  motion.dt = 0.01;
  motion.acceleration = {{1, 0, 0}, {3, 2, 0}, {-1, 0, 4}};
  EXPECT_EQ(base_acceleration(&motion, -1e-9), Vec3(0, 0, 0));
  EXPECT_EQ(base_acceleration(&motion, 0.0), Vec3(1, 0, 0));
  EXPECT_LT((base_acceleration(&motion, 0.0025) - Vec3(1.5, 0.5, 0)).norm(), 1e-12);
  EXPECT_LT((base_acceleration(&motion, 0.01) - Vec3(3, 2, 0)).norm(), 1e-12);
  EXPECT_LT((base_acceleration(&motion, 0.019) - Vec3(-0.6, 0.2, 3.6)).norm(), 1e-12);
  EXPECT_LT((base_acceleration(&motion, 0.02) - Vec3(-1, 0, 4)).norm(), 1e-12);
  EXPECT_EQ(base_acceleration(&motion, 0.0200001), Vec3(0, 0, 0));
  EXPECT_EQ(base_acceleration(nullptr, 0.01), Vec3(0, 0, 0));
}

/// The base's velocity and displacement are the leapfrog sums of the acceleration: v = Σ dt a, and a constant
/// acceleration from rest gives a dt² n (n + 1)/2.
TEST(BaseMotion, IsIntegratedLikeTheBlocks) {
  Assembly assembly = stone();
  add_box(assembly, {0, 0, -1}, {1, 1, 0}, true);
  add_box(assembly, {0, 0, 0}, {1, 1, 1});
  Bench bench(joined(std::move(assembly), 1e9, 4e8, elastic_law()));
  GroundMotion motion;
  motion.dt = 1.0;
  motion.acceleration = {{2, 0, 0}, {2, 0, 0}};
  bench.begin();
  bench.stepper.motion = &motion;
  ASSERT_TRUE(bench.run(100));
  const double dt = bench.stepper.dt;
  EXPECT_NEAR(bench.state.base_velocity().x(), 2 * 100 * dt, 1e-12);
  EXPECT_NEAR(bench.state.base_displacement().x(), dt * dt * 100 * 101, 1e-12);
  EXPECT_EQ(bench.displacement(0), Vec3(bench.state.base_displacement()));
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
