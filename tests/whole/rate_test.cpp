// voussoir rate, as a user calls it: a strip of a small bridge under an axle, and what is refused.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>

#include <algorithm>
#include <filesystem>
#include <sstream>

#include "solver/base/json_file.h"
#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

const std::string small_bridge = R"([bridge]
generator = "bridge"
width = 3.0
block_scale = 2.0
fill_edge = 0.8
fill_over_crown = 0.2
backfill = "deformable"
abutments = "restrained"

[[bridge.span]]
shape = "segmental"
clear_span = 3.0
rise = 0.75
ring_thickness = 0.12

[bridge.abutment.left]
length = 1.5
height = 0.8

[bridge.abutment.right]
length = 1.5
height = 0.8

[materials.vault]
tensile_strength = 0.0
cohesion = 0.0

[[stage]]
kind = "gravity"
)";

const std::string axle = R"([vehicle]
title = "One axle"
source = "a test"
kind = "road"

[[axle]]
x = 0.0
load = 1000e3
track = 1.8
wheel = [0.3, 0.3]
)";

Outcome rate(const Folder& folder, std::vector<std::string> more) {
  std::vector<std::string> words = {"rate", "bridge.toml", "--vehicle", "axle.toml", "-o", "rated"};
  words.insert(words.end(), more.begin(), more.end());
  return voussoir(words, {.folder = folder.path()});
}

struct Bridge : Folder {
  Bridge() {
    write("bridge.toml", small_bridge);
    write("axle.toml", axle);
  }
};

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream in(text);
  for (std::string line; std::getline(in, line);) lines.push_back(line);
  return lines;
}

TEST(Rate, SweepsAStripAndSaysWhereItIsWorst) {
  const Bridge folder;
  const Outcome outcome = rate(
      folder, {"--strip", "0.4", "--step", "0.8", "--refine", "1", "--most", "4", "--tolerance", "0.25", "--no-runs"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("adequacy factor"), std::string::npos) << outcome.out;
  const nlohmann::json json = read_json(folder / "rated/rate.json");
  ASSERT_EQ(json["vehicles"].size(), 1u);
  const nlohmann::json& worst = json["vehicles"][0];
  EXPECT_TRUE(worst["found"].get<bool>());
  EXPECT_NEAR(json["effective_width"].get<double>(), 3.0, 1e-9);  // wheels + 1.5 m + cover are more than the bridge
  const std::vector<std::string> lines = lines_of(bytes_of(folder / "rated/rate.csv"));
  ASSERT_GE(lines.size(), 5u);
  double least = 1e300;
  for (std::size_t i = 1; i < lines.size(); ++i) {
    std::istringstream cells(lines[i]);
    std::string cell;
    for (int k = 0; k < 6; ++k) std::getline(cells, cell, ',');
    least = std::min(least, std::stod(cell));
  }
  EXPECT_NEAR(worst["adequacy_factor"].get<double>(), least, 1e-6 * least);
  const std::string page = bytes_of(folder / "rated/report.html");
  EXPECT_NE(page.find("adequacy factor"), std::string::npos);
  EXPECT_NE(page.find("plane strain"), std::string::npos);
}

TEST(Rate, SaysWhatItComputesAndEachPosition) {
  const Bridge folder;
  const std::vector<std::string> few = {"--strip", "0.4", "--step",      "2",   "--refine", "1",
                                        "--most",  "2",   "--tolerance", "0.5", "--no-runs"};
  const Outcome outcome = rate(folder, few);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::vector<std::string> lines = lines_of(outcome.err);
  ASSERT_GE(lines.size(), 5u) << outcome.err;
  EXPECT_EQ(lines[0], "reading bridge.toml");
  EXPECT_EQ(lines[1].rfind("3 positions of 1 vehicle", 0), 0u) << lines[1];
  EXPECT_EQ(lines[lines.size() - 3].rfind("  1 of   3  axle  front at x = 3.00 m", 0), 0u) << outcome.err;
  EXPECT_EQ(lines.back().rfind("  3 of   3  axle  front at x = ", 0), 0u) << outcome.err;
  std::vector<std::string> quiet = few;
  quiet.push_back("-q");
  const Outcome silent = rate(folder, quiet);
  EXPECT_EQ(silent.status, 0);
  EXPECT_EQ(silent.out + silent.err, "");
}

/// A load behind a symmetrical axle is not its own mirror image: the first position is rated in both directions. The
/// two of the refinement follow.
TEST(Rate, RatesBothDirectionsOfAVehicleThatIsNotSymmetrical) {
  const Bridge folder;
  folder.write("axle.toml", axle + "\n[[uniform]]\nfrom = 3.0\nwidth = 3.0\npressure = 1e3\n");
  const Outcome outcome = rate(
      folder, {"--strip", "0.4", "--step", "2", "--refine", "1", "--most", "2", "--tolerance", "0.5", "--no-runs"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("4 positions of 1 vehicle"), std::string::npos) << outcome.err;
}

/// The sweep has more positions than are computed before the signal arrives.
TEST(Rate, WritesCompletePositionsWhenInterrupted) {
  const Bridge folder;
  Program program({"rate", "bridge.toml", "--vehicle", "axle.toml", "-o", "rated", "--strip", "0.4", "--step", "0.05",
                   "--most", "2", "--tolerance", "0.5", "--threads", "1"},
                  {.folder = folder.path()});
  ASSERT_TRUE(wait_until(program, [&] { return program.so_far().err.find("  1 of  6") != std::string::npos; }))
      << program.so_far().err;
  program.send(SIGINT);
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.signal, 0);
  EXPECT_EQ(outcome.status, 1) << outcome.err;
  const nlohmann::json json = read_json(folder / "rated/rate.json");
  EXPECT_FALSE(json["complete"].get<bool>());
  const auto done = json["places_done"].get<std::size_t>();
  EXPECT_GE(done, 1u);
  EXPECT_LT(done, json["places_planned"].get<std::size_t>());
  EXPECT_EQ(lines_of(bytes_of(folder / "rated/rate.csv")).size(), done + 1);
  const std::string missing = fmt::format("interrupted after {} of {}", done, json["places_planned"].get<int>());
  EXPECT_NE(outcome.err.find(missing), std::string::npos) << outcome.err;
  EXPECT_NE(bytes_of(folder / "rated/report.html").find(missing), std::string::npos);
  EXPECT_FALSE(std::filesystem::exists(folder / "rated/worst")) << "no run where it is not known to be worst";
}

/// The repeated command finds the positions that are complete: they keep the seconds of the first one.
TEST(Rate, ContinuesWhereItWasInterrupted) {
  const Bridge folder;
  const std::vector<std::string> words = {"rate",        "bridge.toml", "--vehicle", "axle.toml", "--strip",   "0.4",
                                          "--step",      "0.4",         "--refine",  "0",         "--most",    "2",
                                          "--tolerance", "0.5",         "--threads", "1",         "--no-runs", "-o"};
  const auto into = [&](const std::string& name) {
    std::vector<std::string> all = words;
    all.push_back(name);
    return all;
  };
  Program program(into("rated"), {.folder = folder.path()});
  ASSERT_TRUE(wait_until(program, [&] { return program.so_far().err.find("  1 of   7") != std::string::npos; }))
      << program.so_far().err;
  program.send(SIGINT);
  ASSERT_EQ(program.wait().status, 1);
  const std::vector<std::string> before = lines_of(bytes_of(folder / "rated/rate.csv"));
  ASSERT_GE(before.size(), 2u);
  EXPECT_TRUE(std::filesystem::exists(folder / "rated/places"));
  ASSERT_EQ(voussoir(into("rated"), {.folder = folder.path()}).status, 0);
  EXPECT_FALSE(std::filesystem::exists(folder / "rated/places")) << "nothing is left to continue";
  ASSERT_EQ(voussoir(into("whole"), {.folder = folder.path()}).status, 0);
  const std::vector<std::string> after = lines_of(bytes_of(folder / "rated/rate.csv")),
                                 whole = lines_of(bytes_of(folder / "whole/rate.csv"));
  ASSERT_EQ(after.size(), 8u);
  ASSERT_EQ(whole.size(), 8u);
  for (std::size_t i = 0; i < before.size(); ++i) EXPECT_EQ(after[i], before[i]);
  const auto without_seconds = [](const std::string& line) { return line.substr(0, line.rfind(',')); };
  for (std::size_t i = 0; i < after.size(); ++i) EXPECT_EQ(without_seconds(after[i]), without_seconds(whole[i]));
  EXPECT_EQ(bytes_of(folder / "rated/rate.json"), bytes_of(folder / "whole/rate.json"));
}

TEST(Rate, SaysWhatItNeeds) {
  const Bridge folder;
  EXPECT_NE(voussoir({"rate", "bridge.toml"}, {.folder = folder.path()}).err.find("--vehicle"), std::string::npos);
  const Outcome wide = rate(folder, {"--lane", "1.2"});
  EXPECT_EQ(wide.status, 2);
  EXPECT_NE(wide.err.find("is not road"), std::string::npos) << wide.err;
  const Outcome nowhere = rate(folder, {"--from", "40"});
  EXPECT_EQ(nowhere.status, 2);
  EXPECT_NE(nowhere.err.find("--from and --to leave no position for axle"), std::string::npos) << nowhere.err;
  const Outcome named = voussoir({"rate", "bridge.toml", "--vehicle", "cs454-normal-singl"}, {.folder = folder.path()});
  EXPECT_EQ(named.status, 2);
  EXPECT_NE(named.err.find("cs454-normal-single"), std::string::npos) << named.err;
  folder.write("bare.toml", small_bridge + "\n");
  std::string bare = small_bridge;
  bare.replace(bare.find("\"deformable\""), 12, "\"none\"");
  folder.write("bridge.toml", bare);
  const Outcome none = rate(folder, {});
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("no road"), std::string::npos) << none.err;
}

/// The two runs of the worst place write what their bed joints bear, and the page draws the lines of thrust.
TEST(Rate, DrawsTheThrustOfTheWorstPlace) {
  const Bridge folder;
  const Outcome outcome =
      rate(folder, {"--strip", "0.4", "--step", "3", "--refine", "0", "--most", "2", "--tolerance", "0.5"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const char* run : {"rated/worst", "rated/working"}) {
    const std::vector<std::string> lines = lines_of(bytes_of(folder / (std::string(run) + "/joints.csv")));
    ASSERT_EQ(lines.size(), 8u) << run << ": of six voussoirs";
    EXPECT_EQ(lines[0].substr(0, 33), "vault,ring,joint,x_m,y_m,z_m,norm");
    for (std::size_t i = 1; i < lines.size(); ++i) {
      std::istringstream cells(lines[i]);
      std::vector<double> numbers;
      for (std::string cell; std::getline(cells, cell, ',');) numbers.push_back(cell.empty() ? 0.0 : std::stod(cell));
      ASSERT_EQ(numbers.size(), 19u);
      EXPECT_EQ(numbers[2], double(i - 1));
      EXPECT_GT(numbers[6], 0.0) << "every joint is pressed";
      EXPECT_LT(std::abs(numbers[10]), 0.51) << "the thrust lies in the ring";
      EXPECT_NEAR(numbers[12], 0.12, 1e-4);
      EXPECT_NEAR(numbers[13], 0.4, 1e-3);
    }
  }
  const std::string page = bytes_of(folder / "rated/report.html");
  EXPECT_NE(page.find("Thrust lines at the worst position"), std::string::npos);
  EXPECT_NE(page.find("largest load found"), std::string::npos);
  EXPECT_NE(bytes_of(folder / "rated/images/thrust.svg").find("<svg"), std::string::npos);
}

/// The worked example of BA 16/97.
TEST(Rate, PrintsMexeBesideIt) {
  const Bridge folder;
  const std::string example =
      "[mexe]\nspan = 5.23\nrise = 1.57\nquarter_rise = 1.373\nring = 0.34\nfill = 0.34\nbarrel_factor = 0.8\n"
      "fill_factor = 0.7\nwidth_factor = 0.9\ndepth_factor = 0.9\nmortar_factor = 1.0\ncondition_factor = 0.7\n";
  folder.write("mexe.toml", example);
  const Outcome outcome = rate(folder, {"--strip", "0.3", "--step", "3", "--refine", "0", "--tolerance", "7", "--most",
                                        "60", "--no-runs", "--mexe", "mexe.toml"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("modified axle load 11.2 t"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("39.83 t"), std::string::npos) << outcome.out;
  folder.write("mexe.toml", example + "surface = 3\n");
  const Outcome wrong = rate(folder, {"--mexe", "mexe.toml"});
  EXPECT_EQ(wrong.status, 2);
  EXPECT_NE(wrong.err.find("surface"), std::string::npos) << wrong.err;
}

/// A vehicle that stands on the bridge, named in the case: its weight arrives at the bases.
TEST(Rate, AVehicleInACaseStandsOnItsBases) {
  const Bridge folder;
  folder.write("case.toml",
               small_bridge + "\n[[stage]]\nkind = \"gravity\"\nvehicle = [{ name = \"axle.toml\", x = 2.4 }]\n");
  const Outcome outcome = voussoir({"run", "case.toml", "-o", "run", "--no-pictures"}, {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string text = bytes_of(folder / "run/case.toml");
  EXPECT_NE(text.find("road = ["), std::string::npos) << text;
  folder.write("two.toml",
               small_bridge + "\n[[stage]]\nkind = \"gravity\"\nvehicle = [{ name = \"none-such\", x = 2.4 }]\n");
  const Outcome none = voussoir({"run", "two.toml"}, {.folder = folder.path()});
  EXPECT_EQ(none.status, 2);
  EXPECT_NE(none.err.find("none-such"), std::string::npos) << none.err;
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
