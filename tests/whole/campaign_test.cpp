// Campaigns: failures do not stop them, interruptions do not spoil them.
#include <fmt/format.h>
#include <gtest/gtest.h>
#include <signal.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>

#include "tests/whole/campaigns.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

namespace fs = std::filesystem;

/// Of the campaign's runs, those that have ended, with the time when.
std::map<std::string, fs::file_time_type> ended(const std::string& directory) {
  std::map<std::string, fs::file_time_type> found;
  for (const std::string& run : names_in(directory + "/runs"))
    if (const std::string file = directory + "/runs/" + run + "/outcome.json"; exists(file))
      found[run] = fs::last_write_time(file);
  return found;
}

std::size_t occurrences(const std::string& text, const std::string& piece) {
  std::size_t n = 0;
  for (std::size_t at = text.find(piece); at != std::string::npos; at = text.find(piece, at + 1)) ++n;
  return n;
}

/// Each run came to its end once, standing or not, whatever happened on the way.
void expect_nothing_run_twice(const std::string& directory) {
  for (const std::string& run : names_in(directory + "/runs")) {
    const std::string log = bytes_of(directory + "/runs/" + run + "/run.log");
    EXPECT_EQ(occurrences(log, "  done at t = ") + occurrences(log, "  ended at t = "), 1u) << run;
  }
}

Outcome campaign(const Folder& folder, std::vector<std::string> words) {
  words.insert(words.begin(), "campaign");
  return voussoir(words, {.folder = folder.path()});
}

TEST(Campaign, FailuresAreKeptAndTheRestGoesOn) {
  Folder folder;
  write_campaign(folder);
  const std::string out = "out 'of' \"$(touch pwned)\" %j";
  const Outcome outcome = campaign(folder, {"campaign.toml", "-o", out});
  expect_error(outcome, 1, {"8 of 12 runs done", "4 failed", "failed: broken__", "time_step", "--retry-failed"});
  expect_whole_campaign(folder / out);
  EXPECT_FALSE(exists(folder / "pwned"));
  EXPECT_EQ(names_in(folder / (out + "/runs")).size(), 12u);
  // Going on does nothing more; failures are tried again only when asked for.
  const auto before = ended(folder / out);
  EXPECT_EQ(campaign(folder, {"campaign.toml", "-o", out}).status, 1);
  EXPECT_EQ(campaign(folder, {out, "--table"}).status, 0);
  EXPECT_EQ(ended(folder / out), before);
  const Outcome again = campaign(folder, {out, "--retry-failed"});
  expect_error(again, 1, {"4 failed runs are tried again", "4 failed"});
  EXPECT_NE(ended(folder / out), before);
  expect_whole_campaign(folder / out);
  const Outcome status = campaign(folder, {out, "--status"});
  EXPECT_EQ(occurrences(status.out, "failed     broken__"), 4u) << status.out;
}

/// Gravity is found once for all runs of a case, and each ends with the bits of one that finds its own.
TEST(Campaign, PaysGravityOnce) {
  Folder folder;
  write_long_campaign(folder, 3, "[engine]\nkind = \"local\"\nruns_at_once = 3\nthreads = 1\n");
  ASSERT_EQ(campaign(folder, {"long.toml", "-o", "out"}).status, 0);
  const std::string gravity = folder / "out/gravity";
  ASSERT_EQ(names_in(gravity).size(), 1u);
  for (const std::string& run : names_in(folder / "out/runs")) {
    const std::string log = bytes_of(folder / ("out/runs/" + run + "/run.log"));
    EXPECT_NE(log.find("equilibrium under gravity taken from"), std::string::npos) << log;
    EXPECT_EQ(log.find("stage 1: gravity"), std::string::npos) << log;
    // The same case from its beginning.
    const std::string own = "out/runs/" + run;
    ASSERT_EQ(voussoir({"run", own + "/case.toml", "-o", "alone-" + run, "--quiet"}, {.folder = folder.path()}).status,
              0);
    const nlohmann::json shared = summary(folder / own), alone = summary(folder / ("alone-" + run));
    EXPECT_EQ(shared["state_hash"], alone["state_hash"]) << run;
    EXPECT_EQ(shared["demand"], alone["demand"]) << run;
  }
}

TEST(Campaign, ThePlanIsOnlyPrinted) {
  Folder folder;
  write_campaign(folder);
  const Outcome outcome = campaign(folder, {"campaign.toml", "--plan"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("12 runs: 3 cases, 2 records"), std::string::npos) << outcome.out;
  EXPECT_FALSE(exists(folder / "campaign"));
}

/// Interrupts a campaign by `stop` while runs are on their way, goes on and compares with one that was left alone.
void interrupted_by(const std::function<void(Program&, const std::string&)>& stop) {
  Folder folder;
  write_long_campaign(folder, 5);
  ASSERT_EQ(campaign(folder, {"long.toml", "-o", "whole"}).status, 0);
  const std::string parts = fs::canonical(folder.path()).string() + "/parts";
  Program program({"campaign", "long.toml", "-o", parts, "-j", "2"}, {.folder = folder.path()});
  ASSERT_TRUE(wait_until(program, [&] {
    std::size_t busy = 0;
    for (const std::string& run : names_in(parts + "/runs"))
      busy += !exists(parts + "/runs/" + run + "/outcome.json") &&
              names_in(parts + "/runs/" + run + "/checkpoints").size() > 3;
    return busy > 0 && !ended(parts).empty();
  })) << program.so_far().err;
  stop(program, parts);
  program.wait();
  for (int i = 0; i < 500 && !processes_with(parts).empty(); ++i) ::usleep(20000);
  EXPECT_TRUE(processes_with(parts).empty()) << "runs outlive their campaign";
  const auto before = ended(parts);
  ASSERT_LT(before.size(), 5u);
  const Outcome last = campaign(folder, {parts});
  ASSERT_EQ(last.status, 0) << last.err;
  EXPECT_NE(last.err.find("runs have already ended"), std::string::npos) << last.err;
  EXPECT_EQ(table_but_seconds(parts), table_but_seconds(folder / "whole"));
  for (const auto& [run, time] : before) EXPECT_EQ(ended(parts).at(run), time) << run << " was run twice";
  expect_nothing_run_twice(parts);
}

TEST(Campaign, GoesOnAfterItsEndBySigkill) {
  interrupted_by([](Program& program, const std::string&) { program.send(SIGKILL); });
}

TEST(Campaign, GoesOnAfterTheEndOfAllItsProcessesBySigkill) {
  interrupted_by([](Program& program, const std::string& directory) {
    program.send(SIGSTOP);  // it starts no more
    for (const int process : processes_with(directory))
      if (const std::string words = bytes_of(fmt::format("/proc/{}/cmdline", process));
          words.find("campaign-run") != std::string::npos)
        ::kill(process, SIGKILL);
    program.send(SIGKILL);
  });
}

TEST(Campaign, GoesOnAfterSigterm) {
  interrupted_by([](Program& program, const std::string& directory) {
    program.send(SIGTERM);
    expect_error(program.wait(), 1,
                 {"have written their checkpoints", "Continue with: voussoir campaign " + directory});
    EXPECT_TRUE(exists(directory + "/table.csv"));
  });
}

/// A run whose process is killed, as by the system when memory runs out, is no failure: the rest goes on, and so does
/// it with the next start.
TEST(Campaign, AKilledRunDoesNotStopTheOthers) {
  Folder folder;
  write_long_campaign(folder, 4);
  const std::string out = fs::canonical(folder.path()).string() + "/out";
  Program program({"campaign", "long.toml", "-o", out, "-j", "2"}, {.folder = folder.path()});
  ASSERT_TRUE(wait_until(program, [&] { return names_in(out + "/runs/wall__r1__x1/checkpoints").size() > 2; }));
  const std::vector<int> ours = processes_with(out);  // other tests have runs of that name, too
  for (const int process : processes_with("wall__r1__x1"))
    if (std::ranges::find(ours, process) != ours.end()) ::kill(process, SIGKILL);
  expect_error(program.wait(), 1,
               {"wall__r1__x1 has not ended: the system killed it", "3 of 4 runs done", "1 run has not"});
  EXPECT_EQ(table_of(out).at("wall__r1__x1").at("status"), "missing");
  EXPECT_EQ(campaign(folder, {out}).status, 0);
  EXPECT_EQ(table_of(out).at("wall__r1__x1").at("status"), "done");
  expect_nothing_run_twice(out);
}

TEST(Campaign, GrowsByRunsAndRefusesOthers) {
  Folder folder;
  const std::string file = write_long_campaign(folder, 2);
  ASSERT_EQ(campaign(folder, {"long.toml"}).status, 0);
  const auto before = ended(folder / "long");
  write_long_campaign(folder, 3);
  const Outcome more = campaign(folder, {"long.toml"});
  ASSERT_EQ(more.status, 0) << more.err;
  EXPECT_EQ(table_of(folder / "long").size(), 3u);
  for (const auto& [run, time] : before) EXPECT_EQ(ended(folder / "long").at(run), time);
  folder.write("long.toml", exchanged(bytes_of(file), "amplitude = 3", "amplitude = 3.5"));
  const auto all = contents(folder / "long");
  expect_error(campaign(folder, {"long.toml"}), 2,
               {"wall__r1__x1, but its case, record, sample or duration has changed", "-o DIR"});
  expect_unchanged(folder / "long", all);
}

TEST(Campaign, ATimeLimitEndsARunAndARetryGoesOn) {
  Folder folder;
  write_wall(folder, {.length = 20, .courses = 15, .shaken = 1.0, .checkpoints = 0.05});
  const auto write = [&](int limit) {
    folder.write("c.toml", fmt::format("[campaign]\ncases = [\"wall.toml\"]\nduration = 6.0\n[[record]]\nname = \"r\"\n"
                                       "synthetic = {{ seed = 1, peak = 6.0, duration = 6.0 }}\n[engine]\ntime_limit = "
                                       "{}\nthreads = 1\n",
                                       limit));
  };
  write(1);
  const Outcome late = campaign(folder, {"c.toml"});
  expect_error(late, 1, {"1 failed", "the time limit was reached at t = ", "(limit 1 s)"});
  write(600);
  const Outcome more = campaign(folder, {"c.toml", "--retry-failed"});
  EXPECT_EQ(more.status, 0) << more.err;
  EXPECT_NE(bytes_of(folder / "c/runs/wall__r__x1/run.log").find("resuming at t = "), std::string::npos);
}

TEST(Campaign, WhatIsWrongIsSaid) {
  Folder folder;
  write_long_campaign(folder, 1);
  fs::create_directory(folder / "empty");
  expect_error(campaign(folder, {"nowhere.toml"}), 2, {"nowhere.toml"});
  expect_error(campaign(folder, {"wall.toml"}), 2, {"wall.toml is a case, not a campaign", "voussoir run"});
  expect_error(campaign(folder, {"empty"}), 2, {"empty is a folder that holds no campaign"});
  expect_error(campaign(folder, {"long.toml", "--engine", "slurn"}), 2, {"'slurn'", "did you mean 'slurm'?"});
  expect_error(campaign(folder, {"long.toml", "--no-wait"}), 2, {"--no-wait works only with Slurm"});
  const Outcome absent = voussoir({"campaign", "long.toml", "--engine", "slurm"},
                                  {.folder = folder.path(), .environment = {{"PATH", "/nowhere"}}});
  expect_error(absent, 2, {"the command sbatch was not found", "--engine local"});
  const Outcome good = campaign(folder, {"long.toml"});
  EXPECT_EQ(good.status, 0) << "nothing of that is in the way\n" << good.err;
  folder.write("long/campaign.json", "{");
  expect_error(campaign(folder, {"long"}), 2, {"campaign.json is not valid JSON"});
}

/// The example that comes with the program, as far as its plan.
TEST(Campaign, TheExampleIsAPlan) {
  const Outcome outcome =
      voussoir({"campaign", std::string(VOUSSOIR_SOURCE_DIR) + "/cases/campaigns/walls.toml", "--plan"});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("24 runs"), std::string::npos) << outcome.out;
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
