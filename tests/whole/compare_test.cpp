// Results side by side: the difference is that of the cases.
#include <gtest/gtest.h>

#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Rows of a CSV file by their first cell, which holds no comma in these tests.
std::map<std::string, std::vector<std::string>> rows_of(const std::string& path) {
  std::map<std::string, std::vector<std::string>> rows;
  std::string cell;
  std::vector<std::string> cells;
  bool quoted = false;
  for (const char c : bytes_of(path)) {
    if (c == '"') quoted = !quoted;
    if (c == '"') continue;
    if (!quoted && (c == ',' || c == '\n')) {
      cells.push_back(cell), cell.clear();
      if (c == '\n') rows[cells.front()] = cells, cells.clear();
      continue;
    }
    cell += c;
  }
  return rows;
}

std::string arch_of(double thickness) {
  return "[bridge]\ngenerator = \"arch\"\nmean_radius = 10.0\nthickness_ratio = " + std::to_string(thickness) +
         "\nembrace_angle = 157.5\nvoussoirs = 7\nkn = 1e11\nks = 1e11\n[materials.masonry]\nfriction_angle = 40.0\n"
         "[[stage]]\nkind = \"gravity\"\n[[stage]]\nkind = \"collapse\"\n"
         "load = [{ acceleration = [9.81, 0.0, 0.0] }]\ntolerance = 0.0005\n";
}

TEST(Compare, TwoArches) {
  Folder folder;
  folder.write("thin.toml", arch_of(0.15)), folder.write("thick.toml", arch_of(0.2));
  run_whole(folder, "thin.toml", "thin"), run_whole(folder, "thick.toml", "thick");
  const Surroundings there{.folder = folder.path()};
  const Outcome outcome = voussoir({"compare", "thin", "thick", "-o", "both"}, there);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto rows = rows_of(folder / "both/compare.csv");
  const std::vector<std::string>& collapse = rows.at("collapse: largest multiplier with an equilibrium");
  const double thin = summary(folder / "thin")["collapse"]["multiplier"],
               thick = summary(folder / "thick")["collapse"]["multiplier"];
  EXPECT_GT(thick, thin);
  EXPECT_NEAR(std::stod(collapse[2]), thin, 1e-9);
  EXPECT_NEAR(std::stod(collapse[3]), thick, 1e-9);
  EXPECT_NEAR(std::stod(collapse[4]), thick - thin, 1e-9);
  EXPECT_NEAR(std::stod(collapse[5]), 100.0 * (thick / thin - 1.0), 1e-6);
  const std::string page = bytes_of(folder / "both/compare.html");
  for (const char* piece :
       {"Keys in which the cases differ", "bridge.thickness_ratio", "Load and displacement",
        "thin: joints opened, oblique", "all pictures have the same scale", "Largest openings by parts"})
    EXPECT_NE(page.find(piece), std::string::npos) << piece;
  EXPECT_EQ(page.find("bridge.mean_radius"), std::string::npos) << "it is the same in both";
  EXPECT_TRUE(exists(folder / "both/images/opening_front_2.png"));
}

TEST(Compare, AResultWithItselfDiffersInNothing) {
  Folder folder;
  folder.write("a.toml", arch_of(0.15));
  run_whole(folder, "a.toml", "one"), run_whole(folder, "a.toml", "two");
  const Outcome outcome =
      voussoir({"compare", "one", "two", "-o", "both", "--no-pictures", "-q"}, {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.out, "");
  const std::string page = bytes_of(folder / "both/compare.html");
  EXPECT_NE(page.find("All cases have the same keys and values."), std::string::npos);
  EXPECT_NE(page.find("The following are the same in all results: "), std::string::npos);
  EXPECT_FALSE(exists(folder / "both/images/opening_front_1.png"));
}

TEST(Compare, ModesByTheirShapes) {
  Folder folder;
  const std::string column =
      "[bridge]\ngenerator = \"column\"\nblocks = 4\nkn = 1e9\nks = 1e9\n[materials.masonry]\ndensity = ";
  folder.write("light.toml", column + "2000.0\n"), folder.write("heavy.toml", column + "8000.0\n");
  const Surroundings there{.folder = folder.path()};
  for (const char* name : {"light", "heavy"}) {
    const Outcome made = voussoir({"modal", std::string(name) + ".toml", "-o", name, "--no-pictures", "-q"}, there);
    ASSERT_EQ(made.status, 0) << made.err;
  }
  const Outcome outcome = voussoir({"compare", "light", "heavy/modes.h5"}, there);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto rows = rows_of(folder / "compared/compare.csv");
  int modes = 0;
  for (const auto& [what, cells] : rows)
    if (what.starts_with("mode ")) {
      ++modes;
      EXPECT_NEAR(std::stod(cells[3]) / std::stod(cells[2]), 2.0, 1e-6) << what << ": four times the mass";
    }
  EXPECT_GT(modes, 3);
}

TEST(Compare, CampaignsMotionByMotion) {
  Folder folder;
  const std::string head = "run,case,record,event,scale,status,edp.keystone_x\n";
  folder.write("a/table.csv",
               head + "r1,free,one,e,1,done,0.010\nr2,free,two,e,1,done,0.020\nr3,free,three,e,1,failed,\n");
  folder.write("b/table.csv", head + "s1,tied,two,e,1,done,0.010\ns2,tied,one,e,1,done,0.008\n");
  const Outcome outcome = voussoir({"compare", "a", "b"}, {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const auto rows = rows_of(folder / "compared/compare.csv");
  const std::vector<std::string>& two = rows.at("edp.keystone_x, two × 1");
  EXPECT_NEAR(std::stod(two[2]), 20.0, 1e-9);
  EXPECT_NEAR(std::stod(two[3]), 10.0, 1e-9);
  const std::string page = bytes_of(folder / "compared/compare.html");
  EXPECT_NE(page.find("0.650"), std::string::npos) << "median of 0.8 and 0.5";
}

/// The values of a row and their difference have the same decimals, and the unit of all rows stands in the head.
TEST(Compare, NumbersOfARowHaveTheSameForm) {
  Folder folder;
  const std::string head = "run,case,record,event,scale,status,edp.keystone_x\n";
  folder.write("a/table.csv",
               head + "r1,c,small,e,1,done,0.0000123456\nr2,c,large,e,1,done,20.5\nr3,c,none,e,1,failed,\n");
  folder.write("b/table.csv", head + "s1,c,small,e,1,done,0.00001\ns2,c,large,e,1,done,20.4\ns3,c,none,e,1,done,0.5\n");
  const Outcome outcome = voussoir({"compare", "a", "b"}, {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const std::string page = bytes_of(folder / "compared/compare.html");
  const auto row = [](const std::string& what, std::vector<std::string> cells, const std::string& tag) {
    std::string text = "<tr><" + tag + ">" + what + "</" + tag + ">";
    for (const std::string& cell : cells) text += "<" + tag + " class=\"number\">" + cell + "</" + tag + ">";
    return text + "</tr>";
  };
  EXPECT_NE(page.find(row("quantity", {"a, mm", "b, mm", "difference, mm", "change, %"}, "th")), std::string::npos);
  EXPECT_NE(page.find(row("small × 1", {"0.01235", "0.01000", "−0.00235", "−19.0"}, "td")), std::string::npos) << page;
  EXPECT_NE(page.find(row("large × 1", {"20500", "20400", "−100", "−0.5"}, "td")), std::string::npos) << page;
  EXPECT_NE(page.find(row("none × 1", {"none", "500", "none", "none"}, "td")), std::string::npos) << page;
}

TEST(Compare, ErrorsSayWhatToGive) {
  Folder folder;
  folder.write("a.toml", arch_of(0.15));
  run_whole(folder, "a.toml", "run");
  folder.write("campaign/table.csv", "run,case,record,status,edp.x\nr,c,m,done,1\n");
  folder.write("empty/note.txt", "nothing");
  const Surroundings there{.folder = folder.path()};
  expect_error(voussoir({"compare", "run"}, there), 2, {"needs at least two"});
  expect_error(voussoir({"compare", "run", "nowhere"}, there), 2, {"no file or folder nowhere"});
  expect_error(voussoir({"compare", "run", "empty"}, there), 2, {"empty holds no results to compare", "summary.json"});
  expect_error(voussoir({"compare", "run", "campaign"}, there), 2, {"run is a run", "campaign is a campaign"});
  expect_error(voussoir({"compare", "run", "run"}, there), 2, {"given twice"});
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
