// Bridges that are built in stages, as a user has them.
#include <gtest/gtest.h>

#include "solver/base/json_file.h"
#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

std::string bridge(const std::string& stage) {
  return "[bridge]\ngenerator = \"cs1\"\nblock_scale = 4.0\n[[stage]]\nkind = \"gravity\"\n" + stage;
}

/// What gravity did is said in the log, in its file, in the summary and on the page; modal finds the same state.
TEST(Construction, IsReportedAndKnownToModal) {
  const Folder folder;
  folder.write("bridge.toml", bridge("construction = \"staged\"\nlift = 3.0\n"));
  const Outcome outcome = voussoir({"run", "bridge.toml", "-o", "run"}, {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const char* words : {"construction, step 1 of", "arch on centering", "centering struck", "effects of gravity",
                            "arch-spandrel", "longitudinal, 1st order"})
    EXPECT_NE(outcome.err.find(words), std::string::npos) << words << "\n" << outcome.err;
  const nlohmann::json report = read_json(folder / "run/gravity.json")[0];
  EXPECT_EQ(report["construction"], "staged");
  EXPECT_EQ(report["periods"].size(), 3u);
  EXPECT_EQ(summary(folder / "run")["gravity"][0], report);
  EXPECT_NE(bytes_of(folder / "run/report.html").find("Effects of gravity"), std::string::npos);
  for (const auto& part : report["parts"]) EXPECT_LT(std::abs(part["settlement"].get<double>()), 0.02) << part.dump();
  // The same state by two ways.
  ASSERT_EQ(voussoir({"modal", "bridge.toml", "--state", "gravity", "-o", "own", "-n", "3", "--no-pictures"},
                     {.folder = folder.path()})
                .status,
            0);
  ASSERT_EQ(
      voussoir({"modal", "run", "--as-stored", "-o", "stored", "-n", "3", "--no-pictures"}, {.folder = folder.path()})
          .status,
      0);
  const nlohmann::json own = read_json(folder / "own/modes.json"), stored = read_json(folder / "stored/modes.json");
  for (std::size_t i = 0; i < 3; ++i)
    EXPECT_NEAR(own["modes"][i]["frequency"].get<double>(), stored["modes"][i]["frequency"].get<double>(), 1e-6);
}

/// The resolved case of a run is the case: its steps too.
TEST(Construction, StepsOfACaseComeBackAsTheyWere) {
  const Folder folder;
  folder.write(
      "bridge.toml",
      bridge("construction = [ { add = [\"pier\", \"abutment\", \"infill\", \"backfill\"], below = 9.5, lift = 4.0 }, "
             "{ add = [\"arch\"], centering = true }, { add = [\"backing\"] }, { strike = [\"arch\"] }, "
             "{ add = [\"spandrel\", \"backfill\"], label = \"the rest\" }, { add = [\"parapet\"] } ]\n"));
  ASSERT_EQ(voussoir({"run", "bridge.toml", "-o", "one", "--no-pictures"}, {.folder = folder.path()}).status, 0);
  const Outcome again = voussoir({"run", "one/case.toml", "-o", "two", "--no-pictures"}, {.folder = folder.path()});
  ASSERT_EQ(again.status, 0) << again.err;
  EXPECT_NE(again.err.find("the rest"), std::string::npos) << again.err;
  EXPECT_EQ(summary(folder / "one")["state_hash"], summary(folder / "two")["state_hash"]);
}

TEST(Construction, IsRefusedWhereItLeavesSomethingOut) {
  const Folder folder;
  const auto refused = [&](const std::string& stage, const std::vector<std::string>& words) {
    folder.write("bridge.toml", bridge(stage));
    expect_error(voussoir({"run", "bridge.toml", "-o", "run", "--no-pictures"}, {.folder = folder.path()}), 2, words);
  };
  refused("construction = \"stages\"\n", {"'construction'", "did you mean \"staged\"?"});
  refused("construction = [ { add = [\"pier\"] } ]\n", {"bridge.toml", "no step adds", "of arch"});
  refused("construction = [ { add = [\"vault\"] } ]\n",
          {"this assembly has no \"vault\"", "expected one of: abutment, arch"});
  refused("construction = [ { add = [\"piers\"] } ]\n", {"this assembly has no \"piers\"", "did you mean 'pier'?"});
  refused(
      "construction = [ { add = [\"parapet\"] }, { add = [\"pier\", \"abutment\", \"infill\", \"arch\", \"backing\", "
      "\"spandrel\", \"backfill\"] } ]\n",
      {"step 1", "has no support", "on centering"});
  refused("construction = [ { label = \"nothing\" } ]\n", {"'add'", "or 'strike'"});
  refused("lift = 2.0\n", {"'lift'", "construction = \"staged\""});
  refused("[[stage]]\nkind = \"gravity\"\nconstruction = \"staged\"\n",
          {"'construction'", "is only for the first stage"});
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
