// What joints bear where a run ends: tables, page and pictures.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <set>
#include <sstream>

#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

constexpr const char* arch = R"([bridge]
generator = "arch"
voussoirs = 9
embrace_angle = 120.0
[[stage]]
kind = "gravity"
)";

std::vector<std::vector<std::string>> rows_of(const std::string& table) {
  std::vector<std::vector<std::string>> rows;
  std::istringstream lines(table);
  for (std::string line; std::getline(lines, line);) {
    std::istringstream cells(line);
    rows.emplace_back();
    for (std::string cell; std::getline(cells, cell, ',');) rows.back().push_back(cell);
  }
  return rows;
}

/// An arch that has come to rest, in "run".
struct Stress : testing::Test {
  Folder folder;
  Surroundings there{.folder = folder.path(), .environment = {{"DISPLAY", ""}}};
  void SetUp() override {
    folder.write("arch.toml", arch);
    run_whole(folder, "arch.toml", "run");
  }
  /// The checkpoint that the gravity stage has left.
  std::string stage_end() {
    for (const auto& entry : std::filesystem::directory_iterator(folder / "run/checkpoints"))
      return "run/checkpoints/" + entry.path().filename().string();
    return "";
  }
  Outcome render(std::vector<std::string> words) {
    words.insert(words.begin(), "render");
    words.insert(words.end(), {"--width", "320", "--height", "240", "-o", "picture.png"});
    return voussoir(words, there);
  }
  std::string picture(const std::vector<std::string>& words) {
    const Outcome outcome = render(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return bytes_of(folder / "picture.png");
  }
};

TEST_F(Stress, EveryJointHasARow) {
  const auto rows = rows_of(bytes_of(folder / "run/stresses.csv"));
  ASSERT_EQ(rows.size(), 11u) << "ten joints";
  const auto column = [&](const char* name) {
    return std::size_t(std::find(rows[0].begin(), rows[0].end(), name) - rows[0].begin());
  };
  ASSERT_EQ(rows[0].back(), "condition");
  const auto beds = rows_of(bytes_of(folder / "run/joints.csv"));
  double most = 0.0, most_of_beds = 0.0;
  for (std::size_t i = 1; i < rows.size(); ++i) {
    ASSERT_EQ(rows[i].size(), rows[0].size());
    EXPECT_EQ(rows[i][0], std::to_string(i - 1));
    EXPECT_GT(std::stod(rows[i][column("normal_N")]), 0.0);
    EXPECT_LT(std::stod(rows[i][column("eccentricity_over_depth")]), 0.5);
    EXPECT_LT(std::stod(rows[i][column("utilisation")]), 1.0);
    most = std::max(most, std::stod(rows[i][column("normal_N")]));
    most_of_beds = std::max(most_of_beds, std::stod(beds[i][6]));
  }
  EXPECT_NEAR(most, most_of_beds, 1e-4 * most) << "one stone across: a joint is a bed joint";
}

TEST_F(Stress, ThePageDrawsTheThrust) {
  ASSERT_EQ(voussoir({"report", "run"}, there).status, 0);
  const std::string page = bytes_of(folder / "run/report.html");
  for (const char* words :
       {"Thrust in the vaults", "Lines of thrust", "Normal force", "kern, middle third", "stresses.csv"})
    EXPECT_NE(page.find(words), std::string::npos) << words;
}

TEST_F(Stress, PagesOfOlderRunsDoWithoutTheLine) {
  std::string old;
  for (const auto& row : rows_of(bytes_of(folder / "run/joints.csv"))) {
    for (std::size_t i = 0; i < 16; ++i) old += (i > 0 ? "," : "") + row[i];
    old += "\n";
  }
  set_bytes(folder / "run/joints.csv", old);
  ASSERT_EQ(voussoir({"report", "run"}, there).status, 0);
  const std::string page = bytes_of(folder / "run/report.html");
  EXPECT_EQ(page.find("Lines of thrust"), std::string::npos);
  EXPECT_NE(page.find("an earlier version wrote joints.csv"), std::string::npos);
  EXPECT_NE(page.find("Normal force"), std::string::npos);
}

TEST_F(Stress, JointsAreColouredInFramesAndCheckpointsAlike) {
  std::set<std::string> different;
  for (const char* colour : {"normal", "shear", "utilisation", "eccentricity"})
    different.insert(picture({"run", "--colour", colour}));
  EXPECT_EQ(different.size(), 4u);
  EXPECT_EQ(picture({"run", "--colour", "utilisation"}), picture({stage_end(), "--colour", "utilisation"}));
}

TEST_F(Stress, ResultantsAreThoseOfTheRunOrItsCheckpoint) {
  const std::string plain = picture({"run", "--amplification", "1"}), with = picture({"run", "--resultants"});
  EXPECT_NE(plain, with);
  EXPECT_EQ(with, picture({stage_end(), "--resultants"}));
  EXPECT_EQ(voussoir({"render", "run", "--resultants", "-v", "front"}, there).status, 0);
  EXPECT_TRUE(exists(folder / "run/images/resultants_front.png")) << "no picture of the run is written over";
  expect_error(render({"run", "--resultants", "--time", "0"}), 2, {"--time", "checkpoint"});
  expect_error(render({"run", "--resultants", "--amplification", "5"}), 2, {"It must be 1 for resultants"});
  expect_error(render({"run/assembly.h5", "--resultants"}), 2, {"assembly.h5", "is not a checkpoint"});
  expect_error(render({"run", "--colour", "strain"}), 2,
               {"strain", "normal, shear, utilisation or eccentricity", "stress"});
  expect_error(render({"run", "--colour", "stress"}), 2, {"deformable fill"});
}

TEST_F(Stress, AfterACollapseThereIsNoEquilibriumToDraw) {
  folder.write("falls.toml", std::string(arch) + R"([[stage]]
kind = "collapse"
load = [{ acceleration = [9.81, 0.0, 0.0] }]
confirm = 0.0
tolerance = 0.1
)");
  run_whole(folder, "falls.toml", "fallen");
  EXPECT_TRUE(exists(folder / "fallen/stresses.csv")) << "of the last equilibrium";
  expect_error(render({"fallen", "--resultants"}), 2, {"Its stones are falling", "joints.csv", "stage before"});
  const std::vector<std::string> names = names_in(folder / "fallen/checkpoints");
  const auto gravity = std::ranges::find_if(names, [](const auto& name) { return name.starts_with("stage_01"); });
  ASSERT_NE(gravity, names.end());
  EXPECT_EQ(render({"fallen/checkpoints/" + *gravity, "--resultants"}).status, 0);
}

TEST(StressOfMotion, ResultantsTakeAStateAtRest) {
  Folder folder;
  write_wall(folder);
  run_whole(folder, "wall.toml", "run");
  EXPECT_FALSE(std::filesystem::exists(folder / "run/stresses.csv")) << "it ends in motion";
  const Surroundings there{.folder = folder.path(), .environment = {{"DISPLAY", ""}}};
  expect_error(voussoir({"render", "run", "--resultants"}, there), 2, {"not at rest", "quasi-static"});
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
