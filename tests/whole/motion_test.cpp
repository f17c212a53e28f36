// voussoir motion and voussoir report as a user calls them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>

#include "io/hdf5/history_file.h"
#include "solver/base/json_file.h"
#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

const std::vector<std::string> aquila = {"--target", "ntc2018", "--ag",  "0.2607", "--f0",
                                         "2.360",    "--tc",    "0.350", "--soil", "D"};

std::vector<std::string> with_target(std::vector<std::string> words) {
  words.insert(words.end(), aquila.begin(), aquila.end());
  return words;
}

bool has(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

nlohmann::json json_of(const std::string& path) {
  return read_json(path);
}

/// Six artificial records of 8 s in the folder "made".
void make_records(const Folder& folder) {
  const Outcome made = voussoir(with_target({"motion", "synthesize", "--count", "6", "--duration", "8", "-o", "made"}),
                                {.folder = folder.path()});
  ASSERT_EQ(made.status, 0) << made.err;
}

TEST(Motion, SynthesizedRecordsAreSaidToBeAndCanBeSelected) {
  const Folder folder;
  make_records(folder);
  const Surroundings there{.folder = folder.path()};
  EXPECT_TRUE(has(bytes_of(folder / "made/synthetic_0001_x.txt"), "# synthetic, not recorded: NTC 2018"));
  EXPECT_TRUE(has(bytes_of(folder / "made/synthetic.html"), "They were not recorded"));
  const nlohmann::json made = json_of(folder / "made/synthetic.json");
  ASSERT_EQ(made["records"].size(), 6u);
  for (const nlohmann::json& record : made["records"])
    for (const char* axis : {"x", "y", "z"}) {
      EXPECT_GT(record["response_over_target"][axis][0], 0.8);
      EXPECT_LT(record["response_over_target"][axis][1], 1.2);
    }
  const Outcome chosen =
      voussoir(with_target({"motion", "select", "made", "--count", "3", "--range", "0.15", "1.2", "-o", "out"}), there);
  ASSERT_EQ(chosen.status, 0) << chosen.err;
  const nlohmann::json selection = json_of(folder / "out/selection.json");
  EXPECT_TRUE(selection["found"]);
  ASSERT_EQ(selection["records"].size(), 3u);
  for (const double ratio : selection["ratio"]) EXPECT_TRUE(ratio >= 0.9 && ratio <= 1.3) << ratio;
  for (const nlohmann::json& record : selection["records"])
    for (const std::string file : record["files"]) EXPECT_TRUE(exists(folder / ("out/" + file))) << file;
  EXPECT_EQ(selection["sets_tried"], 20.0);
}

TEST(Motion, WithoutASolutionTheClosestIsWrittenAndTheRemedySaid) {
  const Folder folder;
  make_records(folder);
  const Outcome outcome = voussoir(with_target({"motion", "select", "made", "--count", "3", "--range", "0.15", "1.2",
                                                "--bounds", "0.9999", "1.0001", "-o", "out"}),
                                   {.folder = folder.path()});
  expect_error(outcome, 1, {"no set of 3 records", "Widen --bounds"});
  EXPECT_FALSE(json_of(folder / "out/selection.json")["found"]);
}

TEST(Motion, InfoSpectraAndProcessing) {
  const Folder folder;
  make_records(folder);
  const Surroundings there{.folder = folder.path()};
  const Outcome info = voussoir({"motion", "info", "made", "-o", "measures"}, there);
  ASSERT_EQ(info.status, 0) << info.err;
  EXPECT_TRUE(has(info.out, "PGA (g)") && has(info.out, "synthetic_0003")) << info.out;
  EXPECT_TRUE(has(info.err, "left out: synthetic.html:1: the format of this file is not known")) << info.err;
  EXPECT_EQ(json_of(folder / "measures/motion.json")["records"].size(), 6u);
  const std::string x = "made/synthetic_0001_x.txt", y = "made/synthetic_0001_y.txt";
  EXPECT_EQ(voussoir(with_target({"motion", "spectrum", x, y, "-o", "spectra"}), there).status, 0);
  EXPECT_TRUE(
      has(bytes_of(folder / "spectra/spectra.csv"), "period_s,synthetic_0001_x_m/s2,synthetic_0001_y_m/s2,target"));
  const Outcome done = voussoir({"motion", "process", x, y, "--taper", "0.05", "--band", "0.2", "20", "--baseline",
                                 "--step", "0.01", "-o", "clean"},
                                there);
  ASSERT_EQ(done.status, 0) << done.err;
  EXPECT_TRUE(has(bytes_of(folder / "clean/synthetic_0001_y.txt"), "\n0.01 "));
}

TEST(Motion, RoundedStepsOfAt2AndComponentsOfUnequalLength) {
  const Folder folder;
  const auto at2 = [](int samples, const char* component) {
    std::string text = "PEER\nNowhere, 1/2/2003, Mill, " + std::string(component) +
                       "\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS= " + std::to_string(samples) +
                       ", DT= .0024 SEC\n";
    for (int k = 0; k < samples; ++k) text += k % 2 ? " -.1000000E-01" : "  .1000000E-01";
    return text + "\n";
  };
  folder.write("RSN1_MILL000.AT2", at2(30, "000"));
  folder.write("RSN1_MILL090.AT2", at2(28, "090"));
  folder.write("RSN1_MILL-UP.AT2", at2(25, "UP"));
  const Outcome outcome = voussoir({"motion", "info", "."}, {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.out, "RSN1_MILL: PEER AT2")) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "x = 000, y = 090, z = UP")) << outcome.out;
  EXPECT_TRUE(has(outcome.out, "0.0696 s at time steps of 0.0024 s")) << outcome.out;  // the longest
  EXPECT_TRUE(has(outcome.out, "wrong by up to 2.1 %")) << outcome.out;
}

TEST(Motion, SpectraBelowTenStepsAreRemarkedOn) {
  const Folder folder;
  std::string text;
  for (int k = 0; k < 200; ++k) text += fmt::format("{:.2f} {}\n", 0.05 * k, k % 2);
  folder.write("a.txt", text);
  const Outcome outcome = voussoir({"motion", "spectrum", "a.txt", "-o", "o"}, {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(has(outcome.err, "below 0.5 s, which is ten of their time steps (0.05 s)")) << outcome.err;
  EXPECT_TRUE(has(bytes_of(folder / "o/spectra.html"), "ten of their time steps"));
}

TEST(Motion, WrongWordsAreExplained) {
  const Folder folder;
  folder.write("a_EW.txt", "1\n2\n3\n");
  const Surroundings there{.folder = folder.path()};
  expect_error(voussoir({"motion", "selct"}, there), 2, {"'selct'", "did you mean 'select'"});
  expect_error(voussoir({"motion", "select", "."}, there), 2, {"--target is missing"});
  expect_error(voussoir({"motion", "select", ".", "--target", "ntc2018", "--ag", "0.2", "--soil", "D"}, there), 2,
               {"needs --f0"});
  expect_error(voussoir(with_target({"motion", "select", "nowhere"}), there), 2, {"nowhere", "Give a folder"});
  expect_error(voussoir(with_target({"motion", "select", "."}), there), 2, {"no record with two horizontal"});
  expect_error(voussoir({"motion", "process", "a_EW.txt", "--band", "5", "1", "-o", "o"}, there), 2,
               {"lower corner frequency must come first"});
  for (const auto& [option, value] :
       {std::pair{"--step", "1e9"}, {"--step", "nan"}, {"--taper", "-1"}, {"--order", "99"}})
    expect_error(voussoir({"motion", "process", "a_EW.txt", option, value, "-o", "o"}, there), 2,
                 {option, "It must be"});
  expect_error(voussoir({"motion", "process", "a_EW.txt", "--band", "1e-9", "1", "-o", "o"}, there), 2, {"0.001 Hz"});
  expect_error(voussoir({"motion", "info", "a_EW.txt", "--columns", "t", "up"}, there), 2, {"--columns contains 'up'"});
  expect_error(voussoir({"motion", "info", "a_EW.txt", "--units", "gal"}, there), 2, {"'gal'", "m/s2, g or cm/s2"});
}

// Ladder E: seven of the twenty-two real records, mean over target within 0.90 and 1.30 from 0.15 to 1.20 s.
TEST(Motion, SevenOfTheRealRecords) {
  const std::string records = VOUSSOIR_SOURCE_DIR "/../shared/records/acc_simbad_ccby";
  if (!std::filesystem::exists(records)) GTEST_SKIP() << "the real records are not here";
  const Folder folder;
  const Outcome outcome = voussoir(with_target({"motion", "select", records, "--count", "7", "--range", "0.15", "1.2",
                                                "--bounds", "0.9", "1.3", "-o", "OUT"}),
                                   {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json selection = json_of(folder / "OUT/selection.json");
  EXPECT_TRUE(selection["found"]);
  EXPECT_TRUE(selection["all_tried"]);
  ASSERT_EQ(selection["records"].size(), 7u);
  ASSERT_EQ(selection["ratio"].size(), 106u);
  for (const double ratio : selection["ratio"]) EXPECT_TRUE(ratio >= 0.9 && ratio <= 1.3) << ratio;
  std::map<std::string, int> events;
  for (const nlohmann::json& record : selection["records"]) {
    EXPECT_LE(++events[record["event"]], 3);
    EXPECT_TRUE(record["factor"] >= 0.3 && record["factor"] <= 3.0);
  }
}

// What the history says of damage at the end is what the summary says.
TEST(Report, HistoryAndSummaryAgreeOnDamage) {
  const Folder folder;
  folder.write("c.toml",
               "[bridge]\ngenerator = \"column\"\nblocks = 4\n[materials.masonry]\ntensile_strength = 2e4\n"
               "cohesion = 5e4\n[[stage]]\nkind = \"gravity\"\n[[stage]]\nkind = \"motion\"\nduration = 1.0\n"
               "pulse = { kind = \"sine\", axis = \"x\", amplitude = 6.0, frequency = 2.0 }\n");
  run_whole(folder, "c.toml", "run");
  const nlohmann::json damage = summary(folder / "run")["damage"];
  const History history = History::load(folder / "run/history.h5");
  double most = 0.0;
  for (const auto& [name, entry] : damage.items()) {
    const std::string channel = "damage/" + name + "/broken_share";
    ASSERT_EQ(history.has(channel), entry["bonded"].get<bool>()) << name;
    if (!history.has(channel)) continue;
    const std::vector<double>& share = history.values(channel);
    EXPECT_EQ(share.front(), 0.0) << name;
    EXPECT_TRUE(std::ranges::is_sorted(share)) << name;  // a bond does not come back
    EXPECT_NEAR(share.back(), entry["broken_share"].get<double>(), 1e-12) << name;
    most = std::max(most, share.back());
  }
  EXPECT_GT(most, 0.0);
}

TEST(Report, IsMadeFromARunsFilesAlone) {
  const Folder folder;
  run_whole(folder, write_wall(folder), "run");
  const Surroundings there{.folder = folder.path()};
  const Outcome outcome = voussoir({"report", "run"}, there);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string page = bytes_of(folder / "run/report.html");
  for (const char* piece : {"Damage by parts", "Acceleration of the base", "Energy since the start", "Burland"})
    EXPECT_TRUE(has(page, piece)) << piece;
  for (const char* outside : {"<script", "src=\"http", "<link"}) EXPECT_FALSE(has(page, outside)) << outside;
  EXPECT_TRUE(summary(folder / "run")["damage"].front().contains("class"));
  expect_error(voussoir({"report", "."}, there), 2, {"not a run directory"});
  std::filesystem::remove(folder / "run/summary.json");
  expect_error(voussoir({"report", "run"}, there), 2, {"has not ended", "voussoir resume run"});
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
