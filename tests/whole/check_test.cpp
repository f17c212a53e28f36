// voussoir check: exit status, table, check.json, and what it says of wrong checks.
#include <gtest/gtest.h>

#include <nlohmann/json.hpp>

#include "tests/whole/cases.h"
#include "tests/whole/program.h"

namespace voussoir::test {
namespace {

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
  EXPECT_NE(good.out.find("1 of 1 quantities"), std::string::npos) << good.out;
  const Outcome both = voussoir({"check", "good.toml", "bad.toml", "-o", "runs"}, there);
  EXPECT_EQ(both.status, 1);
  EXPECT_NE(both.out.find("MISS"), std::string::npos) << both.out;
  const nlohmann::json rows = nlohmann::json::parse(bytes_of(folder / "runs/check.json"));
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
  expect_error(voussoir({"check", "nothing"}, there), 2, {"nothing", "--list"});
  folder.write("none.toml", case_text({}));
  expect_error(voussoir({"check", "none.toml"}, there), 2, {"none.toml", "no [[check]]"});
  folder.write("place.toml", tipping("0.5", "collapse.multiplicator"));
  expect_error(voussoir({"check", "place.toml"}, there), 2, {"'multiplicator'", "multiplier"});
  folder.write("zero.toml", tipping("0.0"));
  for (const char* verb : {"check", "run", "info"})
    expect_error(voussoir({verb, "zero.toml"}, there), 2, {"zero.toml:", "share of zero", "'within'"});
}

}  // namespace
}  // namespace voussoir::test
