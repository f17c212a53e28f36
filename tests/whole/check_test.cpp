// voussoir check: exit status, tables, check.json, known misses, names of rungs, and what it says of wrong checks.
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>

#include "solver/base/json_file.h"
#include "tests/whole/cases.h"
#include "tests/whole/program.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// A column that tips at half its weight, and a check of that with so much expected.
std::string tipping(const std::string& expected, const std::string& value = "collapse.multiplier") {
  return "[bridge]\ngenerator = \"column\"\nblocks = 1\nwidth = 1.0\ndepth = 1.0\nblock_height = 2.0\nkn = 1e11\n"
         "ks = 1e11\n[materials.masonry]\nfriction_angle = 60\n[[stage]]\nkind = \"gravity\"\n[[stage]]\n"
         "kind = \"collapse\"\nload = [{ acceleration = [9.81, 0, 0] }]\nconfirm = 0.0\n[[check]]\nquantity = "
         "\"tips\"\n"
         "value = \"" +
         value + "\"\nexpected = " + expected + "\ntolerance = 0.01\nsource = \"statics\"\n";
}

TEST(Check, PassesAndMisses) {
  Folder folder;
  const Surroundings there{.folder = folder.path()};
  folder.write("good.toml", tipping("0.5"));
  folder.write("bad.toml", tipping("0.6"));
  const Outcome good = voussoir({"check", "good.toml"}, there);
  EXPECT_EQ(good.status, 0) << good.err;
  EXPECT_NE(good.out.find("1 of 1 quantity"), std::string::npos) << good.out;
  const Outcome both = voussoir({"check", "good.toml", "bad.toml", "-o", "runs"}, there);
  EXPECT_EQ(both.status, 1);
  EXPECT_NE(both.out.find("MISS"), std::string::npos) << both.out;
  const nlohmann::json rows = read_json(folder / "runs/check.json");
  ASSERT_EQ(rows.size(), 2u);
  EXPECT_EQ(rows[0]["name"], "good");
  EXPECT_TRUE(rows[0]["pass"].get<bool>());
  EXPECT_FALSE(rows[1]["pass"].get<bool>());
  EXPECT_NEAR(rows[1]["got"].get<double>(), 0.5, 0.005);
}

TEST(Check, ChangesOfTheCaseAreMergedIn) {
  Folder folder;
  folder.write("two.toml", tipping("0.5") +
                               "[[check]]\nquantity = \"taller\"\nvalue = \"collapse.multiplier\"\nexpected = 0.25\n"
                               "tolerance = 0.01\nsource = \"statics\"\nset = { bridge = { block_height = 4.0 } }\n"
                               "[[check]]\nquantity = \"slow\"\nvalue = \"steps\"\nexpected = 1\nwithin = 0\n"
                               "source = \"never run\"\nslow = true\n");
  const Surroundings there{.folder = folder.path()};
  const Outcome outcome = voussoir({"check", "two.toml"}, there);
  EXPECT_EQ(outcome.status, 0) << outcome.out << outcome.err;
  EXPECT_NE(outcome.out.find("2 of 2 quantities"), std::string::npos) << outcome.out;
  EXPECT_EQ(voussoir({"check", "two.toml", "--long", "-q"}, there).status, 1);
}

TEST(Check, SaysWhatIsWrong) {
  Folder folder;
  const Surroundings there{.folder = folder.path()};
  expect_error(voussoir({"check", "nothing"}, there), 2, {"nothing", "--list", "expected one of", "oppenheim"});
  expect_error(voussoir({"check", "axial-chian"}, there), 2, {"'axial-chian'", "did you mean 'axial-chain'?"});
  expect_error(voussoir({"check", "opppenheim"}, there), 2, {"did you mean 'oppenheim'?"});
  folder.write("none.toml", case_text({}));
  expect_error(voussoir({"check", "none.toml"}, there), 2, {"none.toml", "no [[check]]"});
  folder.write("place.toml", tipping("0.5", "collapse.multiplicator"));
  expect_error(voussoir({"check", "place.toml"}, there), 2, {"'multiplicator'", "multiplier"});
  folder.write("zero.toml", tipping("0.0"));
  for (const char* verb : {"check", "run", "info"})
    expect_error(voussoir({verb, "zero.toml"}, there), 2,
                 {"zero.toml:", "share of the expected value, which is 0", "'within'"});
}

TEST(Check, AKnownMissIsSaidAndDoesNotFail) {
  Folder folder;
  const Surroundings there{.folder = folder.path()};
  folder.write("known.toml", tipping("0.6") + "miss = \"the block is too tall\"\n");
  const Outcome known = voussoir({"check", "known.toml", "-o", "runs"}, there);
  EXPECT_EQ(known.status, 0) << known.err;
  EXPECT_NE(known.out.find("known miss: the block is too tall"), std::string::npos) << known.out;
  EXPECT_NE(known.out.find("0 of 1 quantity within their tolerance, 1 known miss\n"), std::string::npos) << known.out;
  EXPECT_EQ(known.out.find("MISS"), std::string::npos) << known.out;
  const nlohmann::json rows = read_json(folder / "runs/check.json");
  EXPECT_EQ(rows.at(0).at("known_miss"), "the block is too tall");
  EXPECT_FALSE(rows[0]["pass"].get<bool>());

  folder.write("both.toml", tipping("0.6") + "miss = \"too tall\"\n[[check]]\nquantity = \"steps\"\nvalue = " +
                                "\"steps\"\nexpected = -1\nwithin = 0\nsource = \"nonsense\"\n");
  const Outcome both = voussoir({"check", "both.toml"}, there);
  EXPECT_EQ(both.status, 1) << "a known miss excuses no other one";
  EXPECT_NE(both.out.find("0 of 2 quantities within their tolerance, 1 known miss\n"), std::string::npos) << both.out;

  folder.write("mended.toml", tipping("0.5") + "miss = \"too tall\"\n");
  const Outcome mended = voussoir({"check", "mended.toml"}, there);
  EXPECT_EQ(mended.status, 0);
  EXPECT_NE(mended.out.find("Remove its `miss`"), std::string::npos) << mended.out;

  folder.write("why.toml", tipping("0.6") + "miss = \"\"\n");
  for (const char* verb : {"check", "run"})
    expect_error(voussoir({verb, "why.toml"}, there), 2, {"why.toml:", "'miss'", "State why"});
}

TEST(Check, WritesAMarkdownTable) {
  Folder folder;
  const Surroundings there{.folder = folder.path()};
  folder.write("known.toml", tipping("0.6") + "miss = \"left | right\"\n");
  const Outcome outcome = voussoir({"check", "known.toml", "free-spin", "--table", "found.md", "-q"}, there);
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  const std::string table = bytes_of(folder / "found.md");
  EXPECT_EQ(table.find("Printed by `voussoir check` on 2"), 0u) << table;
  EXPECT_TRUE(table.find(", commit ") < table.find("\n") || table.find(", version ") < table.find("\n")) << table;
  for (const char* piece : {"| rung | quantity | expected | got | error | tolerance | result | source |\n| --- |",
                            "| known | tips | 0.6 | ", "| miss: left \\| right | statics |\n",
                            "| free-spin | largest change of energy in 100 turns | 0 | ", "| ok |"})
    EXPECT_NE(table.find(piece), std::string::npos) << piece << "\n" << table;
  expect_error(voussoir({"check", "free-spin", "--table", "none/found.md"}, there), 2, {"--table", "no folder none"});
}

TEST(Check, CaseTomlHasItsFoldersName) {
  Folder folder;
  std::filesystem::create_directory(folder / "tipping");
  folder.write("tipping/case.toml", tipping("0.5"));
  for (const auto& [place, file] : {std::pair{"", "tipping/case.toml"}, std::pair{"/tipping", "./case.toml"}}) {
    const Outcome outcome = voussoir({"check", file}, {.folder = folder.path() + place});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find("\ntipping "), std::string::npos) << outcome.out;
  }
}

/// Every file of tools/ladder is a rung of its name (CTest calls them so), and they stand before the cases. Those that
/// need linear programs are not there in a build without GLPK.
TEST(Check, ListsTheElementsOfTheMethodFirst) {
  const Outcome outcome = voussoir({"check", "--list"});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  std::set<std::string> listed, files;
  for (const auto& entry : std::filesystem::directory_iterator(VOUSSOIR_SOURCE_DIR "/tools/ladder")) {
    std::string name = entry.path().stem().string();
    std::replace(name.begin(), name.end(), '_', '-');
    if (entry.path().extension() == ".cpp" && name != "rungs") files.insert(name);
  }
  if (outcome.out.find("\nlimit-analysis ") == std::string::npos) {
    for (const char* name : {"axle-strip", "limit-analysis", "rings"}) EXPECT_EQ(files.erase(name), 1u) << name;
  }
  std::istringstream lines(outcome.out);
  for (std::string line; listed.size() < files.size() && std::getline(lines, line);)
    listed.insert(line.substr(0, line.find(' ')));
  EXPECT_EQ(listed, files);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
