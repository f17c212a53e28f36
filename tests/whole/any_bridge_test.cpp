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
                                            {"three-centred", "parabolic", "backfill = \"deformable\"\n"},
                                            {"segmental", "pointed",
                                             "backfill = \"deformable\"\nspandrel_back = \"tapered\"\n"
                                             "spandrel_thickness_bottom = 0.9\nsurfacing_depth = 0.2\n"}}) {
    folder.write("case.toml", two_spans(first, second, keys));
    const Outcome run =
        voussoir({"run", "case.toml", "-o", "run", "--no-pictures", "--overwrite"}, {.folder = folder.path()});
    ASSERT_EQ(run.status, 0) << run.err;
    const nlohmann::json all = summary(folder / "run");
    EXPECT_LT(all["equilibrium"]["out_of_balance"].get<double>(), 1e-6) << first;
  }
}

/// What an engineer would say of an ordinary bridge.
const char* details = R"(
[bridge]
generator = "bridge"
skew = 18
skew_bond = "helicoidal"
gradient = -2
width = 5.0
block_scale = 2.0
fill_edge = 1.0
fill_over_crown = 0.4
backfill = "deformable"
string_course_height = 0.25
transverse_walls = 0.6
[bridge.backing]
profile = [[0, 2.0], [3.0, 1.2], [7.5, 1.0], [12.8, 1.6], [16.6, 1.0], [23.6, 1.6]]
[[bridge.span]]
shape = "segmental"
clear_span = 9.0
rise = 2.2
ring_thickness = 0.34
rings = 3
headers_every = 4
[[bridge.span]]
shape = "segmental"
clear_span = 6.0
rise = 1.6
ring_thickness = 0.34
rings = 3
springing_right = 0.3
[[bridge.pier]]
thickness = 1.6
height = 3.5
batter_x = 0.03
cutwater = "triangular"
cutwater_height = 2.5
[bridge.abutment.left]
length = 3.0
height = 2.5
wing_length = 4
wing_splay = 30
wing_height = 4
[bridge.abutment.right]
counterforts = 2
[joints.ring-ring]
tensile_strength = 0
cohesion = 0
[[effect]]
name = "ring_separation"
where = "arch 0"
[[stage]]
kind = "gravity"
construction = "staged"
[output]
gravity_modes = 0
)";

TEST(AnyBridge, WithAllItsDetailsComesToRest) {
  Folder folder;
  folder.write("case.toml", details);
  const Outcome run = voussoir({"run", "case.toml", "-o", "run", "--no-pictures"}, {.folder = folder.path()});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_LT(summary(folder / "run")["equilibrium"]["out_of_balance"].get<double>(), 1e-6);
  const std::string without = std::string(details).replace(std::string(details).find("rings = 3"), 9, "rings = 1");
  folder.write("case.toml", without);
  expect_error(voussoir({"generate", "case.toml", "-o", "a.h5"}, {.folder = folder.path()}), 2,
               {"ring_separation", "arch 0", "arch 1"});
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
