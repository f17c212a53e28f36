// What is said while the program works.
#include <gtest/gtest.h>
#include <signal.h>

#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

TEST(Progress, SomethingIsSaidWithinASecond) {
  Folder folder;
  Program program({"run", std::string(VOUSSOIR_SOURCE_DIR) + "/cases/cs1-f.toml", "-o", "run", "--no-pictures"},
                  {.folder = folder.path()});
  const double seconds = program.first_output();
  program.send(SIGKILL);
  EXPECT_GE(seconds, 0.0);
  EXPECT_LT(seconds, 2.0) << "1 s on a free machine; this one may be busy";
}

TEST(Progress, LinesTellStageTimeAndShare) {
  Folder folder;
  write_wall(folder);
  const Outcome outcome = voussoir({"run", "wall.toml", "--no-pictures"}, {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_EQ(outcome.out, "") << "results go to files, talk to standard error";
  for (const char* piece : {"stage 1: gravity", "of 0.60 s", "100 %", "stage 3: free vibration", "done at t = 0.6"})
    EXPECT_NE(outcome.err.find(piece), std::string::npos) << piece << " in\n" << outcome.err;
  EXPECT_EQ(outcome.err.find('\r'), std::string::npos) << "a line that is overwritten is for terminals";
  for (std::size_t at = outcome.err.find(" %"); at != std::string::npos; at = outcome.err.find(" %", at + 1))
    EXPECT_NE(outcome.err.substr(at - 3, 3), "101") << outcome.err;
}

TEST(Progress, NoTimeWhereNoStageHasTime) {
  Folder folder;
  folder.write("arch.toml", "[bridge]\ngenerator = \"arch\"\n[[stage]]\nkind = \"gravity\"\n");
  const Outcome outcome = voussoir({"run", "arch.toml", "--no-pictures"}, {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(outcome.err.find("of 0.00 s"), std::string::npos) << outcome.err;
}

TEST(Progress, LinesKeepComing) {
  Folder folder;
  write_wall(folder, {.shaken = 2000.0, .checkpoints = 1000.0, .fields = 0.0});
  Program program({"run", "wall.toml", "-o", "run", "--no-pictures"}, {.folder = folder.path()});
  const auto lines = [&] {
    std::size_t count = 0;
    for (std::size_t at = program.so_far().err.find(" s left"); at != std::string::npos;
         at = program.so_far().err.find(" s left", at + 1))
      ++count;
    return count;
  };
  EXPECT_TRUE(wait_until(
      program, [&] { return program.so_far().err.find("  2 %") != std::string::npos || lines() >= 2; }, 40.0))
      << program.so_far().err;
  program.send(SIGINT);
  EXPECT_EQ(program.wait(20.0).status, 1);
}

TEST(Progress, QuietSaysNothing) {
  Folder folder;
  write_wall(folder);
  const Surroundings there{.folder = folder.path()};
  for (const std::vector<std::string>& words :
       {std::vector<std::string>{"run", "wall.toml", "-o", "run", "--until", "0.3"},
        {"resume", "run"},
        {"generate", "wall.toml"},
        {"render", "run", "--width", "300", "--height", "200"}}) {
    std::vector<std::string> quiet = words;
    quiet.push_back("--quiet");
    const Outcome outcome = voussoir(quiet, there);
    EXPECT_EQ(outcome.status, 0) << words[0];
    EXPECT_EQ(outcome.out + outcome.err, "") << words[0];
  }
  EXPECT_NE(bytes_of(folder / "run/run.log").find("done at"), std::string::npos) << "the log is kept all the same";
  // Errors are said even so.
  expect_error(voussoir({"run", "wall.toml", "-o", "run", "-q"}, there), 2, {"already holds a run"});
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
