// Effects of a case: read, resolved, applied once.
#include <gtest/gtest.h>

#include <cmath>

#include "io/case/case.h"
#include "io/hdf5/assembly_file.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::Folder;

const std::string plain = "[bridge]\ngenerator = \"cs2\"\nblock_scale = 4.0\n";
const std::string softer =
    "[[effect]]\nname = \"joint_softening\"\nwhere = \"pier 0\"\nfactor = 0.25\n"
    "[[effect]]\nname = \"damping\"\nratio = 0.05\n";

TEST(EffectCase, SurvivesResolvingAndCounts) {
  const Case c = parse_case(plain + softer, "c.toml", CaseUse::geometry);
  EXPECT_NE(c.hash, parse_case(plain, "c.toml", CaseUse::geometry).hash);
  const Case copy = parse_case(resolved_text(c), "c.toml", CaseUse::geometry);
  EXPECT_EQ(copy.hash, c.hash);
  for (const Case* one : {&c, &copy}) {
    ASSERT_EQ(one->effects.size(), 2u);
    EXPECT_EQ(one->effects[0].text(), "joint_softening pier 0 factor=0.25");
    EXPECT_EQ(one->settings.damping.ratio, 0.05);
  }
  const Assembly before = make_assembly(parse_case(plain, "c.toml", CaseUse::geometry)), after = make_assembly(c);
  ASSERT_EQ(after.joints.size(), before.joints.size());
  std::int64_t softened = 0;
  for (std::size_t i = 0; i < after.joints.size(); ++i) {
    if (after.joints[i].kn == before.joints[i].kn) continue;
    EXPECT_EQ(after.joints[i].kn, 0.25 * before.joints[i].kn);
    ++softened;
  }
  EXPECT_GT(softened, 3);
}

/// An assembly file that has been changed already, as in a run directory, is not changed again.
TEST(EffectCase, IsAppliedOnce) {
  const Folder folder;
  const Assembly once = make_assembly(parse_case(plain + softer, "c.toml", CaseUse::geometry));
  write_assembly(folder / "once.h5", once);
  EXPECT_EQ(read_assembly(folder / "once.h5").effects, once.effects);
  const std::string from_file = "[bridge]\nassembly = \"" + folder / "once.h5" + "\"\n";
  const Assembly again = make_assembly(parse_case(from_file + softer, folder / "c.toml", CaseUse::geometry));
  EXPECT_EQ(assembly_hash(again), assembly_hash(once));
  const Assembly twice = make_assembly(parse_case(from_file + softer + softer, folder / "c.toml", CaseUse::geometry));
  EXPECT_NE(assembly_hash(twice), assembly_hash(once)) << "asked for twice, it acts twice";
}

/// A reversed channel, and two of one place that were swapped.
TEST(EffectCase, FaultsOfSensorsActOnTheSensors) {
  const std::string sensors =
      "[[sensor]]\nid = \"a\"\nposition = [0.2, 0.2, 0.2]\ndirection = [1.0, 0.0, 0.0]\n"
      "[[sensor]]\nid = \"b\"\nposition = [0.2, 0.2, 0.2]\ndirection = [0.0, 1.0, 0.0]\n";
  const std::string wall = "[bridge]\ngenerator = \"wall\"\n" + sensors;
  const auto fault = [&](const std::string& where) {
    return make_assembly(
        parse_case(wall + "[[effect]]\nname = \"sensor_fault\"\nwhere = \"" + where + "\"\ngain = -1.0\n", "c.toml",
                   CaseUse::geometry));
  };
  EXPECT_EQ(fault("channel b").sensors[1].direction, -Vec3::UnitY());
  EXPECT_EQ(fault("channel b").sensors[0].direction, Vec3::UnitX());
  EXPECT_EQ(fault("channels a b").sensors[0].direction, Vec3::UnitY());
  EXPECT_EQ(fault("channels a b").sensors[1].direction, Vec3::UnitX());
  EXPECT_THROW(fault("channel c"), InputError);
}

/// Whatever a channel's axis, two angles give any other.
TEST(EffectCase, SensorsOnAWrongAxis) {
  const auto turned = [](const Vec3& axis, double gain, double turn, double tilt) {
    std::vector<Sensor> sensors = {{"a", Vec3::Zero(), axis, 0}};
    EffectSetting setting = {"sensor_fault", "channel a", {{"gain", gain}, {"turn", turn}, {"tilt", tilt}}};
    complete(setting);
    apply_effect(sensors, setting);
    return sensors[0].direction;
  };
  const Vec3 x = Vec3::UnitX(), y = Vec3::UnitY(), z = Vec3::UnitZ(), slanting = Vec3(0.36, -0.48, 0.8);
  for (const Vec3& axis : {x, y, z, slanting}) EXPECT_EQ(turned(axis, 0.7, 0.0, 0.0), 0.7 * axis);
  EXPECT_LT((turned(x, 1.0, 90.0, 0.0) - y).norm(), 1e-15);
  EXPECT_LT((turned(y, 1.0, 90.0, 0.0) + x).norm(), 1e-15);
  EXPECT_LT((turned(x, 1.0, 45.0, 0.0) - std::sqrt(0.5) * (x + y)).norm(), 1e-15);
  EXPECT_LT((turned(z, 1.0, 45.0, 0.0) - z).norm(), 1e-15);
  for (const Vec3& axis : {x, y, Vec3(-x), Vec3(-y)}) {
    EXPECT_LT((turned(axis, 1.0, 0.0, 90.0) - z).norm(), 1e-15);
    EXPECT_LT((turned(axis, 1.0, 0.0, 45.0) - std::sqrt(0.5) * (axis + z)).norm(), 1e-15);
  }
  EXPECT_LT((turned(z, 1.0, 0.0, -90.0) - x).norm(), 1e-15);
  EXPECT_LT((turned(z, -2.0, 90.0, -90.0) + 2.0 * y).norm(), 1e-15);
  EXPECT_LT((turned(Vec3(-z), 1.0, 0.0, 90.0) - x).norm(), 1e-15);
  EXPECT_NEAR(turned(slanting, 1.0, 30.0, 10.0).norm(), 1.0, 1e-15);
}

/// Ties live in an assembly file, prestress included; without them a file is what it was.
TEST(EffectCase, TiesSurviveTheAssemblyFile) {
  const Folder folder;
  const std::string ties = "[[effect]]\nname = \"retrofit_ties\"\nwhere = \"all\"\npretension = 5e4\n";
  const Case c = parse_case(plain + ties, "c.toml", CaseUse::geometry);
  EXPECT_EQ(parse_case(resolved_text(c), "c.toml", CaseUse::geometry).hash, c.hash);
  const Assembly tied = make_assembly(c);
  write_assembly(folder / "tied.h5", tied);
  const Assembly read = read_assembly(folder / "tied.h5");
  EXPECT_EQ(assembly_hash(read), assembly_hash(tied));
  ASSERT_EQ(read.laws.size(), tied.laws.size());
  for (std::size_t k = 0; k < read.laws.size(); ++k) EXPECT_EQ(read.laws[k], tied.laws[k]);
  EXPECT_EQ(read.laws.back().kind, JointLaw::Kind::tie);
  EXPECT_GT(read.laws.back().prestress, 0.0);
}

/// It acts through the drives of the motion stages; the resolved case has both and means the same.
TEST(EffectCase, SupportMotionBecomesADrive) {
  const std::string motion =
      "[[stage]]\nkind = \"motion\"\nduration = 2.0\n"
      "pulse = { kind = \"sine\", axis = \"x\", amplitude = 1.0, frequency = 2.0 }\n";
  const std::string late = "[[effect]]\nname = \"support_motion\"\nwhere = \"pier 0\"\nfactor = 0.9\ndelay = 0.02\n";
  const Case c = parse_case(plain + motion + late, "c.toml");
  const Case copy = parse_case(resolved_text(c), "c.toml");
  EXPECT_EQ(copy.hash, c.hash);
  for (const Case* one : {&c, &copy}) {
    const std::vector<Drive>& drives = one->settings.stages.at(0).drives;
    ASSERT_EQ(drives.size(), 1u);
    EXPECT_EQ(drives[0].group, "base pier 0");
    EXPECT_EQ(drives[0].factor, 0.9);
    EXPECT_EQ(drives[0].delay, 0.02);
  }
  EXPECT_TRUE(make_assembly(c).effects.empty()) << "the bridge itself is the same";
  EXPECT_NO_THROW(make_assembly(parse_case(plain + late, "c.toml", CaseUse::geometry)));
}

TEST(EffectCase, WrongKeysSayLineAndRemedy) {
  const auto holds = [](const std::string& text, const std::vector<std::string>& pieces) {
    const std::string message =
        test::message_of<InputError>([&] { make_assembly(parse_case(plain + text, "c.toml", CaseUse::geometry)); });
    for (const std::string& piece : pieces) EXPECT_NE(message.find(piece), std::string::npos) << message;
  };
  holds("[[effect]]\nwhere = \"all\"\n", {"c.toml:4:", "name"});
  holds("[[effect]]\nname = \"scours\"\n", {"c.toml:4:", "did you mean 'scour'"});
  holds("[[effect]]\nname = \"damping\"\nrate = 0.1\n", {"c.toml:4:", "unknown parameter 'rate'", "ratio"});
  holds("[[effect]]\nname = \"damping\"\nratio = 3\n", {"c.toml:4:", "ratio is 3", "from 0.001 to 0.2"});
  holds("[[effect]]\nname = \"damping\"\nratio = \"much\"\n", {"c.toml:6:", "'ratio'"});
  holds("[damping]\nkind = \"local\"\n[[effect]]\nname = \"damping\"\n", {"c.toml:6:", "has no ratio"});
  holds("[[effect]]\nname = \"damping\"\nwhere = \"pier 0\"\n", {"its places in this assembly are: all"});
  holds("[[effect]]\nname = \"scour\"\n", {"c.toml", "its places in this assembly are: abutment left x-"});
  holds("[[effect]]\nname = \"support_motion\"\n", {"c.toml:4:", "Name the support", "pier 0"});
  holds("[[effect]]\nname = \"support_motion\"\nwhere = \"pier 9\"\n",
        {"c.toml", "its places in this assembly are: abutment left"});
  holds("[[effect]]\nname = \"parapet_not_structural\"\n", {"c.toml", "cannot act anywhere"});
  holds("[[effect]]\nname = \"grouted_infill\"\n", {"c.toml", "cannot act anywhere", "infill"});
  holds("[[effect]]\nname = \"retrofit_ties\"\n", {"c.toml", "its places in this assembly are: abutment left"});
  holds("[joints.masonry-masonry]\nkind = \"tie\"\n", {"c.toml:5:", "brittle", "elastic"});
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
