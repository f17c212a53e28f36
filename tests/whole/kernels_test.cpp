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

/// The largest sway of a column under a load that rises in a moment, m.
double swayed(const Folder& folder, const Kernels& kernels, const std::string& damping) {
  folder.write("column.toml", "[bridge]\ngenerator = \"column\"\nblocks = 5\nkn = 1e9\nks = 1e9\n[damping]\nkind = \"" +
                                  damping +
                                  "\"\n[[stage]]\nkind = \"gravity\"\n[[stage]]\nkind = \"free\"\nduration = 0.2\n"
                                  "load = [{ acceleration = [0.5, 0.0, 0.0] }]\n"
                                  "[[sensor]]\nid = \"top\"\nposition = [0.0, 0.0, 2.0]\ndirection = \"x\"\n");
  const std::string run = damping + "_" + kernels.name;
  const Outcome outcome = voussoir({"run", "column.toml", "-o", run, "--no-pictures", "-q"},
                                   {.folder = folder.path(), .environment = {{"VOUSSOIR_KERNELS", kernels.name}}});
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json found = summary(folder / run);
  EXPECT_EQ(found["provenance"]["kernels"], kernels.instructions);
  return found["sensors"]["top"]["largest"];
}

TEST(Kernels, AgreeToRounding) {
  const std::vector<const Kernels*> all = usable_kernels();
  if (all.size() < 2) GTEST_SKIP() << "built for one processor (VOUSSOIR_NATIVE): nothing to compare";
  const Folder folder;
  constexpr double single = 6e-8;  // 2^-24: Maxwell branches have their memory in single precision
  for (const auto& [damping, share] : {std::pair{"none", 1e-12}, std::pair{"maxwell", single}}) {
    const double first = swayed(folder, *all.front(), damping);
    EXPECT_GT(first, 1e-6);
    for (std::size_t i = 1; i < all.size(); ++i)
      EXPECT_NEAR(swayed(folder, *all[i], damping), first, share * first) << all[i]->name << ", damping " << damping;
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
