// The crack map of a run by the program.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

using std::filesystem::exists;

struct CrackMapOfARun : testing::Test {
  Folder folder;
  Surroundings there{.folder = folder.path(), .environment = {{"DISPLAY", ""}}};

  void SetUp() override {
    write_wall(folder);
    run_whole(folder, "wall.toml", "run");
  }
};

TEST_F(CrackMapOfARun, IsWrittenAsAsked) {
  const Outcome outcome = voussoir({"cracks", "run"}, there);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("run/images/crack_map.pdf"), std::string::npos) << outcome.out;
  EXPECT_TRUE(bytes_of(folder / "run/images/crack_map.svg").starts_with("<svg "));
  EXPECT_TRUE(bytes_of(folder / "run/images/crack_map.pdf").starts_with("%PDF-"));
  EXPECT_TRUE(bytes_of(folder / "run/images/crack_map.png").starts_with("\x89PNG"));
  EXPECT_TRUE(bytes_of(folder / "run/cracks.csv").starts_with("number,where,direction,"));
  EXPECT_NE(bytes_of(folder / "run/images/crack_map.svg").find("No intrados"), std::string::npos);
  // A checkpoint, one format, one state, quietly.
  const Outcome quiet =
      voussoir({"cracks", "run/checkpoints/00000.400.h5", "-o", "out/early.pdf", "--now", "-q"}, there);
  ASSERT_EQ(quiet.status, 0) << quiet.err;
  EXPECT_EQ(quiet.out + quiet.err, "");
  EXPECT_TRUE(exists(folder / "out/early.pdf"));
  EXPECT_TRUE(exists(folder / "out/early.csv"));
  EXPECT_FALSE(exists(folder / "out/early.svg"));
}

TEST_F(CrackMapOfARun, NothingBeyondTheThresholdIsSaid) {
  const Outcome outcome = voussoir({"cracks", "run", "--threshold", "1000", "-o", "none", "--format", "svg"}, there);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("no joint has opened or slid by 1000 mm or more"), std::string::npos) << outcome.out;
  EXPECT_NE(bytes_of(folder / "none.svg").find("No joint has opened or slid by 1000 mm or more."), std::string::npos);
}

TEST_F(CrackMapOfARun, WrongWishesAreRefused) {
  const auto refused = [&](std::vector<std::string> words, const std::vector<std::string>& pieces) {
    words.insert(words.begin(), "cracks");
    expect_error(voussoir(words, there), 2, pieces);
  };
  refused({"nowhere"}, {"nowhere"});
  refused({"wall.toml"}, {"wall.toml", "checkpoint"});
  refused({"run/assembly.h5"}, {"is a block assembly"});
  refused({"run", "--format", "gif"}, {"gif", "svg, pdf, png"});
  refused({"run", "--now", "--ever"}, {"--now", "--ever"});
  refused({"run", "--threshold", "0"}, {"threshold"});
  folder.write("empty/note", "");
  refused({"empty"}, {"empty has no checkpoints"});
}

TEST_F(CrackMapOfARun, IsOnThePageOfARunWithPictures) {
  const Outcome outcome = voussoir({"run", "wall.toml", "-o", "seen"}, there);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(exists(folder / "seen/images/crack_map.svg"));
  EXPECT_TRUE(exists(folder / "seen/cracks.csv"));
  const std::string page = bytes_of(folder / "seen/report.html");
  EXPECT_NE(page.find("Crack map of seen"), std::string::npos);
  EXPECT_NE(page.find("Class of the bridge: "), std::string::npos);
  EXPECT_TRUE(summary(folder / "seen").at("bridge_damage").contains("class"));
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
