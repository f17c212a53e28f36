// Quasi-static stages as a user meets them: table, page, pictures, and going on after an interruption.
#include <gtest/gtest.h>

#include <algorithm>

#include "io/hdf5/history_file.h"
#include "solver/base/json_file.h"
#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

const std::string settling = R"([bridge]
generator = "bridge"
backfill = "rigid"
width = 3.0
block_scale = 2.0
[[bridge.span]]
clear_span = 4.0
ring_thickness = 0.4
repeat = 2
[[bridge.pier]]
thickness = 1.0
height = 3.0

[[stage]]
kind = "gravity"

[[stage]]
kind = "quasi-static"
label = "the pier sinks"
drive = [{ group = "base pier 0", displacement = [0.0, 0.0, -0.004] }]
steps = 4
)";

/// The pier gives its load to the abutments; together they bear the weight at every step.
TEST(QuasiStaticRun, SinksAPierAndSaysWhatItDid) {
  Folder folder;
  folder.write("c.toml", settling);
  const Outcome run = voussoir({"run", "c.toml", "-o", "run"}, {.folder = folder.path()});
  ASSERT_EQ(run.status, 0) << run.err;
  const History history = History::load(folder / "run/history.h5");
  const std::vector<double>& share = history.values("steps/share");
  ASSERT_GE(history.rows(), 6u);  // gravity, the beginning, four steps, and where one was halved
  for (const double stop : {0.25, 0.5, 0.75, 1.0}) EXPECT_EQ(std::count(share.begin(), share.end(), stop), 1) << stop;
  EXPECT_TRUE(std::is_sorted(share.begin(), share.end()));
  const std::vector<double>& pier = history.values("reactions/base pier 0_z");
  const auto all = [&](std::size_t row) {
    return pier[row] + history.values("reactions/base abutment left_z")[row] +
           history.values("reactions/base abutment right_z")[row];
  };
  for (std::size_t row = 1; row < history.rows(); ++row) {
    EXPECT_NEAR(all(row), all(0), 1e-4 * all(0)) << row;
  }
  EXPECT_LT(pier.back(), pier[1]);  // what has torn on the way may give some of it back
  EXPECT_LT(history.values("places/pier top 0/displacement_z").back(), -0.003);
  EXPECT_NE(history.values("places/quarter 0 right/displacement_z").back(), 0.0);

  const nlohmann::json steps = summary(folder / "run").at("quasi_static");
  ASSERT_EQ(steps.size(), 1u);
  EXPECT_EQ(steps[0]["stage"], 2);
  EXPECT_EQ(steps[0]["equilibria"], history.rows() - 1);
  EXPECT_EQ(steps[0]["whole"], true);
  EXPECT_NEAR(steps[0]["displacement"].get<double>(), 0.004, 1e-12);
  const std::string table = bytes_of(folder / "run/steps.csv");
  EXPECT_EQ(std::size_t(std::count(table.begin(), table.end(), '\n')), history.rows());
  EXPECT_NE(table.find("deck/"), std::string::npos);
  const std::string page = bytes_of(folder / "run/report.html");
  for (const char* text : {"Quasi-static stages", "Capacity curve", "Settlement along the deck"})
    EXPECT_NE(page.find(text), std::string::npos) << text;
  for (const char* picture : {"capacity.png", "deck.png"})
    EXPECT_TRUE(exists(folder / ("run/images/" + std::string(picture)))) << picture;
  int frames = 0;
  for (const std::string& name : names_in(folder / "run/vtk"))
    frames += name.ends_with(".vtu") && name.find("fill") == std::string::npos;
  EXPECT_EQ(frames, 5);  // gravity, then one a step
}

TEST(QuasiStaticRun, TakenUpBetweenItsStepsItIsTheSame) {
  Folder folder;
  folder.write("c.toml", settling);
  run_whole(folder, "c.toml", "whole");
  run_whole(folder, "c.toml", "parts", {"--until", "0.5"});
  const Outcome end = voussoir({"resume", "parts", "--no-pictures"}, {.folder = folder.path()});
  ASSERT_EQ(end.status, 0) << end.err;
  expect_same_run(folder / "whole", folder / "parts");
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
