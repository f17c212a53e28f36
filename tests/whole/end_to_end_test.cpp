// Each verb once on a small case, and what lies in the run directory afterwards.
#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>

#include "io/hdf5/history_file.h"
#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

bool has(const std::string& text, const std::string& piece) {
  return text.find(piece) != std::string::npos;
}

TEST(EndToEnd, GenerateWritesAnAssemblyAndItsTable) {
  Folder folder;
  write_wall(folder);
  const Surroundings there{.folder = folder.path()};
  const Outcome made = voussoir({"generate", "wall.toml"}, there);
  ASSERT_EQ(made.status, 0) << made.err;
  EXPECT_TRUE(has(made.out, "40 blocks, 99 joints")) << made.out;
  EXPECT_TRUE(has(made.out, "smallest block: number ")) << made.out;
  EXPECT_TRUE(has(made.out, "written to wall.h5")) << made.out;
  const Outcome info = voussoir({"info", "wall.h5"}, there);
  EXPECT_EQ(info.status, 0) << info.err;
  EXPECT_TRUE(has(info.out, "block assembly") && has(info.out, "40 blocks (1 fixed)") && has(info.out, "99 joints"))
      << info.out;
  const Outcome quiet = voussoir({"generate", "wall.toml", "-o", "again.h5", "-q"}, there);
  EXPECT_EQ(quiet.out + quiet.err, "");
  EXPECT_EQ(bytes_of(folder / "wall.h5"), bytes_of(folder / "again.h5"));
}

TEST(EndToEnd, RunDirectoryIsComplete) {
  Folder folder;
  write_wall(folder);
  const Surroundings there{.folder = folder.path(), .environment = {{"DISPLAY", ""}}};
  const Outcome outcome = voussoir({"run", "wall.toml", "-o", "run"}, there);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  for (const char* name :
       {"case.toml", "assembly.h5", "history.h5", "summary.json", "run.log", "vtk/blocks.pvd", "vtk/joints.pvd",
        "images/opening_oblique.png", "images/slip_front.png", "images/energy.png"})
    EXPECT_TRUE(exists(folder / "run/" + name)) << name;
  const auto checkpoints = names_in(folder / "run/checkpoints");
  EXPECT_EQ(checkpoints.size(), 6u);  // three, and one for the end of each of three stages
  EXPECT_EQ(std::count_if(checkpoints.begin(), checkpoints.end(), [](auto& n) { return n.starts_with("stage_"); }), 3);
  for (const auto& [name, bytes] : contents(folder / "run")) {
    EXPECT_FALSE(name.ends_with(".partial")) << name;
    EXPECT_FALSE(bytes.empty()) << name;
  }
  EXPECT_TRUE(has(bytes_of(folder / "run/run.log"), "done at t = 0.6"));
}

TEST(EndToEnd, SummaryHasTheKeysThatScriptsRead) {
  Folder folder;
  write_wall(folder);
  run_whole(folder, "wall.toml", "run", {"-q", "-j", "2"});
  const nlohmann::json json = summary(folder / "run");
  EXPECT_NEAR(json.at("end_time").get<double>(), 0.6, 1e-3);
  EXPECT_GT(json.at("steps").get<int>(), 1000);
  EXPECT_GT(json.at("wall_seconds").get<double>(), 0.0);
  double known = 0.0;
  for (const auto& [what, seconds] : json.at("seconds_of_this_part").items()) known += seconds.get<double>();
  EXPECT_GT(json.at("seconds_of_this_part").at("steps").get<double>(), 0.0);
  EXPECT_LE(known, json.at("wall_seconds").get<double>());
  EXPECT_EQ(json.at("threads").get<int>(), 1);  // 99 joints are not worth two
  EXPECT_EQ(json.at("state_hash").get<std::string>().size(), 16u);
  EXPECT_EQ(json.at("state_hash").get<std::string>().find_first_not_of("0123456789abcdef"), std::string::npos);
  EXPECT_LT(json.at("energy_error").get<double>(), 0.2);
  EXPECT_TRUE(json.at("demand").is_object());
  EXPECT_GT(json.at("damage").at("wall").at("largest_slip").get<double>(), 1e-4);
  EXPECT_TRUE(json.at("equilibrium").at("converged").get<bool>());
  EXPECT_TRUE(json.at("finished").get<bool>());
}

TEST(EndToEnd, DemandsOfAnArchAreInTheSummary) {
  Folder folder;
  folder.write("arch.toml", R"([bridge]
generator = "arch"
voussoirs = 15
[[stage]]
kind = "gravity"
[[stage]]
kind = "motion"
duration = 0.2
pulse = { kind = "sine", axis = "x", amplitude = 2.0, frequency = 5.0 }
)");
  run_whole(folder, "arch.toml", "run");
  const nlohmann::json demand = summary(folder / "run").at("demand");
  ASSERT_FALSE(demand.at("places").empty()) << demand;
  for (const auto& [place, values] : demand.at("places").items()) {
    EXPECT_GT(values.at("largest").get<double>(), 1e-6) << place;
    EXPECT_LE(std::abs(values.at("residual").get<double>()), values.at("largest").get<double>() + 1e-3) << place;
  }
  EXPECT_GT(demand.at("keystone_x").at("largest_mean").get<double>(), 1e-6);
}

TEST(EndToEnd, InfoKnowsEveryKindOfFile) {
  Folder folder;
  write_wall(folder);
  folder.write("record.txt", "# t a\n0.0 0.0\n0.1 1.5\n0.2 0.0\n");
  run_whole(folder, "wall.toml", "run");
  const std::vector<std::pair<std::string, std::string>> kinds = {{"wall.toml", "case"},
                                                                  {"run/case.toml", "case"},
                                                                  {"run/assembly.h5", "block assembly"},
                                                                  {"run/history.h5", "history"},
                                                                  {"record.txt", "record of 3 samples"}};
  for (const auto& [file, word] : kinds) {
    const Outcome outcome = voussoir({"info", file}, {.folder = folder.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(has(outcome.out, file + ": " + word)) << outcome.out;
  }
  for (const std::string& name : names_in(folder / "run/checkpoints")) {
    const Outcome outcome = voussoir({"info", "run/checkpoints/" + name}, {.folder = folder.path()});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_TRUE(has(outcome.out, "checkpoint of voussoir")) << outcome.out;
  }
  // The last checkpoint's state is the one of the summary.
  const Outcome last = voussoir({"info", "run/checkpoints/stage_03_00000.600.h5"}, {.folder = folder.path()});
  EXPECT_TRUE(has(last.out, "state " + summary(folder / "run").at("state_hash").get<std::string>())) << last.out;
}

TEST(EndToEnd, ImportedStonesRun) {
  Folder folder;
  folder.write("stones.obj", cube("lower", 0, 0, 0, 1) + cube("upper", 0, 0, 1, 9));
  const Surroundings there{.folder = folder.path()};
  const Outcome imported = voussoir({"import", "stones.obj", "-o", "stones.h5", "--friction", "35"}, there);
  ASSERT_EQ(imported.status, 0) << imported.err;
  EXPECT_TRUE(has(imported.out, "2 blocks, 1 joint")) << imported.out;
  folder.write("stones.toml", R"([bridge]
assembly = "stones.h5"
[[stage]]
kind = "gravity"
[[stage]]
kind = "free"
duration = 0.2
)");
  run_whole(folder, "stones.toml", "run");
  // Two cubes on one another stay: 0.2 s of rest move nothing by more than the elastic rest's rounding.
  const nlohmann::json damage = summary(folder / "run").at("damage");
  ASSERT_FALSE(damage.empty());
  for (const auto& [component, values] : damage.items()) EXPECT_LT(values.at("largest_slip").get<double>(), 1e-6);
}

TEST(EndToEnd, AnExistingRunIsNeverOverwrittenUnasked) {
  Folder folder;
  write_wall(folder);
  run_whole(folder, "wall.toml", "run");
  const auto before = contents(folder / "run");
  expect_error(voussoir({"run", "wall.toml", "-o", "run"}, {.folder = folder.path()}), 2,
               {"run already holds a run", "voussoir resume run", "--overwrite"});
  expect_unchanged(folder / "run", before);
  write_wall(folder, {.amplitude = 1.0});
  run_whole(folder, "wall.toml", "run", {"--overwrite"});
  EXPECT_NE(bytes_of(folder / "run/history.h5"), before.at("history.h5"));
}

TEST(EndToEnd, OverwritingLeavesNothingOfTheEarlierRun) {
  Folder folder;
  write_wall(folder);
  run_whole(folder, "wall.toml", "run");
  const std::vector<std::string> stale = {"report.html",    "modes/modes.txt",  "collapse_curve.csv", "joints.csv",
                                          "stresses.csv",   "steps.csv",        "cracks.csv",         "report.pdf",
                                          "motion_7_y.txt", "measured_2_10.txt"};
  std::filesystem::create_directory(folder / "run/modes");
  for (const std::string& name : stale) folder.write("run/" + name, "of another run");
  folder.write("run/motion_mine.txt", "kept");
  run_whole(folder, "wall.toml", "run", {"--overwrite"});
  for (const std::string& name : stale)
    EXPECT_FALSE(exists(folder / ("run/" + name)) && bytes_of(folder / ("run/" + name)) == "of another run") << name;
  EXPECT_EQ(bytes_of(folder / "run/motion_mine.txt"), "kept");
}

TEST(EndToEnd, OverwritingWithACaseThatCannotBeBuiltLosesNothing) {
  Folder folder;
  write_wall(folder);
  run_whole(folder, "wall.toml", "run");
  const auto before = contents(folder / "run");
  folder.write("wall.toml", exchanged(case_text({}), "position = [0.3", "position = [-30"));
  expect_error(voussoir({"run", "wall.toml", "-o", "run", "--overwrite"}, {.folder = folder.path()}), 2, {"\"foot\""});
  expect_unchanged(folder / "run", before);
}

TEST(EndToEnd, ARunDirectoryRunsAgainFromItsOwnCopies) {
  Folder folder;
  write_wall(folder);
  ASSERT_EQ(voussoir({"generate", "wall.toml", "-o", "wall.h5"}, {.folder = folder.path()}).status, 0);
  folder.write("read.toml", exchanged(case_text({}), "generator = \"wall\"\nlength_blocks = 6\ncourses = 6",
                                      "assembly = \"wall.h5\""));
  run_whole(folder, "read.toml", "first");
  run_whole(folder, "first/case.toml", "second");
  expect_same_run(folder / "first", folder / "second");
  // Onto itself: what it needs is in the folder that is to be emptied.
  run_whole(folder, "first/case.toml", "first", {"--overwrite"});
  expect_same_run(folder / "first", folder / "second");
}

TEST(EndToEnd, RecordsAreCopiedIntoTheRunDirectory) {
  Folder folder;
  folder.write("shake.txt", "0.0 0.0\n0.1 2.0\n0.2 -2.0\n0.3 0.0\n");
  folder.write("wall.toml",
               exchanged(case_text({}), "pulse = { kind = \"sine\", axis = \"y\", amplitude = 9, frequency = 2 }",
                         "record = [\"\", \"shake.txt\"]"));
  run_whole(folder, "wall.toml", "run", {"--until", "0.2"});
  ASSERT_EQ(::unlink((folder / "shake.txt").c_str()), 0);
  ASSERT_EQ(::unlink((folder / "wall.toml").c_str()), 0);
  EXPECT_EQ(voussoir({"resume", "run", "--no-pictures"}, {.folder = folder.path()}).status, 0);
}

TEST(EndToEnd, HistoryIsReadableWhileTheRunGoesOn) {
  Folder folder;
  write_wall(folder, {.shaken = 1.5, .checkpoints = 0.1, .fields = 0.05});
  Program program({"run", "wall.toml", "-o", "run", "--no-pictures", "-q"}, {.folder = folder.path()});
  ASSERT_TRUE(wait_until(program, [&] { return exists(folder / "run/history.h5"); }));
  std::size_t rows = 0, reads = 0;
  while (program.running()) {
    const History history = History::load(folder / "run/history.h5");
    EXPECT_GE(history.rows(), rows);
    rows = history.rows();
    ++reads;
  }
  const Outcome outcome = program.wait();
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_GT(reads, 10u);
  const History history = History::load(folder / "run/history.h5");
  EXPECT_GT(history.rows(), 300u);
  EXPECT_TRUE(std::is_sorted(history.time().begin(), history.time().end()));
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
