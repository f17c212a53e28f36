// voussoir step: what it prints and writes, and the log of a run under mass scaling.
#include <gtest/gtest.h>

#include <filesystem>
#include <nlohmann/json.hpp>

#include "solver/base/json_file.h"
#include "tests/whole/cases.h"
#include "tests/whole/program.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Ten blocks of 1 × 1 m, axial stiffness k = 4e9 N/m: ω_max is near 2 √(k/m).
const std::string column =
    "[bridge]\ngenerator = \"column\"\nblocks = 10\nkn = 4e9\nks = 1e7\n[damping]\nkind = \"none\"\n"
    "[[stage]]\nkind = \"gravity\"\n[[stage]]\nkind = \"free\"\nduration = 0.01\n";

nlohmann::json json_of(const std::string& file) {
  return read_json(file);
}

TEST(Step, SaysWhatSetsIt) {
  Folder folder;
  const Surroundings there{.folder = folder.path()};
  folder.write("column.toml", column);
  const Outcome outcome = voussoir({"step", "column.toml", "--bodies", "3", "-o", "step.json"}, there);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("set by block"), std::string::npos) << outcome.out;
  const nlohmann::json json = json_of(folder.path() + "/step.json");
  EXPECT_EQ(json["stiffest"].size(), 3u);
  EXPECT_LE(json["stiffest"][0]["step"].get<double>(), json["critical_step"].get<double>());
  EXPECT_GT(json["mass_scaling"][4]["step"].get<double>(), json["critical_step"].get<double>());
}

TEST(Step, IsLongerUnderMassScaling) {
  Folder folder;
  const Surroundings there{.folder = folder.path()};
  folder.write("plain.toml", column);
  folder.write("scaled.toml", column + "[analysis]\nmass_scaling_limit = 0.05\n");
  for (const char* name : {"plain", "scaled"})
    ASSERT_EQ(voussoir({"run", std::string(name) + ".toml", "-o", name}, there).status, 0);
  const nlohmann::json plain = json_of(folder.path() + "/plain/summary.json"),
                       scaled = json_of(folder.path() + "/scaled/summary.json");
  EXPECT_GT(scaled["time_step"].get<double>(), plain["time_step"].get<double>());
  EXPECT_NEAR(scaled["mass_scaling"]["share"].get<double>(), 0.05, 1e-6);
  EXPECT_FALSE(plain.contains("mass_scaling"));
}

TEST(Step, RefusesANegativeNumberOfBodies) {
  Folder folder;
  folder.write("column.toml", column);
  const Outcome outcome = voussoir({"step", "column.toml", "--bodies", "-1"}, {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 2);
  EXPECT_NE(outcome.err.find("--bodies is -1"), std::string::npos) << outcome.err;
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
