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

TEST(Kernels, AgreeToRounding) {
  if (usable_kernels().size() < 2) GTEST_SKIP() << "built for one processor (VOUSSOIR_NATIVE): nothing to compare";
  Folder folder;
  folder.write("column.toml",
               "[bridge]\ngenerator = \"column\"\nblocks = 5\nkn = 1e9\nks = 1e9\n[[stage]]\nkind = \"gravity\"\n"
               "[[stage]]\nkind = \"free\"\nduration = 0.2\nload = [{ acceleration = [0.5, 0.0, 0.0] }]\n"
               "[[sensor]]\nid = \"top\"\nposition = [0.0, 0.0, 2.0]\ndirection = \"x\"\n");
  double first = 0.0;
  for (const Kernels* each : usable_kernels()) {
    const std::string run = std::string("run_") + each->name;
    const Outcome outcome = voussoir({"run", "column.toml", "-o", run, "--no-pictures", "-q"},
                                     {.folder = folder.path(), .environment = {{"VOUSSOIR_KERNELS", each->name}}});
    ASSERT_EQ(outcome.status, 0) << outcome.err;
    const nlohmann::json found = summary(folder / run);
    EXPECT_EQ(found["provenance"]["kernels"], each->instructions);
    const double swayed = found["sensors"]["top"]["largest"];
    if (first == 0.0) first = swayed;
    EXPECT_GT(swayed, 1e-6);
    EXPECT_NEAR(swayed, first, 1e-9 * first) << each->name;
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
