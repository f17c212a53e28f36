// A run that was stopped, in whatever way, and gone on with equals one that never was.
#include <fcntl.h>
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <sys/file.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <random>

#include "tests/solver/measured.h"
#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Long enough to be stopped in the middle, with contacts that appear and frames, checkpoints and rows all along.
const Wall shaken{.shaken = 2.0, .checkpoints = 0.05, .fields = 0.1};

std::vector<std::string> regular_checkpoints(const std::string& run) {
  std::vector<std::string> names;
  for (const std::string& name : names_in(run + "/checkpoints"))
    if (name.ends_with(".h5") && !name.starts_with("stage_")) names.push_back(name);
  return names;
}

Outcome resume(const Folder& folder, const std::string& run, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words = {"resume", run, "--no-pictures"};
  words.insert(words.end(), more.begin(), more.end());
  return voussoir(words, {.folder = folder.path()});
}

TEST(Resume, UntilAndOnEqualsOneRun) {
  Folder folder;
  write_wall(folder, {.shaken = 1.0});
  run_whole(folder, "wall.toml", "whole");
  run_whole(folder, "wall.toml", "parts", {"--until", "0"});
  const nlohmann::json paused = summary(folder / "parts");
  EXPECT_FALSE(paused.at("finished").get<bool>());
  EXPECT_EQ(paused.at("end_time").get<double>(), 0.0);
  for (const char* until : {"0.1234", "0.5", "1.0", "1.05"}) {
    const Outcome outcome = resume(folder, "parts", {"--until", until});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NEAR(summary(folder / "parts").at("end_time").get<double>(), std::stod(until), 3e-4);
  }
  ASSERT_EQ(resume(folder, "parts").status, 0);
  expect_same_run(folder / "whole", folder / "parts");
}

/// Two programs in one folder would write over each other.
TEST(Resume, NotWhileAnotherHoldsTheFolder) {
  Folder folder;
  write_wall(folder);
  run_whole(folder, "wall.toml", "run", {"--until", "0.2"});
  const int held = open((folder / "run").c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
  ASSERT_EQ(flock(held, LOCK_EX), 0);
  const auto info = [&] { return voussoir({"info", "run"}, {.folder = folder.path()}).out; };
  EXPECT_NE(info().find("voussoir resume run"), std::string::npos) << info();
  const auto before = contents(folder / "run");
  expect_error(resume(folder, "run"), 2, {"run is in use by another voussoir"});
  expect_error(voussoir({"run", "wall.toml", "-o", "run", "--overwrite"}, {.folder = folder.path()}), 2, {"in use"});
  EXPECT_EQ(contents(folder / "run"), before);
  close(held);
  EXPECT_EQ(resume(folder, "run").status, 0);
  EXPECT_NE(info().find("the run has ended"), std::string::npos) << info();
}

TEST(Resume, AFinishedRunStaysAsItIs) {
  Folder folder;
  write_wall(folder);
  run_whole(folder, "wall.toml", "run");
  std::filesystem::copy(folder / "run", folder / "copy", std::filesystem::copy_options::recursive);
  ASSERT_EQ(resume(folder, "run").status, 0);
  expect_same_run(folder / "copy", folder / "run");
  ASSERT_EQ(resume(folder, "run", {"--until", "0.3"}).status, 0);  // a time that has passed
  expect_same_run(folder / "copy", folder / "run");
}

/// Stops a run by `signal` in the middle; another thread count goes on.
void stop_and_go_on(int signal) {
  Folder folder;
  write_wall(folder, shaken);
  run_whole(folder, "wall.toml", "whole");
  Program program({"run", "wall.toml", "-o", "parts", "--no-pictures", "-j", "1"}, {.folder = folder.path()});
  ASSERT_TRUE(wait_until(program, [&] { return regular_checkpoints(folder / "parts").size() >= 3; }));
  program.send(signal);
  const Outcome outcome = program.wait(20.0);
  expect_error(outcome, 1, {"stopped at t = ", "voussoir resume parts"});
  EXPECT_FALSE(exists(folder / "parts/summary.json"));
  const Outcome more = resume(folder, "parts", {"-j", "3"});
  ASSERT_EQ(more.status, 0) << more.err;
  EXPECT_NE(more.err.find("resuming at t = "), std::string::npos) << more.err;
  expect_same_run(folder / "whole", folder / "parts");
}

TEST(Resume, CtrlCWritesACheckpointAndLeaves) {
  stop_and_go_on(SIGINT);
}
TEST(Resume, SigtermWritesACheckpointAndLeaves) {
  stop_and_go_on(SIGTERM);
}

TEST(Resume, StoppedWhileItLooksForEquilibrium) {
  Folder folder;
  const Wall wall{.length = 30, .courses = 30, .amplitude = 1.0, .shaken = 0.02, .free = 0.01};
  folder.write("wall.toml", exchanged(case_text(wall), "\"gravity\"", "\"gravity\"\nmethod = \"relaxation\""));
  Program program({"run", "wall.toml", "-o", "run", "--no-pictures"}, {.folder = folder.path()});
  ASSERT_TRUE(wait_until(program, [&] { return program.so_far().err.find("stage 1: gravity") != std::string::npos; }))
      << program.so_far().err;
  program.send(SIGTERM);
  expect_error(program.wait(20.0), 1, {"stopped at t = 0.0000 s", "voussoir resume run"});
  const Outcome outcome = resume(folder, "run");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  run_whole(folder, "wall.toml", "whole");
  expect_same_run(folder / "whole", folder / "run");
}

TEST(Resume, AnInterruptLosesNoStep) {
  Folder folder;
  // One checkpoint in the far future: what the signal writes is all there is after gravity.
  write_wall(folder, {.shaken = 3.0, .checkpoints = 1000.0, .fields = 0.1});
  Program program({"run", "wall.toml", "-o", "run", "--no-pictures"}, {.folder = folder.path()});
  ASSERT_TRUE(wait_until(program, [&] { return names_in(folder / "run/vtk").size() > 8; }));
  program.send(SIGTERM);
  ASSERT_EQ(program.wait(20.0).status, 1);
  const auto names = regular_checkpoints(folder / "run");
  ASSERT_FALSE(names.empty());
  EXPECT_GT(std::stod(names.back()), 0.1) << names.back();
}

/// Starts or goes on with the run `parts` and kills it after so many seconds; whether it was still at work.
bool killed_after(const Folder& folder, const std::string& parts, double seconds) {
  const std::vector<std::string> words =
      exists(folder / (parts + "/case.toml"))
          ? std::vector<std::string>{"resume", parts, "--no-pictures", "-q"}
          : std::vector<std::string>{"run", "wall.toml", "-o", parts, "--no-pictures", "-q"};
  Program program(words, {.folder = folder.path()});
  ::usleep(useconds_t(1e6 * seconds));
  program.send(SIGKILL);
  const Outcome outcome = program.wait();
  EXPECT_TRUE(outcome.signal == SIGKILL || outcome.status == 0) << outcome.status << " " << outcome.err;
  return outcome.signal == SIGKILL;
}

/// Six kills a run; VOUSSOIR_KILLED_RUNS (1) says in how many runs.
TEST(Resume, AfterKillAtAnyMoment) {
  Folder folder;
  write_wall(folder, shaken);
  run_whole(folder, "wall.toml", "whole");
  const double whole = summary(folder / "whole").at("wall_seconds").get<double>();
  const unsigned seed = std::random_device()();
  SCOPED_TRACE("seed " + std::to_string(seed));
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> moment(0.0, 0.7 * whole);
  const char* asked = std::getenv("VOUSSOIR_KILLED_RUNS");
  const int runs = asked ? std::atoi(asked) : 1;
  int kills = 0;
  for (int run = 0; run < runs; ++run) {
    const std::string parts = "parts" + std::to_string(run);
    for (int attempt = 0; attempt < 6; ++attempt) kills += killed_after(folder, parts, moment(random));
    if (!exists(folder / (parts + "/case.toml"))) run_whole(folder, "wall.toml", parts);
    const Outcome last = resume(folder, parts, {"-j", "2"});
    ASSERT_EQ(last.status, 0) << last.err;
    expect_same_run(folder / "whole", folder / parts);
  }
  EXPECT_GT(kills, 0);
  measured("Runs killed and gone on with that equal one never stopped", runs, HasFailure() ? 0.0 : runs,
           fmt::format("runs, {} kills", kills));
}

TEST(Resume, ARunKilledBeforeItsFirstCheckpointStartsFromTheBeginning) {
  Folder folder;
  write_wall(folder);
  run_whole(folder, "wall.toml", "whole");
  std::filesystem::create_directory(folder / "parts");
  for (const char* name : {"case.toml", "assembly.h5"})
    std::filesystem::copy(folder / "whole/" + name, folder / "parts/" + name);
  const Outcome outcome = resume(folder, "parts");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("from the beginning"), std::string::npos) << outcome.err;
  expect_same_run(folder / "whole", folder / "parts");
}

/// A run stopped at 0.45 s whose newest checkpoint is altered by `damage`; the one before is used, and nothing shows.
void with_damaged_newest(const std::function<void(std::string&)>& damage) {
  Folder folder;
  write_wall(folder);
  run_whole(folder, "wall.toml", "whole");
  run_whole(folder, "wall.toml", "parts", {"--until", "0.45"});
  const std::string newest = "parts/checkpoints/" + regular_checkpoints(folder / "parts").back();
  std::string bytes = bytes_of(folder / newest);
  damage(bytes);
  set_bytes(folder / newest, bytes);
  const Outcome outcome = resume(folder, "parts");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.err.find(newest), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("damaged"), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("resuming at t = 0.4"), std::string::npos) << outcome.err;
  expect_same_run(folder / "whole", folder / "parts");
}

TEST(Resume, ABitFlippedInTheNewestCheckpoint) {
  with_damaged_newest([](std::string& bytes) { bytes[bytes.size() / 2] ^= 8; });
}
TEST(Resume, TheNewestCheckpointCutOff) {
  with_damaged_newest([](std::string& bytes) { bytes.resize(bytes.size() * 2 / 3); });
}
TEST(Resume, TheNewestCheckpointEmpty) {
  with_damaged_newest([](std::string& bytes) { bytes.clear(); });
}

TEST(Resume, AllCheckpointsDamagedIsSaid) {
  Folder folder;
  write_wall(folder);
  run_whole(folder, "wall.toml", "run");
  for (const std::string& name : names_in(folder / "run/checkpoints"))
    set_bytes(folder / "run/checkpoints/" + name, "?");
  const auto before = bytes_of(folder / "run/history.h5");
  expect_error(resume(folder, "run"), 2, {"none of the 6 checkpoints in run/checkpoints", "stage_03_00000.600.h5"});
  EXPECT_EQ(bytes_of(folder / "run/history.h5"), before);
}

TEST(Resume, AnotherCaseIsRefused) {
  Folder folder;
  write_wall(folder);
  run_whole(folder, "wall.toml", "run", {"--until", "0.3"});
  const std::string text = bytes_of(folder / "run/case.toml");
  const auto history = bytes_of(folder / "run/history.h5");
  set_bytes(folder / "run/case.toml", exchanged(text, "amplitude = 9.0", "amplitude = 9.1"));
  expect_error(resume(folder, "run"), 2, {"another case", "run/case.toml"});
  EXPECT_EQ(bytes_of(folder / "run/history.h5"), history) << "a refused resume changed the run";
  set_bytes(folder / "run/case.toml", text + "\n# a remark changes nothing\n");
  EXPECT_EQ(resume(folder, "run").status, 0);
}

TEST(Resume, AnotherAssemblyIsRefused) {
  Folder folder;
  write_wall(folder);
  run_whole(folder, "wall.toml", "run", {"--until", "0.3"});
  for (const Wall& other : {Wall{.length = 5}, Wall{.extra = "[materials.masonry]\ndensity = 2001.0\n"}}) {
    write_wall(folder, other, "other.toml");
    ASSERT_EQ(voussoir({"generate", "other.toml", "-o", "run/assembly.h5"}, {.folder = folder.path()}).status, 0);
    expect_error(resume(folder, "run"), 2, {"another assembly", "run/assembly.h5"});
  }
  ASSERT_EQ(voussoir({"generate", "wall.toml", "-o", "run/assembly.h5"}, {.folder = folder.path()}).status, 0);
  EXPECT_EQ(resume(folder, "run").status, 0);
}

TEST(Resume, WhatIsNoRunDirectoryIsSaid) {
  Folder folder;
  write_wall(folder);
  expect_error(resume(folder, "nowhere"), 2, {"nowhere"});
  expect_error(resume(folder, "wall.toml"), 2, {"wall.toml"});
  expect_error(resume(folder, "."), 2, {"not a run directory"});
  std::filesystem::copy(folder / "wall.toml", folder / "case.toml");  // a folder with a case only
  expect_error(resume(folder, "."), 2, {"assembly.h5"});
}

TEST(Threads, OneBitPatternForAnyNumber) {
  Folder folder;
  // 4000 joints and more: eight threads find work. Hard shaking, so that they find different work.
  write_wall(folder, {.length = 38, .courses = 38, .amplitude = 40.0, .frequency = 25.0, .shaken = 0.04, .free = 0.01});
  std::vector<std::string> runs;
  for (const int threads : {1, 2, 3, 8}) {
    runs.push_back("run" + std::to_string(threads));
    run_whole(folder, "wall.toml", runs.back(), {"-j", std::to_string(threads)});
    EXPECT_EQ(summary(folder / runs.back()).at("threads").get<int>(), threads);
    expect_same_run(folder / runs[0], folder / runs.back());
  }
  EXPECT_GT(summary(folder / runs[0]).at("damage").at("wall").at("largest_slip").get<double>(), 1e-5);
  // Stopped under two threads, gone on with under three.
  run_whole(folder, "wall.toml", "parts", {"-j", "2", "--until", "0.02"});
  ASSERT_EQ(resume(folder, "parts", {"-j", "3"}).status, 0);
  expect_same_run(folder / runs[0], folder / "parts");
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
