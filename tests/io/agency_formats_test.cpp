// Files of ground motion as agencies lay them out, with motions of our own: values in m/s2 by the heading's unit and
// step.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "io/records/format.h"
#include "io/records/sets.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

constexpr int samples = 43;
constexpr double dt = 0.02;

/// m/s2 along x, y, z; without a mean.
double motion(int axis, int k) {
  return (0.5 + 0.25 * axis) * std::sin(2.0 * std::numbers::pi * double(k + 1) * (axis + 1) / samples);
}

std::string fault(const std::string& text) {
  return test::message_of<InputError>([&] { parse_channels(text, "r"); });
}
bool says(const std::string& message, const std::string& words) {
  return message.find(words) != std::string::npos;
}

/// Rows of fixed fields.
std::string rows(int axis, double unit, int width, int digits, int per_row) {
  std::string text;
  for (int k = 0; k < samples; ++k)
    text += fmt::format("{:{}.{}f}{}", motion(axis, k) / unit, width, digits, (k + 1) % per_row == 0 ? "\n" : "");
  return samples % per_row == 0 ? text : text + "\n";
}

void expect_motion(const RecordFile& file, int axis, double tolerance) {
  EXPECT_NEAR(file.record.dt, dt, 1e-12);
  ASSERT_EQ(file.record.values.size(), std::size_t(samples));
  for (int k = 0; k < samples; ++k)
    ASSERT_NEAR(file.record.values[std::size_t(k)] * file.unit, motion(axis, k), tolerance) << k;
}

/// All three along their axes.
void expect_recording(const std::string& name, const std::string& text, double tolerance) {
  const test::Folder folder;
  const std::string path = folder.write(name, text);
  for (const RecordSet& set : {read_record_set({path, "", ""}), read_record_folder(folder.path()).sets.at(0)}) {
    EXPECT_NEAR(set.motion.dt, dt, 1e-12);
    ASSERT_EQ(set.motion.acceleration.size(), std::size_t(samples));
    for (int k = 0; k < samples; ++k)
      for (int axis = 0; axis < 3; ++axis)
        ASSERT_NEAR(set.motion.acceleration[std::size_t(k)][axis], motion(axis, k), tolerance) << k << " " << axis;
  }
}

std::string knet_text(int axis, const std::string& direction, const std::string& change = "",
                      const std::string& to = "") {
  std::string text = fmt::format(
      "Origin Time       2024/01/01 00:00:00\nLat.              37.500\nStation Code      ABC001\n"
      "Sampling Freq(Hz) 50Hz\nDuration Time(s)  {}\nDir.              {}\nScale Factor      3920(gal)/6182761\n"
      "Max. Acc. (gal)   59.858\nMemo.             \n",
      samples * dt, direction);
  if (const std::size_t at = text.find(change); !change.empty() && at != std::string::npos)
    text.replace(at, change.size(), to);
  for (int k = 0; k < samples; ++k)
    text += fmt::format("{:9.0f}{}", 1200.0 + motion(axis, k) * 100.0 * 6182761.0 / 3920.0, k % 8 == 7 ? " \n" : "");
  return text + "\n";
}

TEST(AgencyFormats, Knet) {
  const RecordFile file = parse_record(knet_text(1, "N-S"), "ABC0012401010000.NS");
  EXPECT_EQ(file.format, "K-NET");
  EXPECT_EQ(file.component, "NS");
  EXPECT_EQ(file.station, "ABC001");
  expect_motion(file, 1, 1e-5);
  EXPECT_TRUE(says(fault(knet_text(1, "N-S", "3920(gal)/6182761", "0/0")), "r:7: the scale factor is '0/0'"));
  EXPECT_TRUE(says(fault(knet_text(1, "N-S", "50Hz", "1e-9Hz")), "r:4: the time step is 1e+09 s"));
  EXPECT_TRUE(says(fault(knet_text(1, "N-S", "(s)  0.86", "(s)  300")), "43 samples, but line 5 says 15000"));
  EXPECT_TRUE(
      says(fault(knet_text(1, "N-S", "Scale Factor", "Scale Factr ")), "r:1: the format of this file is not known"));
  // The three files find each other, and so do those of the two sensors of KiK-net.
  const test::Folder folder;
  const char* const words[] = {"E-W", "N-S", "U-D"};
  const char* const ends[] = {"EW", "NS", "UD"};
  for (int axis = 0; axis < 3; ++axis) {
    folder.write(fmt::format("ABC0012401010000.{}", ends[axis]), knet_text(axis, words[axis]));
    for (int sensor : {1, 2})
      folder.write(fmt::format("ABCH022401010000.{}{}", ends[axis], sensor),
                   knet_text(axis,
                             std::to_string((axis == 0   ? 2
                                             : axis == 1 ? 1
                                                         : 3) +
                                            3 * (sensor - 1)),
                             "ABC001", "ABCH02"));
  }
  const RecordFolder found = read_record_folder(folder.path());
  ASSERT_EQ(found.sets.size(), 3u);
  EXPECT_TRUE(found.left_out.empty());
  for (const RecordSet& set : found.sets) EXPECT_NEAR(set.motion.acceleration[7].y(), motion(1, 7), 1e-5) << set.name;
}

std::string smc_text(int axis, double from_vertical, double azimuth, double rate = 1.0 / dt) {
  std::string text = "2 CORRECTED ACCELEROGRAM\n*\nABCD\n2024 001 0000\nNOWHERE\nstation =OLD MILL\n*\n*\n*\n*\n*\n";
  for (int i = 0; i < 48; ++i) {
    const double value = i == 12 ? from_vertical : i == 13 ? azimuth : i == 15 ? 1 : i == 16 ? samples : -32768;
    text += fmt::format("{:10.0f}{}", value, i % 8 == 7 ? "\n" : "");
  }
  for (int i = 0; i < 50; ++i)
    text += fmt::format("{:15.7E}{}", i == 1 ? rate : 1.7e38 * 0.0 - 1e9, i % 5 == 4 ? "\n" : "");
  return text + "|a comment\n" + rows(axis, 0.01, 10, 5, 8);
}

TEST(AgencyFormats, Smc) {
  const RecordFile file = parse_record(smc_text(0, 90, 67), "r.smc");
  EXPECT_EQ(file.format, "SMC");
  EXPECT_EQ(file.component, "67");
  EXPECT_EQ(file.station, "ABCD");
  expect_motion(file, 0, 1e-7);
  EXPECT_EQ(parse_record(smc_text(2, 0, -32768), "r.smc").component, "UP");
  EXPECT_TRUE(says(fault(smc_text(0, 90, 67, 1e-9)), "the time step is 1e+09 s"));
  EXPECT_TRUE(says(fault("3 VELOCITY\n"), "r:1: '3 VELOCITY': use the file with the accelerations"));
}

std::string cosmos_text(int axis, int orientation, int unit_code, double unit) {
  std::string text = "Corrected acceleration     (Format v01.20 with 13 text lines)  Src: X\nNowhere earthquake\n";
  for (int i = 0; i < 11; ++i) text += i == 2 ? "Statn No: 99- 1     Code:XX- ABCD  Old Mill\n" : "text\n";
  text += " 100 Integer-header values follow on  10 lines, Format= (10I8)\n";
  for (int i = 0; i < 100; ++i)
    text += fmt::format("{:8}{}",
                        i == 1    ? 1
                        : i == 2  ? unit_code
                        : i == 53 ? orientation
                                  : -999,
                        i % 10 == 9 ? "\n" : "");
  text += " 100 Real-header values follow on  17 lines, Format= (6F13.6)\n";
  for (int i = 0; i < 100; ++i)
    text += fmt::format("{:13.6f}{}", i == 61 ? 1000.0 * dt : -999.0, i % 6 == 5 || i == 99 ? "\n" : "");
  text += "   1 Comment line follows, which starts with a \"|\":\n|\n";
  text += fmt::format("  {} acceleration pts, approx  1 secs, units=x ({:02}), Format=(6f12.6)\n", samples, unit_code);
  return text + rows(axis, unit, 12, 6, 6) + "End-of-data for channel\n";
}

TEST(AgencyFormats, Cosmos) {
  const std::string x = cosmos_text(0, 90, 4, 0.01), y = cosmos_text(1, 360, 4, 0.01), z = cosmos_text(2, 400, 4, 0.01);
  const RecordFile file = parse_record(x, "r.v2c");
  EXPECT_EQ(file.format, "COSMOS");
  EXPECT_EQ(file.component, "90");
  EXPECT_EQ(file.event, "Nowhere earthquake");
  expect_motion(file, 0, 1e-7);
  expect_motion(parse_record(cosmos_text(1, 360, 2, 9.80665), "r"), 1, 1e-5);
  expect_recording("all.v2c", x + y + z, 1e-7);  // three channels in a file
  EXPECT_TRUE(says(fault(cosmos_text(0, 90, 50, 1e-4)), "the code of the physical units is 50"));
  EXPECT_TRUE(says(fault(x.substr(0, x.size() / 2)), "incomplete"));
}

std::string geonet_channel(int axis, const std::string& component) {
  std::string text = "Corrected accelerogram 20240101_000015_ABCS_20 GNS Science\nSite ABCS\n";
  for (int i = 0; i < 14; ++i)
    text += i == 8    ? fmt::format("Corrected data at {:.3f} sec intervals\n", dt)
            : i == 10 ? "Component " + component + "\n"
                      : "Heading\n";
  for (int i = 0; i < 100; ++i) {
    const bool number = i == 33 || i == 34;  // as many velocities behind the accelerations
    text += i < 40 ? fmt::format("{:8}{}", number ? samples : 0, i % 10 == 9 ? "\n" : "")
                   : fmt::format("{:8.3f}{}", 0.0, i % 10 == 9 ? "\n" : "");
  }
  return text + rows(axis, 0.001, 8, 2, 10) + rows(axis, 0.01, 8, 2, 10);
}

TEST(AgencyFormats, GeoNet) {
  const std::string text = geonet_channel(0, "N90E") + geonet_channel(1, "S00W") + geonet_channel(2, "Up");
  const std::vector<RecordFile> channels = parse_channels(text, "r.V2A");
  ASSERT_EQ(channels.size(), 3u);
  EXPECT_EQ(channels[0].component, "90");
  EXPECT_EQ(channels[1].component, "180");
  EXPECT_EQ(channels[2].component, "UP");
  EXPECT_EQ(channels[0].station, "ABCS");
  for (int axis = 0; axis < 3; ++axis) expect_motion(channels[std::size_t(axis)], axis, 1e-5);
  expect_recording("20240101_000015_ABCS_20.V2A", text, 1e-5);
  EXPECT_TRUE(says(fault(text.substr(0, text.size() - 200)), "incomplete"));
}

TEST(AgencyFormats, TablesOfAfadAndCwa) {
  std::string afad = fmt::format(
      "STRONG GROUND MOTION RECORDS OF NOWHERE\r\nPLACE : SOMEWHERE\r\nSTATION ID : 9999\r\nNUMBER OF DATA : {}\r\n"
      "SAMPLING INTERVAL (sec) : {}\r\nRAW PGA VALUES (gal) : (N-S) 80\r\n       N-S          E-W          U-D\r\n",
      samples, dt);
  std::string cwa = fmt::format(
      "#Earthquake Information:\n#StationCode: ABC\n#StartTime: 2024/01/01\n#SampleRate(Hz): {}\n"
      "#AmplitudeUnit:  gal. DCoffset(corr)\n#DataSequence: Time U(+); N(+); E(+)\n#Data: 4F10.3\n",
      1.0 / dt);
  for (int k = 0; k < samples; ++k) {
    afad += fmt::format("{:12.6f} {:12.6f} {:12.6f}\r\n", 100 * motion(1, k), 100 * motion(0, k), 100 * motion(2, k));
    cwa += fmt::format("{:10.3f}{:10.3f}{:10.3f}{:10.3f}\n", k * dt, 100 * motion(2, k), 100 * motion(1, k),
                       100 * motion(0, k));
  }
  EXPECT_EQ(parse_channels(afad, "r").at(0).format, "AFAD");
  EXPECT_EQ(parse_channels(cwa, "r").at(0).format, "CWA");
  EXPECT_EQ(parse_channels(cwa, "r").at(0).station, "ABC");
  expect_recording("one.txt", afad, 1e-7);
  expect_recording("two.txt", cwa, 1e-5);
  // The unit of the format holds for columns that the user names, too.
  const std::vector<RecordFile> named = parse_channels(afad, "r", dt, {"y", "x", "z"});
  ASSERT_EQ(named.size(), 3u);
  for (const RecordFile& file : named) EXPECT_EQ(file.unit, parse_channels(afad, "r").at(0).unit);
  EXPECT_TRUE(says(fault(afad + "1 2\r\n"), "2 columns, but 3 in the rows before"));
  EXPECT_TRUE(says(fault(afad + "1 2 3\r\n"), "44 samples, but line 4 says 43"));
}

/// Names, units and separators as spreadsheets write them.
TEST(AgencyFormats, ComponentsSideBySideUnderTheirNames) {
  struct Style {
    const char *heading, *between;
    double unit;
    bool comma;
  };
  const Style styles[] = {
      {"Time (s),NS (g),EW (g),UD (g)\n", ",", 9.80665, false},
      {"Station A\n\"Time [ms]\";\"acc_y [cm/s²]\";\"acc_x [cm/s²]\";\"acc_z [cm/s²]\"\n", ";", 0.01, true},
      {"t HNN (m/s^2) HNE (m/s^2) HNZ (m/s^2)\n", "\t", 1.0, true},
      {"# time, N (gal), E (gal), V (gal)\n", " ", 0.01, false}};
  for (const Style& style : styles) {
    const double second = std::string(style.heading).find("[ms]") != std::string::npos ? 1000.0 : 1.0;
    std::string text = style.heading;
    for (int k = 0; k < samples; ++k) {
      std::string row = fmt::format("{:.3f}", k * dt * second);
      for (const int axis : {1, 0, 2}) row += fmt::format("{}{:.9f}", style.between, motion(axis, k) / style.unit);
      if (style.comma) std::ranges::replace(row, '.', ',');
      text += row + "\r\n";
    }
    expect_recording("table.csv", text, 1e-7);
    if (HasFailure()) FAIL() << style.heading;
  }
  EXPECT_TRUE(says(fault("time (s), EW (furlong)\n0 1\n0.1 2\n"), "unit in 'EW (furlong)' is not known"));
  EXPECT_TRUE(says(fault("time, EW, velocity\n0 1 2\n0.1 2 3\n"), "column 'velocity' is not an acceleration"));
  EXPECT_TRUE(says(fault("NS EW\n1 2\n2 3\n"), "neither a column of times nor a time step"));
  EXPECT_EQ(parse_channels("NS EW\n1 2\n2 3\n", "r", 0.01).size(), 2u);
  EXPECT_TRUE(says(fault("time EW\n0 1\n1e5 2\n"), "r:2: the time step is 100000 s"));
}

TEST(AgencyFormats, ColumnsAsTheUserNamesThem) {
  std::string text = "whatever\n";
  for (int k = 0; k < samples; ++k)
    text += fmt::format("{} {} 7 {} {}\n", k * dt, motion(2, k), motion(0, k), motion(1, k));
  const test::Folder folder;
  ColumnsMeaning meaning;
  meaning.columns = {"t", "z", "", "x", "y"};
  const RecordSet set = read_record_set({folder.write("a.txt", text), "", ""}, meaning);
  EXPECT_NEAR(set.motion.acceleration[5].x(), motion(0, 5), 1e-5);
  EXPECT_NEAR(set.motion.acceleration[5].z(), motion(2, 5), 1e-5);
  EXPECT_EQ(set.units, "m/s2");
  meaning.columns = {"t", "x"};
  EXPECT_TRUE(says(test::message_of<InputError>([&] {
                     read_record_set({folder / "a.txt", "", ""}, meaning);
                   }),
                   "5 columns, but 'columns' names 2"));
}

TEST(AgencyFormats, WhatIsNotReadIsNamed) {
  EXPECT_TRUE(says(fault("000001D ABCD  00HNE" + std::string(100, '\0')), "which is miniSEED"));
  EXPECT_TRUE(says(fault("PK\x03\x04 etc"), "unpack it"));
  EXPECT_TRUE(says(fault("UNCORRECTED ACCELEROGRAM DATA\n1 2\n"), "CSMIP volume 1"));
  const std::string message = fault("My own words\nand more of them\n1 2\n2 3\n");
  EXPECT_TRUE(says(message, "r:1: the format of this file is not known. It begins with 'My own words'")) << message;
  // A line without an end is not echoed whole, and no name is as long.
  const std::string endless(200000, 'a');
  for (const std::string& text :
       {"time, EW (" + endless + ")\n0 1\n0.1 2\n", endless + "\n1 2\n",
        "time, EW, vel_" + endless + "\n0 1 2\n1 2 3\n", "7 POINTS OF ACCEL DATA EQUALLY SPACED AT .01 SEC " + endless})
    EXPECT_LT(fault(text).size(), 800u);
  EXPECT_LE(parse_record(knet_text(0, "E-W", "ABC001", endless.substr(0, 500)), "r").station.size(), 100u);
  EXPECT_TRUE(says(message, "K-NET") && says(message, "time (s), EW (g)")) << message;
}

TEST(AgencyFormats, EveryBeginningOfAFileIsReadOrRefused) {
  for (const std::string& whole :
       {knet_text(0, "E-W"), smc_text(0, 90, 67), cosmos_text(0, 90, 4, 0.01), geonet_channel(0, "N90E")})
    for (std::size_t length = 0; length < whole.size(); length += 7) try {
        parse_channels(whole.substr(0, length), "r");
      } catch (const InputError&) {
      }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
