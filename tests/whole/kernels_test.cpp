// One program for every processor: which kernels are at work, and whether it matters.
#include "solver/model/kernels.h"

#include <gtest/gtest.h>

#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

TEST(Kernels, AreChosenByTheEnvironment) {
  for (const Kernels* each : usable_kernels()) {
    const Outcome outcome = voussoir({"--version"}, {.environment = {{"VOUSSOIR_KERNELS", each->name}}});
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    EXPECT_NE(outcome.out.find(std::string("kernels for ") + each->instructions), std::string::npos) << outcome.out;
  }
  const Outcome usual = voussoir({"--version"});
  EXPECT_NE(usual.out.find(std::string("kernels for ") + usable_kernels().back()->instructions), std::string::npos)
      << "the widest that the processor has";
}

TEST(Kernels, AWishThatCannotBeMetIsRefused) {
  expect_error(voussoir({"run", "case.toml"}, {.environment = {{"VOUSSOIR_KERNELS", "altivec"}}}), 2,
               {"VOUSSOIR_KERNELS is \"altivec\"", usable_kernels().front()->name});
}

TEST(Kernels, AllGiveTheSameBits) {
  Folder folder;
  write_wall(folder);
  std::string first;
  for (const Kernels* each : usable_kernels()) {
    const std::string run = std::string("run_") + each->name;
    const Outcome outcome = voussoir({"run", "wall.toml", "-o", run, "--no-pictures", "-q"},
                                     {.folder = folder.path(), .environment = {{"VOUSSOIR_KERNELS", each->name}}});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const nlohmann::json found = summary(folder / run);
    EXPECT_EQ(found["provenance"]["kernels"], each->instructions);
    if (first.empty()) first = found["state_hash"];
    EXPECT_EQ(found["state_hash"], first) << each->name;
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
