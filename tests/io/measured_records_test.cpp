// Recordings in a folder of field measurements: columns, rates, gaps, units.
#include "tests/io/measured_folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using namespace test;

TEST_F(MeasuredFolder, RecordsInAnyOrderOfColumns) {
  write("sensors.csv", sensors);
  std::string text = "\xef\xbb\xbf# logger 7\r\n\"a3\"; t ;a1\r\n";
  for (int i = 0; i < 100; ++i) text += fmt::format("{};\"{}\"; {} \r\n# x\r\n", i % 7, 5.0 + 0.01 * i, -i);
  write_record(text);
  const Measured m = read();
  EXPECT_EQ(m.records[0].channels, (std::vector<std::string>{"a3", "a1"}));
  EXPECT_NEAR(m.records[0].dt, 0.01, 1e-15);
  EXPECT_EQ(m.records[0].values.rows(), 100);
  EXPECT_EQ(m.records[0].values(99, 0), 1.0);
  EXPECT_EQ(m.records[0].values(99, 1), -99.0);
}

TEST_F(MeasuredFolder, RecordsAreInTheOrderOfTheirNames) {
  int samples = 120;
  for (const char* name : {"c.csv", "a.csv", "b.csv"}) write_record(record({"a1"}, ++samples), name);
  const Measured m = read();
  ASSERT_EQ(m.records.size(), 3u);
  EXPECT_EQ(m.records[0].name, "records/a.csv");
  EXPECT_EQ(m.records[2].name, "records/c.csv");
}

TEST_F(MeasuredFolder, WrongRecords) {
  write("sensors.csv", sensors);
  const std::string good = record({"a1", "a2"});
  EXPECT_EQ(record_problem(good), "");
  const auto with = [&](const std::string& from, const std::string& to) {
    std::string text = good;
    return record_problem(text.replace(text.find(from), from.size(), to));
  };
  expect_begins(with("a2", "a9"),
                "records/wind.csv:1: channel 'a9' is neither a sensor of sensors.csv nor the ground motion: did "
                "you mean 'a1'?");
  expect_begins(with("a2", "base_w"),
                "records/wind.csv:1: channel 'base_w' is neither a sensor of sensors.csv nor the "
                "ground motion: did you mean 'base_x'?");
  expect_begins(with("a2", "a1"), "records/wind.csv:1: two columns have the name 'a1'");
  expect_begins(with("t,", "time,"), "records/wind.csv:1: there is no column 't'");
  expect_begins(record_problem("t\n0\n"), "records/wind.csv:1: there are no channels");
  expect_begins(record_problem(""), "records/wind.csv:1: the file is empty");
  expect_begins(with("\n0.015000,", "\n0.015000,1,"), "records/wind.csv:5: the row has 4 cells, the heading has 3");
  expect_begins(with("\n0.015000,", "\n0.015000 "), "records/wind.csv:5: ");
  expect_begins(with("\n0.015000,", "\n0.015000,nan\n#"),
                "records/wind.csv:5: 'nan' in column 'a1' is not a finite number; fill");
  expect_begins(with("\n0.015000,", "\n0.015000,,1\n#"),
                "records/wind.csv:5: the cell in column 'a1' is empty, but a number is needed; fill");
  expect_begins(with("\n0.015000,", "\n0.015000,1\n#"), "records/wind.csv:5: the row has 2 cells, the heading has 3");
  expect_begins(with("\n0.015000,", "\n0.017000,"),
                "records/wind.csv:5: the time step is 0.007 s here and 0.005 s elsewhere");
  expect_begins(with("\n0.015000,", "\n0.010000,"),
                "records/wind.csv:5: the time 0.01 s follows 0.01 s. Times must increase");
  expect_begins(with("\n0.015000,", "\n#"), "records/wind.csv:6: the time step is 0.01 s here and 0.005 s elsewhere");
  EXPECT_EQ(with("\n0.015000,", "\n0.0150005,"), "");
  expect_begins(record_problem(record({"a1"}, 99)),
                "records/wind.csv:100: the recording ends after 99 samples. At least 100 are needed");
  EXPECT_EQ(record_problem(record({"a1"}, 100)), "");
}

TEST_F(MeasuredFolder, ALongGapIsFoundWhereItIs) {
  std::string text = "t,a1\n";
  for (int i = 0; i < 200; ++i) text += fmt::format("{:.3f},{}\n", 0.01 * i + (i < 150 ? 0.0 : 1000.0), i % 3);
  expect_begins(record_problem(text), "records/wind.csv:152: the time step is 1000.01 s here and 0.01 s elsewhere");
}

TEST_F(MeasuredFolder, ASlowlyChangingRateIsRefused) {
  std::string text = "t,a1\n";
  double t = 0.0;
  for (int i = 0; i < 40000; ++i, t += i < 20000 ? 0.001 : 0.0010015) text += fmt::format("{:.9f},{}\n", t, i % 3);
  expect_holds(record_problem(text), "The sampling rate changes");
}

TEST_F(MeasuredFolder, ConstantChannelsAreSetAside) {
  write("sensors.csv", sensors);
  write_record("t,a1,a2,a3\n", "wind.csv");
  std::string text = "# x\nt,a1,a2,a3\n";
  for (int i = 0; i < 100; ++i) text += fmt::format("{},0,{},2.5\n", 0.01 * i, i % 5);
  write_record(text);
  const Measured m = read();
  ASSERT_EQ(m.set_aside.size(), 2u);  // a1 and a3 are named, so they are not set aside as sensors
  EXPECT_EQ(m.set_aside[0].place, "records/wind.csv:2");
  EXPECT_EQ(m.set_aside[0].what, "channel 'a1' is 0 throughout");
  EXPECT_EQ(m.set_aside[1].what, "channel 'a3' is 2.5 throughout");
  ASSERT_EQ(m.records[0].channels, (std::vector<std::string>{"a2"}));
  ASSERT_EQ(m.records[0].values.cols(), 1);
  EXPECT_EQ(m.records[0].values(3, 0), 3.0);
  text = "t,a1\n";
  for (int i = 0; i < 100; ++i) text += fmt::format("{},0\n", 0.01 * i);
  expect_holds(record_problem(text), "(records/wind.csv:1: no channel of the recording is left)");
}

TEST_F(MeasuredFolder, SuspiciousUnitsAreRemarked) {
  std::string text = "t,a1\n";
  for (int i = 0; i < 100; ++i) text += fmt::format("{},{}\n", 5 * i, i * 10);
  write_record(text);
  const Measured m = read();
  ASSERT_EQ(m.remarks.size(), 3u);
  expect_begins(m.remarks[0], "records/wind.csv: the time step is 5 s");
  expect_begins(m.remarks[1], "records/wind.csv: accelerations reach 990 m/s2");
}

TEST_F(MeasuredFolder, LongWordsMakeShortMessages) {
  write("modes.csv", modes);
  const std::string message = problem("sensors.csv", std::string(300000, 'x') + "\n1\n");
  EXPECT_LT(message.size(), 300u);
  std::string many = "id,x,y,z,direction\n";
  for (int i = 0; i < 3000; ++i) many += fmt::format("sensor{0},{0},0,0,x\n", i);
  write("sensors.csv", many);
  EXPECT_LT(problem("shapes.csv", "mode,sensor,value\n1,q,1\n").size(), 600u);
}
}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
