// Three components out of the files of a folder.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <filesystem>

#include "io/records/sets.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

std::string column(int samples, double size) {
  std::string text;
  for (int k = 0; k < samples; ++k) text += fmt::format("{}\r\n", size * std::sin(0.1 * k));
  return text + "\r\n";
}

std::string dyna(const std::string& stream, int samples, double dt) {
  std::string text = fmt::format(
      "EVENT_NAME: NOWHERE\nSTATION_CODE: NOW\nSAMPLING_INTERVAL_S: {}\nNDATA: {}\nSTREAM: {}\nUNITS: cm/s^2\n"
      "DATA_TYPE: ACCELERATION\n",
      dt, samples, stream);
  for (int k = 0; k < samples; ++k) text += fmt::format("{}\n", double(k));
  return text;
}

TEST(RecordSets, EastIsXAndNorthIsYWhateverTheOrder) {
  const test::Folder folder;
  folder.write("19990101_1200_AAA_WE.acc", column(40, 1.0));
  folder.write("19990101_1200_AAA_NS.acc", column(50, 2.0));
  folder.write("19990101_1200_AAA_UD.acc", column(30, 3.0));
  folder.write("README.md", "no numbers\n");
  const RecordFolder found = read_record_folder(folder.path());
  ASSERT_EQ(found.sets.size(), 1u);
  const RecordSet& set = found.sets[0];
  EXPECT_EQ(set.name, "19990101_1200_AAA");
  EXPECT_EQ(set.event, "19990101_1200");
  EXPECT_EQ(set.station, "AAA");
  EXPECT_EQ(set.units, "m/s2");
  EXPECT_EQ(set.dt, 0.005);
  ASSERT_EQ(set.motion.acceleration.size(), 50u);  // the longest; others go on with zeros
  EXPECT_NEAR(set.motion.acceleration[10].x(), std::sin(1.0), 1e-6);
  EXPECT_NEAR(set.motion.acceleration[10].y(), 2.0 * std::sin(1.0), 1e-6);
  EXPECT_NEAR(set.motion.acceleration[10].z(), 3.0 * std::sin(1.0), 1e-6);
  EXPECT_EQ(set.motion.acceleration[45].x(), 0.0);
  ASSERT_EQ(found.left_out.size(), 1u);
  EXPECT_NE(found.left_out[0].find("README.md"), std::string::npos);
}

TEST(RecordSets, UnitsAndStepOfColumnsAsTold) {
  const test::Folder folder;
  folder.write("a_1.txt", column(40, 1.0));
  folder.write("a_2.txt", column(40, 1.0));
  folder.write("a_3.txt", column(40, 1.0));
  const RecordSet set = read_record_folder(folder.path(), {"g", 0.01}).sets.at(0);
  EXPECT_EQ(set.motion.dt, 0.01);
  EXPECT_NEAR(set.motion.acceleration[10].z(), 9.80665 * std::sin(1.0), 1e-5);
  EXPECT_THROW(read_record_folder(folder.path(), {"gal", 0.01}), InputError);
}

TEST(RecordSets, HeadingsNameTheComponentsAndStepsMayDiffer) {
  const test::Folder folder;
  folder.write("X.NOW..HNE.D.1.ASC", dyna("HNE", 11, 0.01));
  folder.write("X.NOW..HNN.D.1.ASC", dyna("HNN", 21, 0.005));
  folder.write("X.NOW..HNZ.D.1.ASC", dyna("HNZ", 11, 0.01));
  const RecordSet set = read_record_folder(folder.path()).sets.at(0);
  EXPECT_EQ(set.event, "NOWHERE");
  EXPECT_EQ(set.motion.dt, 0.005);
  EXPECT_EQ(set.dt, 0.0);
  EXPECT_EQ(set.units, "");
  ASSERT_EQ(set.motion.acceleration.size(), 21u);
  for (int k = 0; k < 21; ++k) {  // k cm/s2 a step: x and z are linear between their samples
    EXPECT_NEAR(set.motion.acceleration[std::size_t(k)].x(), 0.005 * k, 1e-12);
    EXPECT_NEAR(set.motion.acceleration[std::size_t(k)].y(), 0.01 * k, 1e-12);
  }
}

TEST(RecordSets, WhatDoesNotFitIsLeftOutAndSaid) {
  const test::Folder folder;
  folder.write("good_EW.txt", column(40, 1.0));
  folder.write("good_NS.txt", column(40, 1.0));
  folder.write("alone_EW.txt", column(40, 1.0));
  folder.write("damaged_EW.txt", column(40, 1.0));
  folder.write("damaged_NS.txt", column(5, 1.0) + "nan\n");
  const RecordFolder found = read_record_folder(folder.path());
  ASSERT_EQ(found.sets.size(), 1u);
  EXPECT_EQ(found.sets[0].files[2], "");
  ASSERT_EQ(found.left_out.size(), 2u);  // two reasons
  EXPECT_NE(found.left_out[0].find("damaged_NS.txt:7"), std::string::npos) << found.left_out[0];
  EXPECT_NE(found.left_out[1].find(
                "2 files or recordings (alone (EW of one file), damaged (EW of one file)): two horizontal"),
            std::string::npos)
      << found.left_out[1];
  EXPECT_THROW(read_record_folder(folder.path() + "/none"), InputError);
}

/// As PEER writes them: the azimuth in the heading has no leading zeros.
std::string at2(const std::string& about, const std::string& component, const std::string& quantity = "ACCELERATION") {
  return fmt::format(
      "PEER NGA STRONG MOTION DATABASE RECORD\n{}, {}\n{} TIME SERIES IN UNITS OF {}\nNPTS=  5, DT=   .0100 SEC,\n"
      "  1.0E-02  2.0E-02  3.0E-02  4.0E-02  5.0E-02\n",
      about, component, quantity, quantity == "ACCELERATION" ? "G" : "CM");
}

TEST(RecordSets, AzimuthsAreComparedAsNumbers) {
  const test::Folder folder;
  const std::string about = "Town A-01, 1/17/1994, Mulberry Street";
  const auto write = [&](const std::string& stem, const std::string& in_name, const std::string& in_heading) {
    folder.write(stem + in_name + ".AT2", at2(about + stem, in_heading));
    folder.write(stem + in_name + ".VT2", at2(about + stem, in_heading, "VELOCITY"));
    folder.write(stem + in_name + ".DT2", at2(about + stem, in_heading, "DISPLACEMENT"));
  };
  const std::vector<std::array<std::string, 4>> sets = {{"RSN101_MUL", "009", "9", "279"},
                                                        {"RSN102_LOS", "000", "0", "270"},
                                                        {"RSN103_BOL", "090", "90", "000"},
                                                        {"RSN104_PEL", "000", "360", "090"},
                                                        {"RSN105_E05", "067", "67", "337"}};
  for (const auto& [stem, name, heading, other] : sets) {
    write(stem, name, heading);
    write(stem, other, std::to_string(std::stoi(other)));
    write(stem, "-UP", "UP");
  }
  const RecordFolder found = read_record_folder(folder.path());
  ASSERT_EQ(found.sets.size(), sets.size());
  for (std::size_t i = 0; i < sets.size(); ++i) {
    EXPECT_EQ(found.sets[i].name, sets[i][0]);
    for (const std::string& file : found.sets[i].files) EXPECT_FALSE(file.empty()) << found.sets[i].name;
  }
  ASSERT_EQ(found.left_out.size(), 1u);  // not one for each of the thirty files
  EXPECT_TRUE(
      found.left_out[0].starts_with("30 files or recordings (RSN101_MUL-UP.DT2, RSN101_MUL-UP.VT2, RSN101_MUL009.DT2"))
      << found.left_out[0];
}

TEST(RecordSets, HeadingsSayWhatNamesDoNot) {
  const test::Folder folder;
  folder.write("first.AT2", at2("Town A-01, 1/17/1994, Mulberry Street", "67"));
  folder.write("second.AT2", at2("Town A-01, 1/17/1994, Mulberry Street", "337"));
  folder.write("third_UP.AT2", at2("Town A-01, 1/17/1994, Mulberry Street", "UP"));
  folder.write("other.AT2", at2("Town B-01, 1/17/1995, Bolton", "UP"));
  const RecordFolder found = read_record_folder(folder.path());
  ASSERT_EQ(found.sets.size(), 1u);
  EXPECT_EQ(found.sets[0].components, (std::array<std::string, 3>{"67", "337", "UP"}));
  ASSERT_EQ(found.left_out.size(), 1u);
  EXPECT_NE(found.left_out[0].find("Town B-01 Bolton (UP of one file)"), std::string::npos) << found.left_out[0];
}

// Two numbered channels and a vertical one, each with the code of its place behind.
TEST(RecordSets, ChannelsOfSeismometers) {
  const test::Folder folder;
  for (const char* channel : {"BH1", "BH2", "BHZ"})
    folder.write(fmt::format("RSN9001_Town.XX.{}.00.AT2", channel),
                 at2("Town C, 8/23/2011, XX", fmt::format("{} 00", channel)));
  const RecordFolder found = read_record_folder(folder.path());
  ASSERT_EQ(found.sets.size(), 1u);
  EXPECT_EQ(found.sets[0].components, (std::array<std::string, 3>{"BH1", "BH2", "BHZ"}));
  const test::Folder joined;
  for (const char* channel : {"BH100", "BH200", "BHZ00"})
    joined.write(fmt::format("RSN9001_{}.AT2", channel), at2("Town C, 8/23/2011, XX", channel));
  EXPECT_EQ(read_record_folder(joined.path()).sets.at(0).components[2], "BHZ");
}

TEST(RecordSets, WhatDiffersByDigitsOnlyIsSaid) {
  const test::Folder folder;
  for (const char* name : {"good_EW.txt", "good_NS.txt", "run1_a_EW.txt", "run2_a_NS.txt"})
    folder.write(name, column(40, 1.0));
  const RecordFolder found = read_record_folder(folder.path());
  ASSERT_EQ(found.left_out.size(), 1u);
  EXPECT_NE(found.left_out[0].find("'run2_a (NS)' differs by digits only"), std::string::npos) << found.left_out[0];
}

TEST(RecordSets, Directions) {
  const std::vector<std::pair<const char*, int>> known = {
      {"EW", 0},  {"we", 0},   {"NS", 1},  {"UD", 2},  {"UP", 2},  {"x", 0},    {"HNE", 0}, {"HGZ", 2},
      {"H1", -1}, {"140", -1}, {"BHZ", 2}, {"HHE", 0}, {"BHN", 1}, {"BH1", -1}, {"EW2", 0}, {"UD1", 2}};
  for (const auto& [name, axis] : known) EXPECT_EQ(component_axis(name), axis) << name;
}

// Every recording of the folders of real records is put together; what is left out is said.
TEST(RecordSets, RealRecords) {
  const std::string folder = VOUSSOIR_SOURCE_DIR "/../shared/records";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << "the real records are not here";
  const RecordFolder columns = read_record_folder(folder + "/acc_simbad_ccby");
  EXPECT_EQ(columns.sets.size(), 22u);
  EXPECT_EQ(columns.left_out.size(), 1u);  // licence and readme
  for (const RecordSet& set : columns.sets) EXPECT_FALSE(set.files[2].empty()) << set.name;
  EXPECT_EQ(read_record_folder(folder + "/esm_asc").sets.size(), 2u);
  const RecordFolder csmip = read_record_folder(folder + "/csmip_v2");
  ASSERT_EQ(csmip.sets.size(), 1u);
  EXPECT_EQ(csmip.sets[0].components[0], "270");  // numbers by size
  EXPECT_EQ(csmip.sets[0].components[2], "UP");
  const RecordFolder itaca = read_record_folder(folder + "/itaca_dyna");
  ASSERT_EQ(itaca.sets.size(), 1u);  // Nocera Umbra; of Airola there is one component
  EXPECT_EQ(itaca.sets[0].station, "NCR");
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
