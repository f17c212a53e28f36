// Keys of a motion stage that say what a record is; synthetic motions that nothing is shaken by.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cmath>
#include <filesystem>

#include "io/case/case.h"
#include "io/info/describe_file.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

const std::string head =
    "[bridge]\ngenerator = \"column\"\nblocks = 3\n[[stage]]\nkind = \"gravity\"\n[[stage]]\nkind = "
    "\"motion\"\nduration = 1.0\n";

Case parsed(const test::Folder& folder, const std::string& keys, CaseUse use = CaseUse::run) {
  return parse_case(head + keys, folder / "c.toml", use);
}
std::string fault(const test::Folder& folder, const std::string& keys, CaseUse use = CaseUse::run) {
  return test::message_of<InputError>([&] { parsed(folder, keys, use); });
}
const GroundMotion& motion_of(const Case& c) {
  return c.settings.stages.at(1).motion;
}

TEST(RecordKeys, ColumnsOfATable) {
  const test::Folder folder;
  folder.write("a.txt", "0 10 1 2 3\n0.01 20 -1 4 -8\n0.02 0 0 0 0\n");
  const std::string record = "record = \"a.txt\"\n";
  const Case c = parsed(folder, record + "columns = [\"t\", \"\", \"x\", \"y\", \"z\"]\nunits = \"cm/s2\"\n");
  EXPECT_NEAR((motion_of(c).acceleration.at(1) - Vec3(-0.01, 0.04, -0.08)).norm(), 0.0, 1e-15);
  EXPECT_NEAR(motion_of(c).dt, 0.01, 1e-12);
  // The resolved copy in a run's folder says the same.
  std::filesystem::create_directory(folder / "run");
  write_resolved_case(c, folder / "run");
  const Case copy = read_case(folder / "run/case.toml");
  EXPECT_EQ(copy.hash, c.hash);
  EXPECT_EQ(motion_of(copy).acceleration, motion_of(c).acceleration);
  EXPECT_NE(fault(folder, record + "columns = [\"t\", \"x\"]\n").find("5 columns, but 'columns' names 2"),
            std::string::npos);
  EXPECT_NE(fault(folder, record + "columns = [\"t\", \"up\"]\n").find("contains \"up\". Give t, x, y or z"),
            std::string::npos);
  EXPECT_NE(fault(folder, record + "columns = [\"x\", \"x\"]\n").find("contains \"x\" twice"), std::string::npos);
  EXPECT_NE(fault(folder, record).find("for several name them: columns ="), std::string::npos);
  EXPECT_NE(fault(folder, "record = [\"a.txt\", \"a.txt\"]\ncolumns = [\"t\", \"x\"]\n").find("is for a single file"),
            std::string::npos);
}

TEST(RecordKeys, ScaledToAPeak) {
  const test::Folder folder;
  folder.write("a.csv", "time (s), EW (g), NS (g)\n0, 0.1, 0.2\n0.01, -0.4, 0.1\n0.02, 0, 0\n");
  folder.write("still.csv", "time (s), EW (g)\n0, 0\n0.01, 0\n");
  const Case c = parsed(folder, "record = \"a.csv\"\nscale_to_pga = 3.0\n");
  EXPECT_NEAR((motion_of(c).acceleration.at(1) - Vec3(-3.0, 0.75, 0.0)).norm(), 0.0, 1e-12);
  const Case half = parsed(folder, "record = \"a.csv\"\nscale_to_pga = 3.0\nscale = 0.5\n");
  EXPECT_NEAR(motion_of(half).acceleration.at(1).x(), -1.5, 1e-12);
  EXPECT_EQ(motion_of(parse_case(resolved_text(parsed(folder,
                                                      "pulse = { kind = \"sine\", axis = \"x\", amplitude = 1.0, "
                                                      "frequency = 2.0 }\nscale_to_pga = 3.0\n")),
                                 "c.toml"))
                .acceleration,
            motion_of(parsed(folder,
                             "pulse = { kind = \"sine\", axis = \"x\", amplitude = 1.0, frequency = 2.0 }\n"
                             "scale_to_pga = 3.0\n"))
                .acceleration);
  EXPECT_NE(fault(folder, "record = \"still.csv\"\nscale_to_pga = 3.0\n").find("ground motion is zero"),
            std::string::npos);
  EXPECT_NE(fault(folder, "record = \"a.csv\"\nscale_to_pga = 0\n"), "");
  EXPECT_NE(fault(folder, "record = \"a.csv\"\nunits = \"g\"\n").find("states its own units"), std::string::npos);
}

/// Hundreds of motions of a million samples: they are checked, and not made.
TEST(RecordKeys, SyntheticMotionsAreNotMadeForTheGeometry) {
  const test::Folder folder;
  const std::string keys =
      "synthetic = { spectrum = \"en1998-1\", ag = 0.2, soil = \"C\", duration = 5000.0, axes = [\"x\", \"y\", \"z\"] "
      "}\n";
  const auto begin = std::chrono::steady_clock::now();
  for (int i = 0; i < 100; ++i) EXPECT_TRUE(motion_of(parsed(folder, keys, CaseUse::geometry)).acceleration.empty());
  EXPECT_LT(std::chrono::duration<double>(std::chrono::steady_clock::now() - begin).count(), 10.0);
  EXPECT_NE(describe_file(folder.write("c.toml", head + keys)).find("5000 s of synthetic motion"), std::string::npos);
  // What is wrong with the keys is said all the same.
  for (const CaseUse use : {CaseUse::run, CaseUse::geometry}) {
    EXPECT_NE(fault(folder, "synthetic = { peak = 1.0, duration = 0.01 }\n", use).find("fewer than 20 time steps"),
              std::string::npos);
    EXPECT_NE(fault(folder, "synthetic = { peak = 1e3 }\nscale = 100\n", use).find("peak of 1e+05 m/s2"),
              std::string::npos);
    EXPECT_NE(fault(folder, "synthetic = { peak = 1.0, rise = 0.9 }\n", use).find("'rise' is 0.9"), std::string::npos);
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
