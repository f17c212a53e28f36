// Pictures without a screen: of a run, a checkpoint, an assembly.
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <set>

#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Width and height in a PNG's header; zeros when it is no PNG.
std::array<int, 2> size_of(const std::string& png) {
  const std::string bytes = bytes_of(png);
  if (bytes.size() < 24 || !bytes.starts_with("\x89PNG\r\n\x1a\n")) return {0, 0};
  const auto number = [&](std::size_t at) {
    int value = 0;
    for (std::size_t k = at; k < at + 4; ++k) value = value * 256 + static_cast<unsigned char>(bytes[k]);
    return value;
  };
  return {number(16), number(20)};
}

constexpr std::array<int, 2> small = {320, 240};

/// A finished run in "run", once for each test.
struct Pictures : testing::Test {
  Folder folder;
  Surroundings there{.folder = folder.path(), .environment = {{"DISPLAY", ""}}};

  void SetUp() override {
    write_wall(folder);
    run_whole(folder, "wall.toml", "run");
  }
  Outcome render(std::vector<std::string> words) {
    words.insert(words.begin(), "render");
    words.insert(words.end(), {"--width", "320", "--height", "240"});
    return voussoir(words, there);
  }
  /// Makes a picture and gives its bytes.
  std::string picture(std::vector<std::string> words) {
    words.insert(words.end(), {"-o", "picture.png"});
    std::filesystem::remove(folder / "picture.png");
    const Outcome outcome = render(words);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_EQ(size_of(folder / "picture.png"), small);
    return bytes_of(folder / "picture.png");
  }
};

TEST_F(Pictures, EachView) {
  std::set<std::string> different;
  for (const char* view : {"front", "side", "plan", "oblique"}) different.insert(picture({"run", "--view", view}));
  EXPECT_EQ(different.size(), 4u);
}

TEST_F(Pictures, EachColour) {
  std::set<std::string> different;
  for (const char* colour : {"opening", "slip", "displacement", "component", "stone"})
    different.insert(picture({"run", "--colour", colour}));
  EXPECT_EQ(different.size(), 5u);
}

TEST_F(Pictures, OfARunAtATime) {
  const std::string last = picture({"run"}), rest = picture({"run", "--time", "0"});
  EXPECT_NE(last, rest);
  EXPECT_EQ(last, picture({"run", "--time", "1000"})) << "the nearest frame is the last";
}

TEST_F(Pictures, OfACheckpointLikeTheFrameOfThatTime) {
  const std::string frame = picture({"run", "--time", "0.4"});
  EXPECT_EQ(frame, picture({"run/checkpoints/00000.400.h5"}));
}

TEST_F(Pictures, OfAnAssembly) {
  const std::string built = picture({"run/assembly.h5", "--colour", "component"});
  EXPECT_NE(built, picture({"run", "--colour", "component"}));
}

TEST_F(Pictures, WhereTheyGo) {
  EXPECT_EQ(render({"run", "-v", "front"}).status, 0);
  EXPECT_EQ(size_of(folder / "run/images/opening_front.png"), small);
  EXPECT_EQ(render({"run", "-o", "new/folder/"}).status, 0);
  EXPECT_EQ(size_of(folder / "new/folder/opening_oblique.png"), small);
  const Outcome quiet = render({"run/assembly.h5", "-q"});
  EXPECT_EQ(quiet.out + quiet.err, "");
  EXPECT_EQ(size_of(folder / "assembly.png"), small);
}

TEST_F(Pictures, WrongWishesAreRefused) {
  expect_error(render({"run", "--view", "behind"}), 2, {"behind", "front, side, plan or oblique"});
  expect_error(render({"run", "--colour", "red"}), 2, {"red", "opening"});
  expect_error(render({"run", "--hide", "roof"}), 2, {"roof"});
  expect_error(render({"run", "--hide", "wall,base"}), 2, {"nothing is left"});
  expect_error(render({"run", "--amplification", "nan"}), 2, {"amplification"});
  expect_error(render({"run", "--time", "nan"}), 2, {"--time"});
  expect_error(render({"run", "--range", "-1"}), 2, {"range"});
  expect_error(render({"nowhere"}), 2, {"nowhere"});
  expect_error(render({"run/checkpoints"}), 2, {"run/checkpoints"});
  expect_error(voussoir({"render", "run", "--width", "100000"}, there), 2, {"100000"});
  expect_error(voussoir({"render", "run", "--width", "10"}, there), 2, {"10"});
}

TEST_F(Pictures, ADamagedFrameIsNamed) {
  const std::string frame = folder / "run/vtk/blocks_000000.600.vtu", whole = bytes_of(frame);
  for (const std::string& bytes : {std::string("<VTKFile"), std::string(), whole.substr(0, whole.size() / 2)}) {
    set_bytes(frame, bytes);
    expect_error(render({"run", "-o", "x.png"}), 2, {"blocks_000000.600.vtu"});
  }
  // Files that VTK reads without a complaint.
  for (const auto& [word, other] : {std::pair{"DataArray type=", "DataArray tipe="},
                                    {"NumberOfPoints=", "NumberOfPoimts="},
                                    {"NumberOfCells=", "NumberOfCelms="},
                                    {"Name=\"component\"", "Name=\"compoment\""},
                                    {"Name=\"offsets\"", "Name=\"offsetz\""}}) {
    set_bytes(frame, exchanged(whole, word, other));
    SCOPED_TRACE(word);
    expect_error(render({"run", "-o", "x.png"}), 2, {""});
  }
  set_bytes(folder / "run/vtk/blocks.pvd", "no xml");
  expect_error(render({"run", "-o", "x.png"}), 2, {"blocks.pvd"});
  EXPECT_FALSE(exists(folder / "x.png"));
}

TEST_F(Pictures, WithADisplayThatDoesNotAnswer) {
  there.environment["DISPLAY"] = ":9876";
  picture({"run"});
}

TEST_F(Pictures, WithoutXvfbTheRunIsNotLost) {
  there.environment["PATH"] = "/nonexistent";
  expect_error(render({"run", "-o", "x.png"}), 2, {"xvfb"});
  const Outcome outcome = voussoir({"run", "wall.toml", "-o", "other"}, there);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("no pictures"), std::string::npos) << outcome.err;
}

TEST_F(Pictures, ParaViewSeriesNameTheirFrames) {
  for (const std::string kind : {"blocks", "joints"}) {
    const std::string pvd = bytes_of(folder / "run/vtk/" + kind + ".pvd");
    EXPECT_NE(pvd.find("type=\"Collection\""), std::string::npos);
    std::size_t frames = 0;
    for (std::size_t at = pvd.find("file=\""); at != std::string::npos; at = pvd.find("file=\"", at + 1)) {
      const std::string name = pvd.substr(at + 6, pvd.find('"', at + 6) - at - 6);
      EXPECT_TRUE(exists(folder / "run/vtk/" + name)) << name;
      ++frames;
    }
    EXPECT_EQ(frames, 5u);  // 0, 0.2, 0.4, 0.5 (end of the shaking), 0.6 s
  }
}

/// A plot of the case, a measured curve that is there and one that is not; the run's own folder holds what it needs.
TEST_F(Pictures, PlotsOfTheCase) {
  folder.write("plots.toml",
               bytes_of(folder / "wall.toml") +
                   "\n[[plot]]\nname = \"kinetic\"\ny = \"energy/kinetic\"\nmeasured = [{ file = \"there.csv\" "
                   "}, { file = \"not_there.csv\" }]\n");
  folder.write("there.csv", "s,J\n0,0\n1,2\n");
  const Outcome outcome = voussoir({"run", "plots.toml", "-o", "plotted"}, there);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_GT(size_of(folder / "plotted/images/kinetic.png")[0], 500);
  EXPECT_TRUE(std::filesystem::exists(folder / "plotted/measured_1_1.txt"));
  EXPECT_NE(bytes_of(folder / "plotted/run.log").find("kinetic.png is drawn without"), std::string::npos);
  expect_same_run(folder / "run", folder / "plotted");
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
