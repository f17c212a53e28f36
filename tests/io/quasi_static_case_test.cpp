// Quasi-static stages in case files.
#include <gtest/gtest.h>

#include "io/case/case.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::Folder;

const std::string arch =
    "[bridge]\ngenerator = \"arch\"\n[[stage]]\nkind = \"gravity\"\n[[stage]]\nkind = \"quasi-static\"\n";
const std::string settles = "drive = [{ group = \"springing left\", displacement = [0, 0, -0.02] }]\n";
const std::string loads = "load = [{ group = \"keystone 0\", force = [0, 0, -1000] }]\n";

TEST(QuasiStaticCase, SurvivesResolving) {
  Folder folder;
  const std::string text = arch + settles + "steps = 7\npath = [0.5, 0.1, 1.0]\nhalvings = 2\nduration = 3\n" +
                           "[[stage]]\nkind = \"quasi-static\"\npush = -0.01\nmethod = \"relaxation\"\n" + loads;
  const Case c = parse_case(text, folder / "case.toml");
  const Case copy = parse_case(resolved_text(c), folder / "case.toml");
  EXPECT_EQ(copy.hash, c.hash);
  for (const Case* one : {&c, &copy}) {
    const StageSettings &first = one->settings.stages.at(1), &second = one->settings.stages.at(2);
    EXPECT_EQ(first.label, "settlement steps");
    EXPECT_EQ(first.quasi_static.steps, 7);
    EXPECT_EQ(first.quasi_static.path, (std::vector<double>{0.5, 0.1, 1.0}));
    EXPECT_EQ(first.quasi_static.halvings, 2);
    EXPECT_EQ(first.duration, 3.0);
    EXPECT_FALSE(first.quasi_static.push);
    EXPECT_EQ(first.drives.at(0).displacement, Vec3(0, 0, -0.02));
    EXPECT_EQ(second.label, "load steps");
    EXPECT_EQ(second.quasi_static.steps, 20);
    EXPECT_EQ(second.quasi_static.push, -0.01);
    EXPECT_EQ(second.method, StageSettings::Method::relaxation);
    EXPECT_EQ(second.duration, 1.0);
  }
}

struct Wrong {
  const char* name;
  std::string text;
  std::vector<std::string> expected;
};

class QuasiStaticErrors : public ::testing::TestWithParam<Wrong> {};

TEST_P(QuasiStaticErrors, NameThePlaceAndTheRemedy) {
  Folder folder;
  try {
    parse_case(GetParam().text, folder / "c.toml");
    FAIL() << "was taken";
  } catch (const InputError& error) {
    for (const std::string& piece : GetParam().expected)
      EXPECT_NE(std::string(error.what()).find(piece), std::string::npos) << piece << " in: " << error.what();
  }
}

INSTANTIATE_TEST_SUITE_P(
    All, QuasiStaticErrors,
    ::testing::Values(
        Wrong{"NothingChanges", arch, {"needs 'load'", "'drive'"}},
        Wrong{"Corners", arch + loads + "path = [0.5, 0.5]\n", {"c.toml:8: 'path'", "from 0.5 to 0.5"}},
        Wrong{"FirstCorner", arch + loads + "path = [0.0, 1.0]\n", {"'path'", "from 0 to 0"}},
        Wrong{"NoCorner", arch + loads + "path = []\n", {"'path'", "is empty"}},
        Wrong{"NoSteps", arch + loads + "steps = 0\n", {"'steps'", "from 1"}},
        Wrong{"PushOfNothing", arch + settles + "push = 0.01\n", {"'push'", "needs a load without speed"}},
        Wrong{"PushOfNoForce",
              arch + "load = [{ group = \"keystone 0\", force = [0, 0, 0] }]\npush = 0.01\n",
              {"'push'", "needs a load without speed"}},
        Wrong{"PushAndDrive", arch + loads + settles + "push = 0.01\n", {"'push'", "both given"}},
        Wrong{"PushNowhere", arch + loads + "push = 0.0\n", {"'push'", "is 0"}},
        Wrong{"PushNotLast", arch + loads + "push = 0.01\n[[stage]]\nkind = \"gravity\"\n", {"'push'", "the last"}},
        Wrong{"Velocity",
              arch + "drive = [{ group = \"springing left\", velocity = [0, 0, -0.02] }]\n",
              {"'velocity'", "'displacement'"}},
        Wrong{"DriveNowhere",
              arch + "drive = [{ group = \"springing left\", displacement = [0, 0, 0] }]\n",
              {"'displacement'", "above 0"}},
        Wrong{"PathOfWhatMoves",
              arch + "load = [{ road = [0, 1, 0, 1], pressure = 1e3, speed = 2 }]\npath = [1, 0]\n",
              {"'path'", "cross the bridge once"}},
        Wrong{"Place", arch + loads + "place = [{ group = \"keystone 0\", move = [0, 0, 1] }]\n", {"'place'"}},
        Wrong{"StepsElsewhere",
              "[bridge]\ngenerator = \"arch\"\n[[stage]]\nkind = \"gravity\"\nsteps = 3\n",
              {"c.toml:5: 'steps'", "quasi-static"}}),
    [](const auto& one) { return std::string(one.param.name); });

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
