// voussoir generate --picture and --template, as a user calls them.
#include <gtest/gtest.h>

#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

bool is_png(const std::string& file) {
  return bytes_of(file).starts_with("\x89PNG\r\n\x1a\n");
}

struct Arrangements : testing::Test {
  Folder folder;
  Surroundings there{.folder = folder.path(), .environment = {{"DISPLAY", ""}}};
};

struct ArrangementsOf : Arrangements, testing::WithParamInterface<const char*> {};

TEST_P(ArrangementsOf, AGenerator) {
  const std::string name = GetParam();
  std::string text = "[bridge]\ngenerator = \"" + name + "\"\n";
  if (name == "bridge" || name.starts_with("cs")) text += "block_scale = 3.0\n";
  folder.write(name + ".toml", text);
  const Outcome outcome = voussoir({"generate", name + ".toml", "--picture"}, there);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("drawn in " + name + ".svg, " + name + ".pdf and " + name + ".png"), std::string::npos)
      << outcome.out;
  const std::string svg = bytes_of(folder / (name + ".svg"));
  EXPECT_TRUE(svg.starts_with("<svg "));
  EXPECT_NE(svg.find("generator " + name), std::string::npos);
  EXPECT_NE(svg.find("Scale 1:"), std::string::npos);
  EXPECT_TRUE(is_png(folder / (name + ".png")));
  EXPECT_TRUE(bytes_of(folder / (name + ".pdf")).starts_with("%PDF-"));
  EXPECT_TRUE(exists(folder / (name + ".h5")));
}

INSTANTIATE_TEST_SUITE_P(All, ArrangementsOf,
                         testing::Values("bridge", "cs1", "cs2", "arch", "wall", "column", "filled-arch"));

TEST_F(Arrangements, OfImportedStonesWhereAsked) {
  folder.write("stones.obj", cube("low", 0, 0, 0, 1) + cube("high", 0.2, 0, 1, 9));
  ASSERT_EQ(voussoir({"import", "stones.obj", "-o", "stones.h5"}, there).status, 0);
  const Outcome outcome = voussoir({"generate", "stones.h5", "--picture=drawn/sheet.png"}, there);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_TRUE(is_png(folder / "drawn/sheet.png"));
  const std::string svg = bytes_of(folder / "drawn/sheet.svg");
  EXPECT_NE(svg.find("assembly stones.h5"), std::string::npos);
  EXPECT_NE(svg.find(">1.00<"), std::string::npos);
}

TEST_F(Arrangements, TemplateRunsAsItStands) {
  const Outcome text =
      voussoir({"generate", "--template", "--spans", "3,4.5", "--shape", "elliptical", "--width", "3"}, there);
  ASSERT_EQ(text.status, 0) << text.err;
  folder.write("mine.toml", text.out);
  const Outcome built = voussoir({"generate", "mine.toml"}, there);
  EXPECT_EQ(built.status, 0) << built.err;
  EXPECT_EQ(built.err, "");
  EXPECT_EQ(voussoir({"info", "mine.toml"}, there).status, 0);
}

TEST_F(Arrangements, RefusesWhatTheTemplateCannotBe) {
  expect_error(voussoir({"generate", "--template", "--spans", "8,wide"}, there), 2,
               {"--spans contains 'wide'", "8,10,8"});
  expect_error(voussoir({"generate", "--template", "--spans", "8,0"}, there), 2, {"--spans has 0 m", "0.3 to 100 m"});
  expect_error(voussoir({"generate", "--template", "--shape", "segmentel"}, there), 2, {"did you mean 'segmental'"});
  expect_error(voussoir({"generate", "--template", "--shape", "surveyed"}, there), 2, {"needs its intrados"});
  expect_error(voussoir({"generate", "--spans", "8"}, there), 2, {"--spans is an option of the template"});
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
