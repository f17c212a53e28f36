// A disk that is full, shown by a limit on the size of files: said plainly, and nothing that was written is lost.
#include <gtest/gtest.h>

#include <filesystem>

#include "io/hdf5/checkpoint_file.h"
#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Shares of the run's largest file, from "nothing fits" to "all but the last checkpoints fit".
class FullDisk : public testing::TestWithParam<double> {};

TEST_P(FullDisk, IsSaidAndNothingIsLost) {
  Folder folder;
  write_wall(folder, {.checkpoints = 0.05, .fields = 0.1});
  run_whole(folder, "wall.toml", "whole");
  std::size_t largest = 0;
  for (const auto& [name, bytes] : contents(folder / "whole")) largest = std::max(largest, bytes.size());
  const Outcome outcome = voussoir({"run", "wall.toml", "-o", "run", "--no-pictures"},
                                   {.folder = folder.path(), .file_size = long(GetParam() * double(largest))});
  expect_error(outcome, 1, {"cannot write run/", "ulimit"});
  for (const auto& [name, bytes] : contents(folder / "run")) EXPECT_FALSE(name.ends_with(".partial")) << name;
  for (const std::string& name : names_in(folder / "run/checkpoints"))
    EXPECT_NO_THROW(read_checkpoint_header(folder / "run/checkpoints/" + name)) << name;
  // With room again it goes on, or begins where nothing had been begun.
  if (exists(folder / "run/checkpoints")) {
    EXPECT_NE(outcome.err.find("voussoir resume run"), std::string::npos) << outcome.err;
    const Outcome more = voussoir({"resume", "run", "--no-pictures"}, {.folder = folder.path()});
    ASSERT_EQ(more.status, 0) << more.err;
  } else {
    run_whole(folder, "wall.toml", "run");
  }
  expect_same_run(folder / "whole", folder / "run");
}

INSTANTIATE_TEST_SUITE_P(Shares, FullDisk, testing::Values(0.0, 0.005, 0.1, 0.3, 0.32, 0.5, 0.8, 0.97));

TEST(FullDiskElsewhere, OtherVerbsSayItToo) {
  Folder folder;
  write_wall(folder);
  run_whole(folder, "wall.toml", "run");
  const auto before = contents(folder.path());
  const Surroundings full{.folder = folder.path(), .file_size = 2000};
  expect_error(voussoir({"generate", "wall.toml", "-o", "w.h5"}, full), 1, {"cannot write w.h5"});
  expect_error(voussoir({"generate", "wall.toml", "-o", "run/assembly.h5"}, full), 1, {"run/assembly.h5"});
  expect_unchanged(folder.path(), before);
}

TEST(FullDiskElsewhere, PicturesThatCannotBeWrittenDoNotSpoilARun) {
  Folder folder;
  write_wall(folder);
  run_whole(folder, "wall.toml", "run", {"--until", "0.6"});
  std::filesystem::remove_all(folder / "run/images");
  folder.write("run/images", "a file where the folder should be");
  const Outcome outcome = voussoir({"resume", "run"}, {.folder = folder.path()});
  EXPECT_EQ(outcome.status, 0);
  EXPECT_NE(outcome.err.find("no pictures were drawn: "), std::string::npos) << outcome.err;
  EXPECT_NE(outcome.err.find("images"), std::string::npos) << outcome.err;
  EXPECT_EQ(outcome.err.find("fault of the program"), std::string::npos) << outcome.err;
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
