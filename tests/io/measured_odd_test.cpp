// What is odd in a folder of measurements, but can be read: it is set aside or remarked, never dropped in silence.
#include <functional>

#include "tests/io/measured_folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using namespace test;

/// A recording of a1, a2 and a3 at 100 samples a second, a sum of sines each, changed by `spoil(sample, channel,
/// value)`.
std::string spoilt(int samples, const std::function<double(int, int, double)>& spoil, const std::string& more = "") {
  std::string text = "t,a1,a2,a3" + more + "\n";
  for (int i = 0; i < samples; ++i) {
    text += fmt::format("{:.2f}", 0.01 * i);
    for (int c = 0; c < (more.empty() ? 3 : 4); ++c)
      text += fmt::format(",{:.6g}", spoil(i, c, std::sin(0.31 * i + c) + 0.5 * std::sin(0.97 * i * (1 + c))));
    text += "\n";
  }
  return text;
}

class OddMeasurements : public MeasuredFolder {
 protected:
  void SetUp() override { write("sensors.csv", sensors); }
  Measured read_spoilt(const std::function<double(int, int, double)>& spoil, const std::string& more = "") {
    write_record(spoilt(2400, spoil, more));
    return read();
  }
};

TEST_F(OddMeasurements, GoodChannelsAreLeftAlone) {
  const Measured m = read_spoilt([](int, int, double x) { return x; });
  EXPECT_TRUE(m.set_aside.empty());
  EXPECT_TRUE(m.remarks.empty());
  EXPECT_EQ(m.records[0].channels.size(), 3u);
}

/// A digit is all that a coarse instrument shows of a small motion: it stands still for a few samples, and often at its
/// largest value, but seldom more often than at the next.
TEST_F(OddMeasurements, CoarseDigitsAreNoLimits) {
  const Measured m = read_spoilt([](int i, int, double x) { return std::round((3.0 + std::sin(0.01 * i)) * x) / 4.0; });
  EXPECT_TRUE(m.set_aside.empty());
  EXPECT_TRUE(m.remarks.empty());
}

TEST_F(OddMeasurements, ChannelsAtTheirLimitAreSetAside) {
  const auto clipped = [&](double limit) {
    return read_spoilt([=](int, int c, double x) { return c == 1 ? std::clamp(5.0 * x, -limit, limit) : x; });
  };
  const Measured much = clipped(1.0);
  ASSERT_EQ(much.set_aside.size(), 1u);
  EXPECT_EQ(much.set_aside[0].place, "records/wind.csv:1");
  expect_begins(much.set_aside[0].what, "channel 'a2' is cut off at ");
  expect_holds(much.set_aside[0].what, "the limit of the instrument");
  EXPECT_EQ(much.records[0].channels, (std::vector<std::string>{"a1", "a3"}));
}

TEST_F(OddMeasurements, AFewSamplesAtALimitAreRemarked) {
  const Measured m =
      read_spoilt([](int i, int c, double x) { return c == 2 && i % 600 >= 100 && i % 600 < 104 ? 9.5 : x; });
  EXPECT_TRUE(m.set_aside.empty());
  ASSERT_EQ(m.remarks.size(), 1u);
  expect_begins(m.remarks[0], "records/wind.csv: channel 'a3' is cut off at 9.5 from row 102 on, 4 times");
}

TEST_F(OddMeasurements, ChannelsThatStandStillAreSetAside) {
  const auto still = [&](int until) {
    return read_spoilt([=](int i, int c, double x) { return c == 0 && i >= 500 && i < until ? 0.25 : x; });
  };
  const Measured longer = still(1500), shorter = still(610);
  ASSERT_EQ(longer.set_aside.size(), 1u);
  expect_begins(longer.set_aside[0].what,
                "channel 'a1' is constant at 0.25 from row 502 on, in all for 41.7 % of the recording");
  EXPECT_EQ(longer.records[0].channels, (std::vector<std::string>{"a2", "a3"}));
  ASSERT_EQ(shorter.remarks.size(), 1u);
  expect_begins(shorter.remarks[0],
                "records/wind.csv: channel 'a1' is constant at 0.25 from row 502 on, in all for 4.58 %");
}

/// Before an earthquake all is still, and with the ground it may be.
TEST_F(OddMeasurements, WithTheGroundsMotionTheyMay) {
  const Measured m = read_spoilt([](int i, int, double x) { return i < 1500 ? 0.0 : x; }, ",base_y");
  EXPECT_TRUE(m.set_aside.empty());
  EXPECT_TRUE(m.remarks.empty());
}

TEST_F(OddMeasurements, OneChannelUnderTwoNamesIsNone) {
  const Measured m =
      read_spoilt([](int i, int c, double x) { return c == 2 ? std::sin(0.31 * i) + 0.5 * std::sin(0.97 * i) : x; });
  ASSERT_EQ(m.set_aside.size(), 2u);
  EXPECT_EQ(m.set_aside[0].what,
            "channel 'a1' has the same samples as 'a3'; the program cannot tell to which sensor they belong");
  expect_begins(m.set_aside[1].what, "channel 'a3' has the same samples as 'a1'");
  EXPECT_EQ(m.records[0].channels, (std::vector<std::string>{"a2"}));
}

TEST_F(OddMeasurements, ARecordingThatIsThereTwiceCountsOnce) {
  const std::string text = record({"a1", "a2", "a3"});
  write_record(text, "a.csv");
  write_record(text, "b.csv");
  write_record(record({"a1", "a2"}), "c.csv");
  const Measured m = read();
  ASSERT_EQ(m.records.size(), 2u);
  ASSERT_EQ(m.set_aside.size(), 1u);
  EXPECT_EQ(m.set_aside[0].place, "records/b.csv:1");
  EXPECT_EQ(m.set_aside[0].what, "the same samples as records/a.csv");
}

TEST_F(OddMeasurements, SensorsWithoutReadingsAreNamed) {
  write_record(record({"a1", "a3"}));
  Measured m = read();
  ASSERT_EQ(m.set_aside.size(), 1u);
  EXPECT_EQ(m.set_aside[0].place, "sensors.csv:3");
  EXPECT_EQ(m.set_aside[0].what, "no recording and no shape names sensor 'a2'");
  std::filesystem::remove_all(folder / "records");
  write("modes.csv", modes);
  m = read();
  ASSERT_EQ(m.set_aside.size(), 1u);
  EXPECT_EQ(m.set_aside[0].place, "sensors.csv");
  EXPECT_EQ(m.set_aside[0].what, "no recording and no shape names any of the 3 sensors");
  write("shapes.csv", shapes);
  EXPECT_TRUE(read().set_aside.empty());
}

TEST_F(OddMeasurements, AModeThatIsThereTwiceCountsOnce) {
  write("modes.csv", "mode,frequency\n1,2.5\n2,3.1\nx,2.5\n");
  write("shapes.csv", "mode,sensor,value\n1,a1,1\n1,a2,0.5\n1,a3,0.1\nx,a1,2\nx,a2,1\nx,a3,0.2\n");
  Measured m = read();
  ASSERT_EQ(m.modes.size(), 2u);
  ASSERT_EQ(m.set_aside.size(), 1u);
  EXPECT_EQ(m.set_aside[0].place, "modes.csv:4");
  expect_begins(m.set_aside[0].what, "mode 'x' repeats mode '1' of row 2");
  write("shapes.csv", "mode,sensor,value\n1,a1,1\n1,a2,0.5\n1,a3,0.1\nx,a1,2\nx,a2,-1\nx,a3,0.2\n");
  m = read();
  EXPECT_EQ(m.modes.size(), 3u);  // two modes of one frequency
  EXPECT_TRUE(m.set_aside.empty());
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
