// voussoir modal, as a user calls it.
#include <gtest/gtest.h>

#include <filesystem>

#include "io/hdf5/assembly_file.h"
#include "solver/base/json_file.h"
#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

nlohmann::json modes_of(const std::string& directory) {
  return read_json(directory + "/modes.json");
}

const std::string column = R"([bridge]
generator = "column"
blocks = 10
kn = 4e9
ks = 1.6e9
[[modal.expected]]
direction = "longitudinal"
period = 1.0
source = "a guess"
)";

TEST(Modal, OfACaseLeavesTablesShapesAndPictures) {
  const Folder folder;
  folder.write("column.toml", column);
  const Outcome outcome = voussoir({"modal", "column.toml", "-n", "3"}, {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const char* words : {"all joints intact", "longitudinal, 1st order", "60 unknowns", "a guess"})
    EXPECT_NE(outcome.out.find(words), std::string::npos) << words << outcome.out;
  const std::string out = folder / "column-modes";
  for (const char* file : {"modes.txt", "modes.json", "modes.h5", "vtk/modes.pvd", "vtk/mode_01.vtu", "vtk/mode_03.vtu",
                           "images/mode_01.png", "images/mode_03.png"})
    EXPECT_TRUE(exists(out + "/" + file)) << file;
  const nlohmann::json json = modes_of(out);
  EXPECT_EQ(json["modes"].size(), 3u);
  EXPECT_EQ(json["unknowns"], 60);
  EXPECT_NEAR(json["modes"][0]["damped"]["ratio"].get<double>(), 0.02, 0.001);
  EXPECT_EQ(json["expected"][0]["source"], "a guess");
  // Fewer modes the next time: nothing of the earlier ones is left over.
  ASSERT_EQ(voussoir({"modal", "column.toml", "-n", "2", "-q"}, {.folder = folder.path()}).out, "");
  EXPECT_FALSE(exists(out + "/vtk/mode_03.vtu"));
  EXPECT_FALSE(exists(out + "/images/mode_03.png"));
}

TEST(Modal, AgainstItselfPairsEveryModeWithItself) {
  const Folder folder;
  write_wall(folder);
  const auto run = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {"modal", "wall.toml", "-n", "5", "--no-pictures", "-q"};
    words.insert(words.end(), more.begin(), more.end());
    return voussoir(words, {.folder = folder.path()});
  };
  ASSERT_EQ(run({"-o", "one"}).status, 0);
  ASSERT_EQ(run({"-o", "two", "--against", "one/modes.h5"}).status, 0);
  const nlohmann::json json = modes_of(folder / "two")["against"];
  EXPECT_NEAR(json["paired_mass"].get<double>(), 1.0, 1e-12);
  for (int i = 0; i < 5; ++i) {
    EXPECT_EQ(json["pairs"][i]["found"]["mode"], i + 1);
    EXPECT_NEAR(json["pairs"][i]["found"]["mac"].get<double>(), 1.0, 1e-9);
    EXPECT_NEAR(json["pairs"][i]["change"].get<double>(), 0.0, 1e-12);
  }
}

/// A bonded wall shaken until some of its joints are lost: its frequencies drop, and the modes still pair.
TEST(Modal, AfterDamageSaysTheFrequencyDrop) {
  const Folder folder;
  Wall wall;
  wall.amplitude = 6.0, wall.free = 0.05;
  wall.extra = "[materials.masonry]\ntensile_strength = 2e4\ncohesion = 3e4\n";
  write_wall(folder, wall);
  run_whole(folder, "wall.toml", "run");
  const Outcome outcome = voussoir({"modal", "run", "-n", "3", "--no-pictures"}, {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("at rest after"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find(" iterations of dynamic relaxation"), std::string::npos) << outcome.out;
  const nlohmann::json json = modes_of(folder / "run/modes");
  double least = 0.0;
  for (const nlohmann::json& pair : json["intact"]["pairs"]) {
    ASSERT_FALSE(pair["found"].is_null()) << outcome.out;
    EXPECT_GT(pair["found"]["mac"].get<double>(), 0.8) << outcome.out;
    EXPECT_LT(pair["change"].get<double>(), 1e-3) << outcome.out;
    least = std::min(least, pair["change"].get<double>());
  }
  EXPECT_LT(least, -0.05) << outcome.out;
  expect_error(voussoir({"modal", "run", "--state", "intact"}, {.folder = folder.path()}), 2,
               {"--state applies to a case"});
  // A checkpoint of the intact beginning: no drop at all.
  std::string begin;
  for (const auto& entry : std::filesystem::directory_iterator(folder / "run/checkpoints"))
    if (entry.path().filename().string().starts_with("stage_01")) begin = entry.path().string();
  ASSERT_EQ(voussoir({"modal", begin, "-n", "3", "--no-pictures", "-q"}, {.folder = folder.path()}).status, 0);
  for (const nlohmann::json& pair : modes_of(folder / "run/modes")["intact"]["pairs"])
    EXPECT_NEAR(pair["change"].get<double>(), 0.0, 0.03);
}

TEST(Modal, UnderGravityOpensWhatHasNoBond) {
  const Folder folder;
  write_wall(folder);
  const auto first = [&](const std::vector<std::string>& more) {
    std::vector<std::string> words = {"modal", "wall.toml", "-n", "2", "--no-pictures", "-q", "-o", "out"};
    words.insert(words.end(), more.begin(), more.end());
    const Outcome outcome = voussoir(words, {.folder = folder.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return modes_of(folder / "out")["modes"][0]["frequency"].get<double>();
  };
  const double intact = first({}), gravity = first({"--state", "gravity"}),
               geometric = first({"--state", "gravity", "--geometric"});
  EXPECT_LE(gravity, intact * (1 + 1e-4)) << "but for its being a little lower";
  EXPECT_GT(gravity, 0.3 * intact);
  EXPECT_LT(geometric, gravity) << "its weight softens a wall";
}

TEST(Modal, AskedWronglySaysWhatIsRight) {
  const Folder folder;
  folder.write("column.toml", column);
  const auto refused = [&](std::vector<std::string> words, const std::vector<std::string>& pieces) {
    words.insert(words.begin(), "modal");
    expect_error(voussoir(words, {.folder = folder.path()}), 2, pieces);
    EXPECT_FALSE(exists(folder / "column-modes"));
  };
  refused({}, {"CASE is missing"});
  refused({"nothing.toml"}, {"no file or folder nothing.toml"});
  refused({"column.toml", "-n", "0"}, {"--modes is 0"});
  refused({"column.toml", "-n", "61"}, {"number of modes is 61", "60 unknowns", "at most 60"});
  refused({"column.toml", "--state", "broken"}, {"--state is broken", "intact or gravity"});
  refused({"column.toml", "--geometric"}, {"--state gravity"});
  refused({"column.toml", "--as-stored"}, {"--as-stored", "is a case"});
  refused({"column.toml", "--view", "below"}, {"below", "oblique"});
  refused({"column.toml", "--hide", "roof"}, {"roof"});
  refused({"column.toml", "--against", "none.h5"}, {"none.h5"});
  refused({"column.toml", "--paper"}, {"--paper takes no case"});
  std::filesystem::create_directory(folder / "empty");
  refused({"empty"}, {"empty has no checkpoints"});
  ASSERT_EQ(voussoir({"generate", "column.toml", "-o", "column.h5"}, {.folder = folder.path()}).status, 0);
  refused({"column.h5"}, {"block assembly", "[bridge] assembly"});
}

TEST(Modal, AgainstAnotherStructureIsRefused) {
  const Folder folder;
  folder.write("column.toml", column);
  write_wall(folder);
  ASSERT_EQ(voussoir({"modal", "column.toml", "-q", "--no-pictures"}, {.folder = folder.path()}).status, 0);
  expect_error(
      voussoir({"modal", "wall.toml", "-o", "out", "--against", "column-modes/modes.h5"}, {.folder = folder.path()}), 2,
      {"same structure"});
}

TEST(Modal, OfWhatCannotMoveIsRefused) {
  const Folder folder;
  folder.write("column.toml", column);
  ASSERT_EQ(voussoir({"generate", "column.toml", "-o", "column.h5"}, {.folder = folder.path()}).status, 0);
  Assembly assembly = read_assembly(folder / "column.h5");
  for (Block& block : assembly.blocks) block.fixed = true;
  write_assembly(folder / "fixed.h5", assembly);
  folder.write("fixed.toml", "[bridge]\nassembly = \"fixed.h5\"\n");
  const Outcome outcome = voussoir({"modal", "fixed.toml"}, {.folder = folder.path()});
  expect_error(outcome, 2, {"fixed"});
  EXPECT_NE(outcome.err.find("move"), std::string::npos) << outcome.err;
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
