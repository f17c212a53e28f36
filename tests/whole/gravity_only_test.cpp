// Runs whose stages take no time, as a user meets them: rows, frames, reactions and sensors of every stage; what is
// said and drawn where nothing comes to rest.
#include <gtest/gtest.h>

#include "io/hdf5/history_file.h"
#include "solver/base/json_file.h"
#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

const std::string column = R"([bridge]
generator = "column"
blocks = 3
kn = 1e9
ks = 1e9

[[stage]]
kind = "gravity"

[[stage]]
kind = "gravity"
label = "pushed"
load = [{ acceleration = [0.2, 0.0, 0.0] }]

[[sensor]]
id = "top"
position = [0.0, 0.0, 1.2]
direction = "x"
)";

TEST(GravityOnly, EveryStageHasItsRowAndFrame) {
  Folder folder;
  folder.write("c.toml", column);
  run_whole(folder, "c.toml", "run");
  const History history = History::load(folder / "run/history.h5");
  ASSERT_EQ(history.rows(), 2u);
  EXPECT_EQ(history.values("stage"), (std::vector<double>{1.0, 2.0}));
  int frames = 0;
  for (const std::string& name : names_in(folder / "run/vtk")) frames += name.ends_with(".vtu");
  EXPECT_EQ(frames, 2);

  const nlohmann::json found = summary(folder / "run");
  ASSERT_EQ(found.at("stages").size(), 2u) << json_text(found);
  const nlohmann::json &first = found["stages"][0], &second = found["stages"][1];
  EXPECT_EQ(second["label"], "pushed");
  const double weight = first["reactions"]["base"][2].get<double>();
  EXPECT_GT(weight, 0.0);
  EXPECT_NEAR(second["reactions"]["base"][2].get<double>(), weight, 1e-5 * weight);
  EXPECT_NEAR(second["reactions"]["base"][0].get<double>(), -0.2 / 9.81 * weight, 1e-5 * weight);
  const auto since_built = [](const nlohmann::json& stage) {
    return stage["sensors"]["top"]["since_built"].get<double>();
  };
  EXPECT_NEAR(since_built(first), 0.0, 1e-12);
  EXPECT_GT(since_built(second), 1e-7) << "what the load has moved it";
  EXPECT_EQ(found["sensors"]["top"]["largest"], 0.0) << "it counts from the last gravity stage";
  EXPECT_EQ(found["reactions"]["base"]["z"]["last"], second["reactions"]["base"][2]);

  const Outcome seen = voussoir({"info", "run/history.h5"}, {.folder = folder.path()});
  EXPECT_EQ(seen.status, 0) << seen.err;
  EXPECT_NE(seen.out.find("2 rows"), std::string::npos) << seen.out;
}

TEST(GravityOnly, TakenUpBetweenItsStagesItIsTheSame) {
  Folder folder;
  folder.write("c.toml", exchanged(column, "kind = \"gravity\"\n\n[[stage]]",
                                   "kind = \"gravity\"\n[[stage]]\nkind = \"free\"\nduration = 0.01\n[[stage]]"));
  run_whole(folder, "c.toml", "whole");
  run_whole(folder, "c.toml", "parts", {"--until", "0.004"});
  const Outcome end = voussoir({"resume", "parts", "--no-pictures"}, {.folder = folder.path()});
  ASSERT_EQ(end.status, 0) << end.err;
  expect_same_run(folder / "whole", folder / "parts");
}

/// Two g sideways: the stones on their way are named, and drawn.
TEST(GravityOnly, WhatFallsIsNamedAndDrawn) {
  Folder folder;
  folder.write("c.toml", exchanged(column, "[0.2, 0.0, 0.0]", "[20.0, 0.0, 0.0]"));
  const Outcome run = voussoir({"run", "c.toml", "-o", "run"}, {.folder = folder.path()});
  expect_error(run, 1, {"block 2", "+x"});
  EXPECT_TRUE(exists(folder / "run/images/moving.png"));
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
