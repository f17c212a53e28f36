// Files of ground motion by their formats.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <filesystem>

#include "io/records/format.h"
#include "io/records/sets.h"
#include "solver/base/error.h"
#include "tests/folder.h"
namespace voussoir {
namespace VOUSSOIR_FILE {

/// Samples that are easy to tell: k/1000, the sign by turns.
double sample(int k) {
  return (k % 2 ? -0.001 : 0.001) * k;
}

std::string at2(const std::string& sizes, int samples) {
  std::string text =
      "PEER NGA STRONG MOTION DATABASE RECORD\r\nNowhere-02, 1/2/2003, Old Mill, 3\r\n"
      "ACCELERATION TIME SERIES IN UNITS OF G\r\n" +
      sizes + "\r\n";
  for (int k = 0; k < samples; ++k) {
    text += fmt::format("{:15.7E}", sample(k));
    if (k % 5 == 4) text += "\r\n";
  }
  return text + "\r\n";
}

std::string dyna_text(int samples, const std::string& change = "", const std::string& to = "") {
  std::string text =
      "EVENT_NAME: NOWHERE 3RD SHOCK\nSTATION_CODE: NOW\nSAMPLING_INTERVAL_S: 0.005000\nNDATA: 6\nSTREAM: HNE\n"
      "UNITS: cm/s^2\nDATA_TYPE: ACCELERATION\nUSER1: /a/b:c\nUSER2: \n";
  if (const std::size_t at = text.find(change); !change.empty() && at != std::string::npos)
    text.replace(at, change.size(), to);
  for (int k = 0; k < samples; ++k) text += fmt::format("{:.6f}\n", sample(k));
  return text;
}

/// Eight a row, as wide as their columns.
std::string csmip_text(int samples, const std::string& line) {
  std::string text =
      "CORRECTED ACCELEROGRAM   01336       CHAN  1: UP          FROM   \nUNCORRECTED\nNOWHERE, CA  EARTHQUAKE   \n"
      "DATE\nNUMBER\nPLACE\nOLD MILL  \n    1    2    3\n" +
      line + "\n";
  for (int k = 0; k < samples; ++k) {
    text += fmt::format("{:10.3f}", k % 2 ? -10000.0 - k : k);
    if (k % 8 == 7) text += "   \n";
  }
  return text + "\n    3 POINTS OF VELOC DATA EQUALLY SPACED AT  .010 SEC.  (UNITS: CM/SEC)\n 1 2 3\n";
}
const std::string csmip_line = "   19 POINTS OF ACCEL DATA EQUALLY SPACED AT  .010 SEC.  (UNITS: CM/SEC/SEC)";

std::string fault(const std::string& text) {
  return test::message_of<InputError>([&] { parse_record(text, "r"); });
}
bool says(const std::string& message, const std::string& words) {
  return message.find(words) != std::string::npos;
}

TEST(Records, PeerAt2) {
  for (const std::string sizes : {"NPTS=     13, DT=   .0024 SEC,", "  13  .0024   NPTS, DT"}) {
    const RecordFile file = parse_record(at2(sizes, 13), "r.AT2");
    EXPECT_EQ(file.format, "PEER AT2");
    EXPECT_EQ(file.unit, 9.80665);
    EXPECT_EQ(file.record.dt, 0.0024);
    ASSERT_EQ(file.record.values.size(), 13u);
    for (int k = 0; k < 13; ++k) EXPECT_DOUBLE_EQ(file.record.values[std::size_t(k)], sample(k));
    EXPECT_EQ(file.event, "Nowhere-02");
    EXPECT_EQ(file.station, "Old Mill");
    EXPECT_EQ(file.component, "3");
  }
  // Rounded steps: the user knows better.
  EXPECT_EQ(parse_record(at2("NPTS= 13, DT= .0024 SEC", 13), "r", 1.0 / 409.6).record.dt, 1.0 / 409.6);
  EXPECT_TRUE(says(fault(at2("NPTS= 14, DT= .0024 SEC", 13)), "13 samples, but line 4 says 14"));
  EXPECT_TRUE(says(fault(at2("NPTS, DT", 13)), "r:4: 'NPTS, DT' does not state the number of samples"));
  EXPECT_TRUE(says(fault(at2("NPTS= 13, DT= 0 SEC", 13)), "r:4:"));
  std::string velocity = at2("NPTS= 13, DT= .0024 SEC", 13);
  velocity.replace(velocity.find("ACCELERATION"), 12, "VELOCITY    ");
  EXPECT_TRUE(says(fault(velocity), "r:3: 'VELOCITY"));
  EXPECT_TRUE(
      says(fault(at2("NPTS= 13, DT= 1e5 SEC", 13)), "r:4: the time step is 100000 s. It must be from 1e-05 to 1 s"));
  EXPECT_TRUE(says(fault(at2("NPTS= 1e300, DT= .01 SEC", 13)), "r:4: the number 1E300 is too large"));
  EXPECT_TRUE(
      says(fault(at2("NPTS= 1e9, DT= .01 SEC", 13)), "r:4: the number of samples is 1e+09. It must be a whole number"));
  std::string huge = at2("NPTS= 13, DT= .0024 SEC", 13);
  huge.replace(huge.rfind("1.2000000E-02"), 13, "1.2000000E308");
  EXPECT_TRUE(says(fault(huge), "r:7: the number 1.2000000E308 is too large. It must be at most 1e+12"));
  std::string damaged = at2("NPTS= 13, DT= .0024 SEC", 13);
  damaged.replace(damaged.rfind("E-0"), 3, "NaN");
  EXPECT_TRUE(says(fault(damaged), "r:7: '"));
}

TEST(Records, ItacaAndEsm) {
  const RecordFile file = parse_record(dyna_text(6), "r.ASC");
  EXPECT_EQ(file.format, "ITACA/ESM ASCII");
  EXPECT_EQ(file.unit, 0.01);
  EXPECT_EQ(file.record.dt, 0.005);
  ASSERT_EQ(file.record.values.size(), 6u);
  EXPECT_DOUBLE_EQ(file.record.values[5], -0.005);
  EXPECT_EQ(file.event, "NOWHERE 3RD SHOCK");
  EXPECT_EQ(file.component, "HNE");
  EXPECT_EQ(parse_record(dyna_text(6, "ACCELERATION", "Acceleration"), "r").record.values.size(), 6u);
  EXPECT_EQ(parse_record(dyna_text(6, "EVENT_NAME", "Event_Name"), "r").event, "NOWHERE 3RD SHOCK");
  EXPECT_TRUE(says(fault(dyna_text(5)), "5 samples, but NDATA is 6"));
  EXPECT_TRUE(says(fault(dyna_text(6, "ACCELERATION", "VELOCITY")), "DATA_TYPE is 'VELOCITY'"));
  EXPECT_TRUE(says(fault(dyna_text(6, "ACCELERATION", "ACCELERATION RESPONSE SPECTRUM")), "DATA_TYPE is"));
  EXPECT_TRUE(says(fault(dyna_text(6, "cm/s^2", "g")), "UNITS is 'g', expected cm/s^2"));
  EXPECT_TRUE(says(fault(dyna_text(6, "NDATA: 6\n", "")), "no line 'NDATA:'"));
  EXPECT_TRUE(says(fault(dyna_text(6, "0.005000", "soon")), "r:3: 'soon' is not a number"));
  EXPECT_TRUE(says(fault(dyna_text(6, "0.005000", "0")), "r:3: the time step is 0 s. It must be from 1e-05 to 1 s"));
}

TEST(Records, CsmipInFixedColumns) {
  const RecordFile file = parse_record(csmip_text(19, csmip_line), "r.V2");
  EXPECT_EQ(file.format, "CSMIP V2");
  EXPECT_EQ(file.unit, 0.01);
  EXPECT_EQ(file.record.dt, 0.01);
  ASSERT_EQ(file.record.values.size(), 19u);
  for (int k = 0; k < 19; ++k) EXPECT_EQ(file.record.values[std::size_t(k)], k % 2 ? -10000.0 - k : k);
  EXPECT_EQ(file.event, "NOWHERE, CA  EARTHQUAKE");
  EXPECT_EQ(file.station, "OLD MILL");
  EXPECT_EQ(file.component, "1: UP");
  EXPECT_TRUE(says(fault(csmip_text(11, csmip_line)), "after 11 of 19 samples a row has fewer than 8"));
  EXPECT_TRUE(says(fault(csmip_text(19, "1e300" + csmip_line.substr(5))), "r:9: the number 1E300 is too large"));
  EXPECT_TRUE(says(fault(csmip_text(19, csmip_line) + csmip_line), "0 of 19 samples"));
  EXPECT_TRUE(says(fault(csmip_text(19, csmip_line.substr(0, 60))), "r:9:"));
}

/// Small letters, the layout in the line, a width of its own, and three channels one after the other.
TEST(Records, CsmipOfAnyAgeWithAllChannels) {
  std::string text;
  for (const char* channel : {"1: 90 Deg", "2: Up", "3: 360 Deg"}) {
    text += fmt::format("Corrected accelerogram  XX0001   Chan  {}   \nUncorrected\nNowhere Earthquake\n", channel);
    text += "Date\nNumber\nStation\nOld Mill\n";
    text += "   11 points of accel data equally spaced at  .005 sec, in cm/sec2.    (5f12.4)\n";
    for (int k = 0; k < 11; ++k) text += fmt::format("{:12.4f}{}", 1000.0 * sample(k), k % 5 == 4 ? "\n" : "");
    text +=
        "\n   11 points of veloc data equally spaced at  .005 sec, in cm/sec.    (5f12.4)\n 1 2 3\n/& -- End of data\n";
  }
  const std::vector<RecordFile> channels = parse_channels(text, "r.V2");
  ASSERT_EQ(channels.size(), 3u);
  for (const RecordFile& channel : channels) {
    EXPECT_EQ(channel.format, "CSMIP V2");
    EXPECT_EQ(channel.unit, 0.01);
    EXPECT_EQ(channel.record.dt, 0.005);
    ASSERT_EQ(channel.record.values.size(), 11u);
    for (int k = 0; k < 11; ++k) EXPECT_NEAR(channel.record.values[std::size_t(k)], 1000.0 * sample(k), 1e-9);
  }
  EXPECT_EQ(channels[1].component, "2: Up");
  EXPECT_EQ(channels[2].station, "Old Mill");
  EXPECT_TRUE(says(fault(text), "3 channels, expected one"));
  // A file of three channels is a recording.
  const test::Folder folder;
  const RecordSet set = read_record_set({folder.write("one.V2", text), "", ""});
  EXPECT_EQ(set.components, (std::array<std::string, 3>{"90", "360", "UP"}));
  EXPECT_NEAR(set.motion.acceleration[4].z(), 0.01 * 1000.0 * sample(4), 1e-12);
  EXPECT_EQ(read_record_folder(folder.path()).sets.size(), 1u);
}

TEST(Records, OthersAreColumns) {
  EXPECT_EQ(parse_record("0 1\n0.1 2\n", "r").format, "columns");
  EXPECT_EQ(parse_record("0 1\n0.1 2\n", "r").unit, 0.0);
  EXPECT_EQ(parse_record("1\r\n2\r\n\r\n", "r", 0.005).record.values.size(), 2u);
}

TEST(Records, EveryBeginningOfAFileIsReadOrRefused) {
  for (const std::string& whole : {at2("NPTS=     13, DT=   .0024 SEC,", 13), dyna_text(6), csmip_text(19, csmip_line)})
    for (std::size_t length = 0; length < whole.size(); ++length) {
      try {
        parse_record(whole.substr(0, length), "r");
      } catch (const InputError&) {
      }
    }
}

/// Real files, where they are at hand: their own headings say their peaks.
TEST(Records, RealFiles) {
  const std::string folder = VOUSSOIR_SOURCE_DIR "/../shared/records";
  if (!std::filesystem::is_directory(folder)) GTEST_SKIP() << "no real records here";
  const auto peak = [&](const std::string& name, double dt = 0.0) {
    const RecordFile file = read_record(folder + "/" + name, dt);
    double most = 0.0;
    for (const double a : file.record.values) most = std::max(most, std::abs(a));
    return std::tuple(file.format, most, file.record.values.size(), file.record.dt);
  };
  EXPECT_EQ(peak("csmip_v2/CHAN14.V2"), std::tuple(std::string("CSMIP V2"), 225.090, std::size_t(5696), 0.010));
  EXPECT_EQ(peak("itaca_dyna/19971014_152309ITDPC_NCR__NSX.DAT"),
            std::tuple(std::string("ITACA/ESM ASCII"), 130.573, std::size_t(6560), 0.005));
  const auto [format, most, samples, dt] = peak("acc_simbad_ccby/20090406_0132_AQG_NS.acc", 0.005);
  EXPECT_EQ(format, "columns");
  EXPECT_NEAR(most / 9.80665, 0.4887, 5e-5);
  EXPECT_EQ(samples, 20001u);
  EXPECT_EQ(dt, 0.005);
  for (const char* sub : {"esm_asc", "itaca_dyna", "csmip_v2"})
    for (const auto& entry : std::filesystem::directory_iterator(folder + "/" + sub)) {
      const std::string name = entry.path().filename().string();
      if (!entry.is_regular_file() || (!name.ends_with("ACC.ASC") && !name.ends_with(".DAT") && !name.ends_with(".V2")))
        continue;
      EXPECT_GT(read_record(entry.path().string()).record.values.size(), 1000u) << name;
    }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
