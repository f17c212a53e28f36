// The page of a run answers the stage that was run, and can be filed.
#include <gtest/gtest.h>
#include <sys/stat.h>

#include <regex>

#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Without its style and the case's text, so that words are those of the page.
std::string page_of(const std::string& run) {
  const std::string page = bytes_of(run + "/report.html");
  return page.substr(page.find("</style>"), page.find("<pre class=\"case\">") - page.find("</style>"));
}

std::string made(const Folder& folder, const std::string& text, const std::string& run) {
  folder.write(run + ".toml", text);
  const Outcome outcome = voussoir({"run", run + ".toml", "-o", run, "-q", "-j", "1"}, {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  return page_of(folder / run);
}

void expect_says(const std::string& page, const std::vector<std::string>& pieces) {
  for (const std::string& piece : pieces) EXPECT_NE(page.find(piece), std::string::npos) << piece << " is not said";
}

void expect_silent(const std::string& page, const std::vector<std::string>& pieces) {
  for (const std::string& piece : pieces) EXPECT_EQ(page.find(piece), std::string::npos) << piece << " is said";
}

const std::string arch = R"([bridge]
generator = "arch"
mean_radius = 10.0
thickness_ratio = 0.15
embrace_angle = 157.5
voussoirs = 7
kn = 1e11
ks = 1e11

[materials.masonry]
friction_angle = 40.0

[[stage]]
kind = "gravity"
)";

TEST(Report, OfGravityHasReactionsAgainstTheWeight) {
  Folder folder;
  const std::string page = made(folder, arch, "stands");
  expect_says(page, {"Under its own weight.", "The bridge stands.", "No joint has opened or slid",
                     "Reactions at the end", "springing left", "The sum of the vertical reactions is", "The model",
                     "Materials", "springing right (1 block): moves"});
  expect_silent(page, {"Histories", "Time, s", "Keystones", "Collapse", "Joints slid", "Damage by"});
  const nlohmann::json found = summary(folder / "stands");
  const double weight = found["inventory"]["weight"]["stones"].get<double>();
  double up = 0.0;
  for (const auto& [group, axes] : found["reactions"].items()) up += axes["z"]["last"].get<double>();
  EXPECT_NEAR(up, weight, 1e-5 * weight);
  EXPECT_TRUE(found["inventory"]["supports_each_once"].get<bool>());
}

TEST(Report, OfCollapseNumbersTheHinges) {
  Folder folder;
  const std::string page = made(folder, arch + R"(
[[stage]]
kind = "collapse"
load = [{ acceleration = [9.81, 0.0, 0.0] }]
tolerance = 0.0005
)",
                                "falls");
  expect_says(page, {"Collapse load.", "largest multiplier with an equilibrium", "a dynamic run just below",
                     "hinge, closed at the intrados", "hinge, closed at the extrados", "between arch 0 and base",
                     "Equilibria on the way", "The worst place is arch 0, at x ="});
  expect_silent(page, {"Histories", "Time, s"});
  const nlohmann::json hinges = summary(folder / "falls")["collapse"]["hinges"];
  ASSERT_EQ(hinges.size(), 4u) << "an arch pushed sideways turns on four";
  for (std::size_t i = 0; i < hinges.size(); ++i) EXPECT_EQ(hinges[i]["number"], i + 1);
}

TEST(Report, OfAShakenWallSaysWhatTheGroundDid) {
  Folder folder;
  Wall wall;
  wall.amplitude = 1.0;  // nothing falls
  wall.extra = "[[plot]]\nname = \"mine\"\ntitle = \"My own plot\"\ny = \"energy/kinetic\"\n";
  const std::string page = made(folder, case_text(wall), "shaken");
  expect_says(page, {"Ground motion", "PGA, m/s²", "The largest acceleration of the ground along one axis is 1 m/s²",
                     "My own plot", "Damping in stages with time steps", "Acceleration of the base"});
}

TEST(Report, CanBeFiled) {
  Folder folder;
  made(folder, arch, "filed");
  const std::string page = bytes_of(folder / "filed/report.html");
  EXPECT_TRUE(std::regex_search(page, std::regex("Computed on 20[0-9]{2}-[0-9]{2}-[0-9]{2}T.* by voussoir .*commit ")));
  EXPECT_TRUE(std::regex_search(page, std::regex("case\\.toml.*<code>[0-9a-f]{64}</code>")));
  EXPECT_TRUE(std::regex_search(page, std::regex("assembly\\.h5.*<code>[0-9a-f]{64}</code>")));
  EXPECT_NE(page.find("<figure class=\"sheet\"><svg"), std::string::npos) << "the general arrangement";
  EXPECT_NE(page.find("embrace_angle = 157.5"), std::string::npos) << "the case";
  EXPECT_EQ(page.find("<script"), std::string::npos);
}

/// A folder with one program of that name, a shell script.
void write_program(const Folder& folder, const std::string& name, const std::string& script) {
  folder.write(name, "#!/bin/sh\n" + script);
  ::chmod((folder / name).c_str(), 0755);
}

TEST(Report, IsPrintedByTheBrowserThatIsThere) {
  Folder folder;
  folder.write("arch.toml", arch);
  run_whole(folder, "arch.toml", "run");
  Folder programs;
  write_program(programs, "chromium",
                "for word; do case $word in --print-to-pdf=*) echo %PDF-made > \"${word#*=}\";; esac; done\n");
  const Surroundings there{.folder = folder.path(), .environment = {{"PATH", programs.path() + ":/usr/bin:/bin"}}};
  const Outcome printed = voussoir({"report", "run", "--pdf"}, there);
  EXPECT_EQ(printed.status, 0) << printed.err;
  EXPECT_NE(printed.out.find("run/report.pdf"), std::string::npos) << printed.out;
  EXPECT_TRUE(bytes_of(folder / "run/report.pdf").starts_with("%PDF-made"));

  folder.write("page.html", "<p>of any verb</p>");
  EXPECT_EQ(voussoir({"report", "page.html", "--pdf", "-q"}, there).status, 0);
  EXPECT_TRUE(exists(folder / "page.pdf"));
  expect_error(voussoir({"report", "page.html"}, there), 2, {"Give --pdf to print it"});
  expect_error(voussoir({"report", "none.html", "--pdf"}, there), 2, {"no file none.html"});

  write_program(programs, "chromium", "exit 3\n");
  expect_error(voussoir({"report", "run", "--pdf"}, there), 1, {"chromium", "did not print", "exit status 3"});
  EXPECT_TRUE(bytes_of(folder / "run/report.pdf").starts_with("%PDF-made")) << "the earlier one is kept";

  Folder empty;
  const Surroundings nowhere{.folder = folder.path(), .environment = {{"PATH", empty.path()}}};
  expect_error(voussoir({"report", "run", "--pdf"}, nowhere), 2, {"Install the package chromium", "print it there"});
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
