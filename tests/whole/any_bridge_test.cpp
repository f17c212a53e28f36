// Bridges of the generator "bridge", through the program: built in stages they come to rest, with blocks and with a
// continuum between the walls; effects, modes and hidden truths reach them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/base/json_file.h"
#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

std::string two_spans(const std::string& first, const std::string& second, const std::string& keys) {
  return fmt::format(
      "[bridge]\ngenerator = \"bridge\"\nblock_scale = 2.5\nfill_edge = 1.5\nwidth = 5.0\nbacking_height = 1.5\n{}"
      "[[bridge.span]]\nshape = \"{}\"\nclear_span = 7.0\nring_thickness = 0.6\nrings = 2\n"
      "[[bridge.span]]\nshape = \"{}\"\nclear_span = 5.0\nspringing_right = 0.4\n[[bridge.pier]]\nthickness = 2.0\n"
      "batter_x = 0.02\n[[stage]]\nkind = \"gravity\"\nconstruction = \"staged\"\n[output]\ngravity_modes = 0\n",
      keys, first, second);
}

TEST(AnyBridge, ComesToRestBuiltInStages) {
  Folder folder;
  for (const auto& [first, second, keys] : {std::tuple("segmental", "semicircular", ""),
                                            {"elliptical", "pointed", "abutments = \"restrained\"\n"},
                                            {"three-centred", "parabolic", "backfill = \"deformable\"\n"}}) {
    folder.write("case.toml", two_spans(first, second, keys));
    const Outcome run =
        voussoir({"run", "case.toml", "-o", "run", "--no-pictures", "--overwrite"}, {.folder = folder.path()});
    ASSERT_EQ(run.status, 0) << run.err;
    const nlohmann::json all = summary(folder / "run");
    EXPECT_LT(all["equilibrium"]["out_of_balance"].get<double>(), 1e-6) << first;
  }
}

TEST(AnyBridge, IsReachedByEffectsModesAndHiddenTruths) {
  Folder folder;
  folder.write("case.toml",
               two_spans("segmental", "segmental", "") + "[[effect]]\nname = \"scour\"\nwhere = \"pier 0 x+\"\n");
  const Outcome modes = voussoir({"modal", "case.toml", "-n", "4", "--no-pictures"}, {.folder = folder.path()});
  ASSERT_EQ(modes.status, 0) << (modes.out + modes.err);
  EXPECT_NE((modes.out + modes.err).find("transverse, 1st order"), std::string::npos) << (modes.out + modes.err);
  folder.write("case.toml", two_spans("segmental", "segmental", ""));
  const Outcome hidden =
      voussoir({"hide", "case.toml", "-o", "hidden", "--truth", "span.1.rise=2.0"}, {.folder = folder.path()});
  EXPECT_EQ(hidden.status, 0) << hidden.err;
  expect_error(voussoir({"hide", "case.toml", "-o", "other", "--truth", "span.1.rse=2.0"}, {.folder = folder.path()}),
               2, {"span.1.rse", "did you mean 'span.1.rise'?"});
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
