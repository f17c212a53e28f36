// What eight lanes do, against the same done lane by lane. Compiled once for registers of this machine, and once each
// for those of four and of two lanes: LANES is the suite's name.
#include <gtest/gtest.h>

#include <array>
#include <limits>

#include "solver/base/lanes.h"

namespace voussoir {

namespace {

using Numbers = std::array<double, lane_count>;

Lanes lanes(const Numbers& x) {
  Lanes l;
  std::memcpy(&l, x.data(), sizeof(l));
  return l;
}
Numbers numbers(const Lanes& l) {
  Numbers x;
  std::memcpy(x.data(), &l, sizeof(x));
  return x;
}
template <class Lane>
Numbers each(const Lane& lane) {
  Numbers x;
  for (std::size_t i = 0; i < x.size(); ++i) x[i] = lane(i);
  return x;
}
/// Lanes whose bit is set.
LaneMask mask_of(unsigned bits) {
  return less(splat(0.0), lanes(each([bits](std::size_t i) { return bits >> i & 1 ? 1.0 : -1.0; })));
}
unsigned bits_in(LaneMask m) {
  unsigned bits = 0;
  for (int i = 0; i < lane_count; ++i) bits |= unsigned(m[i]) << i;
  return bits;
}

constexpr double nan = std::numeric_limits<double>::quiet_NaN();
const Numbers a = {1.5, -2.0, 3.25, 0.0, -0.0, 7.0, 1e300, -4.0}, b = {2.0, -2.0, -1.0, 0.0, 0.0, 9.0, 1e-300, nan};

}  // namespace

TEST(LANES, AddSubtractMultiplyAndDivideEach) {
  const Lanes x = lanes(a), y = lanes({2.0, 3.0, -1.0, 5.0, 8.0, -9.0, 4.0, 0.5});
  const Numbers n = numbers(y);
  EXPECT_EQ(numbers(x + y), each([&](std::size_t i) { return a[i] + n[i]; }));
  EXPECT_EQ(numbers(x - y), each([&](std::size_t i) { return a[i] - n[i]; }));
  EXPECT_EQ(numbers(x * y), each([&](std::size_t i) { return a[i] * n[i]; }));
  EXPECT_EQ(numbers(x / y), each([&](std::size_t i) { return a[i] / n[i]; }));
  EXPECT_EQ(numbers(-x), each([&](std::size_t i) { return -a[i]; }));
  EXPECT_EQ(numbers(2.0 - y), each([&](std::size_t i) { return 2.0 - n[i]; }));
  Lanes sum = x;
  sum += y, sum *= y, sum -= y;
  EXPECT_EQ(numbers(sum), numbers((x + y) * y - y));
  for (int i = 0; i < lane_count; ++i) EXPECT_EQ(x[i], a[std::size_t(i)]);
  sum[5] = 0.25;
  EXPECT_EQ(numbers(sum)[5], 0.25);
}

TEST(LANES, SplatKeepsTheSignOfZero) {
  for (const double x : numbers(splat(-0.0))) EXPECT_TRUE(std::signbit(x));
  EXPECT_EQ(numbers(Lanes{}), Numbers{});
}

TEST(LANES, CompareAsTheirLanesDo) {
  const Lanes x = lanes(a), y = lanes(b);
  for (std::size_t i = 0; i < a.size(); ++i) {
    EXPECT_EQ(less(x, y)[int(i)], a[i] < b[i]) << i;
    EXPECT_EQ(at_most(x, y)[int(i)], a[i] <= b[i]) << i;
    EXPECT_EQ(larger(x, y)[int(i)], a[i] > b[i] ? a[i] : b[i]) << i;
    if (i == 6) break;  // the last is no number
  }
  EXPECT_FALSE(less(x, y)[7]);
  EXPECT_FALSE(at_most(x, y)[7]);
  EXPECT_TRUE((~less(x, y))[7]);
}

TEST(LANES, MagnitudeRootAndSign) {
  const Lanes x = lanes(a);
  EXPECT_EQ(numbers(magnitude(x)), each([](std::size_t i) { return std::abs(a[i]); }));
  EXPECT_EQ(numbers(square_root(magnitude(x))), each([](std::size_t i) { return std::sqrt(std::abs(a[i])); }));
  EXPECT_EQ(numbers(flip(splat(3.0), x)), each([](std::size_t i) { return std::signbit(a[i]) ? -3.0 : 3.0; }));
}

TEST(LANES, EveryMask) {
  for (unsigned bits = 0; bits < 256; ++bits) {
    const LaneMask m = mask_of(bits);
    ASSERT_EQ(bits_in(m), bits);
    EXPECT_EQ(any(m), bits != 0);
    EXPECT_EQ(all(m), bits == 255);
    EXPECT_EQ(count_of(m), __builtin_popcount(bits));
    EXPECT_EQ(bits_in(~m), 255 - bits);
    EXPECT_EQ(numbers(select(m, splat(1.0), splat(2.0))),
              each([bits](std::size_t i) { return bits >> i & 1 ? 1.0 : 2.0; }));
    const LaneMask other = mask_of(0x5a);
    EXPECT_EQ(bits_in(m & other), (bits & 0x5a));
    EXPECT_EQ(bits_in(m | other), (bits | 0x5a));
    EXPECT_EQ(bits_in(m ^ other), (bits ^ 0x5a));
    EXPECT_EQ(bits_in(without(m, other)), (bits & ~0x5au));
    Lanes to = splat(7.0);
    store_lanes(m, lanes(a), to);
    EXPECT_EQ(numbers(to), each([bits](std::size_t i) { return bits >> i & 1 ? a[i] : 7.0; }));
    Singles single = singles(7.0);
    store_lanes(m, singles(3.0), single);
    EXPECT_EQ(numbers(widen(single)), each([bits](std::size_t i) { return bits >> i & 1 ? 3.0 : 7.0; }));
    EXPECT_EQ(numbers(widen(within(m, singles(3.0)))),
              each([bits](std::size_t i) { return bits >> i & 1 ? 3.0 : 0.0; }));
    std::array<std::uint8_t, lane_count> flags;
    store_flags(m, other, flags.data());
    for (std::size_t i = 0; i < flags.size(); ++i) EXPECT_EQ(flags[i], (bits >> i & 1) + 2 * (0x5a >> i & 1));
  }
  for (int count = 0; count <= lane_count; ++count) EXPECT_EQ(bits_in(LaneMask::first(count)), (1u << count) - 1u);
  EXPECT_EQ(bits_in(LaneMask{}), 0u);
}

TEST(LANES, BytesWithBits) {
  const std::array<std::uint8_t, lane_count> bytes = {0, 1, 2, 3, 128, 129, 255, 64};
  for (const int bits : {1, 2, 3, 64, 128}) {
    const LaneMask m = bytes_with(load_bytes(bytes.data()), bits);
    for (std::size_t i = 0; i < bytes.size(); ++i) EXPECT_EQ(m[int(i)], (bytes[i] & bits) != 0) << i << ", " << bits;
  }
  EXPECT_EQ(bits_in(bytes_with(load_bytes(bytes.data(), 6), 255)), 0x3eu);
}

TEST(LANES, NarrowAndWiden) {
  const Numbers x = {1.0, -2.5, 1e-3, 3.0, 4.0, 5.0, 6.0, 1.0 / 3.0};
  EXPECT_EQ(numbers(widen(narrow(lanes(x)))), each([&](std::size_t i) { return double(float(x[i])); }));
  const Pairs p = pair(narrow(lanes(x)), singles(2.0));
  EXPECT_EQ(numbers(widen(low(p + p))), each([&](std::size_t i) { return 2.0 * float(x[i]); }));
  EXPECT_EQ(numbers(widen(high(p * p))), numbers(splat(4.0)));
}

TEST(LANES, HalvesAndColumns) {
  const Lanes x = lanes({0, 1, 2, 3, 4, 5, 6, 7});
  for (int i = 0; i < 4; ++i) {
    EXPECT_EQ(low(x)[i], i);
    EXPECT_EQ(high(x)[i], 4 + i);
  }
  EXPECT_EQ(numbers(pair(high(x), low(x))), (Numbers{4, 5, 6, 7, 0, 1, 2, 3}));
  Lanes rows[lane_count];
  for (std::size_t r = 0; r < lane_count; ++r) rows[r] = lanes(each([r](std::size_t c) { return 10.0 * r + c; }));
  transpose(rows);
  for (std::size_t r = 0; r < lane_count; ++r)
    EXPECT_EQ(numbers(rows[r]), each([r](std::size_t c) { return 10.0 * c + r; }));
}

}  // namespace voussoir
