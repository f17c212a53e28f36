// Values that were probably meant in another unit get a remark with what was meant; usual ones get none.
#include "io/case/remarks.h"

#include <gtest/gtest.h>

#include <filesystem>

#include "io/case/case.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

struct Slipped {
  const char* name;
  std::string text;
  std::vector<std::string> expected;  // of the only remark; none: no remark
};

const std::string head = "[bridge]\ngenerator = \"wall\"\n";  // lines 1 and 2
const std::string masonry = head + "[materials.masonry]\n";   // line 3
const std::string column = "[bridge]\ngenerator = \"column\"\n";
const std::string motion = "[[stage]]\nkind = \"motion\"\n";

const std::vector<Slipped> table = {
    {"UsualMaterial",
     masonry + "density = 1800\nyoungs_modulus = 4e9\nshear_modulus = 1.6e9\ntensile_strength = 1e5\ncohesion = 0.0\n",
     {}},
    {"ModulusInGPa",
     masonry + "youngs_modulus = 4\n",
     {"c.toml:4: youngs_modulus = 4 Pa in [materials.masonry]", "5e+06 to 2.5e+11 Pa", "meant in GPa, write 4e+09"}},
    {"ModulusInMPa", masonry + "youngs_modulus = 4000.0\n", {"meant in MPa, write 4e+09"}},
    {"ShearModulusInGPa", masonry + "shear_modulus = 1.6\n", {"meant in GPa, write 1.6e+09"}},
    {"StrengthInMPa",
     masonry + "tensile_strength = 0.1\n",
     {"c.toml:4: tensile_strength = 0.1 Pa", "meant in MPa, write 1e+05"}},
    {"CohesionInKPa", masonry + "cohesion = 90\n", {"c.toml:4: cohesion = 90 Pa", "meant in kPa, write 9e+04"}},
    {"DensityInKNPerM3", masonry + "density = 18\n", {"c.toml:4: density = 18 kg/m3", "kN/m3, write 1835"}},
    {"DensityInTPerM3", masonry + "density = 1.8\n", {"meant in t/m3, write 1800"}},
    {"DensityInNPerM3", masonry + "density = 18000\n", {"meant in N/m3, write 1835"}},
    {"FrictionInRadians", masonry + "friction_angle = 0.6\n", {"meant in radians, write 34.38"}},
    {"JointStiffnessInNPerMm3",
     head + "[joints.masonry-masonry]\nkn = 10\nks = 4e9\n",
     {"c.toml:4: kn = 10 Pa/m in [joints.masonry-masonry]", "N/mm3, write 1e+10"}},
    {"FractureEnergyInNPerMm",
     head + "[joints.masonry-masonry]\nfracture_energy = [0.02, 50]\n",
     {"c.toml:4: fracture_energy = 0.02 J/m2", "N/mm, write 20"}},
    {"CompressiveStrengthInMPa",
     head + "[joints.masonry-masonry]\nkind = \"composite\"\nfracture_energy = [20, 50]\ncompressive_strength = 12\n"
            "compressive_energy = 2e4\n",
     {"c.toml:6: compressive_strength = 12 Pa", "MPa, write 1.2e+07"}},
    {"StiffnessOfAGenerator", head + "kn = 20\n", {"c.toml:3: kn = 20 Pa/m in [bridge]", "N/mm3, write 2e+10"}},
    {"LengthInMillimetres",
     column + "base_width = 900.0\n",
     {"c.toml:3: base_width = 900 m in [bridge]", "mm, write 0.9"}},
    {"FrictionOfAGenerator",
     "[bridge]\ngenerator = \"cs1\"\ninterface_friction = 0.61\n",
     {"c.toml:3: interface_friction = 0.61 degrees", "radians, write 34.95"}},
    {"GravityInCm", head + "[analysis]\ngravity = 981\n", {"c.toml:4: gravity = 981 m/s2", "cm/s2, write 9.81"}},
    {"GravityAsAVector", head + "[analysis]\ngravity = [4.9, 0.0, -8.5]\n", {}},
    {"DampingInPerCent", head + "[damping]\nratio = 0.5\n", {"c.toml:4: ratio = 0.5", "per cent, write 0.005"}},
    {"FrequencyAsPeriod",
     head + "[modal]\nexpected = [{ direction = \"vertical\", period = 8.0 }]\n",
     {"c.toml:4: period = 8 s in [modal.expected[1]]", "meant in Hz, write 0.125"}},
    {"PeriodInMs",
     head + "[modal]\nexpected = [{ direction = \"vertical\", period = 125.0 }]\n",
     {"c.toml:4: period = 125 s", "ms, write 0.125"}},
    {"PulseInG",
     head + motion + "duration = 2.0\npulse = { kind = \"sine\", axis = \"x\", amplitude = 0.15, frequency = 2.0 }\n",
     {"c.toml:6: amplitude = 0.15 m/s2 in [stage[1].pulse]", "meant in g, write 1.471"}},
    {"SyntheticInCm",
     head + motion + "duration = 4.0\nsynthetic = { seed = 1, peak = 300 }\n",
     {"c.toml:6: peak = 300 m/s2 in [stage[1].synthetic]", "cm/s2, write 3"}},
    {"SpectrumInMPerS2",
     head + motion +
         "duration = 4.0\nsynthetic = { spectrum = \"ntc2018\", ag = 2.5, f0 = 2.5, tc = 0.4, soil = \"A\" }\n",
     {"c.toml:6: ag = 2.5 g in [stage[1].synthetic]", "m/s2, write 0.2549"}},
    {"ForceInKN",
     head + "[[stage]]\nkind = \"gravity\"\nload = [{ group = \"course 9\", force = [0.0, 0.0, -20.0] }]\n",
     {"c.toml:5: force = 20 N in [stage[1].load[1]]", "kN, write 2e+04"}},
    {"PatternOfACollapse",
     head + "[[stage]]\nkind = \"collapse\"\nload = [{ group = \"course 9\", force = [0.0, 0.0, -1.0] }]\nto = 1e6\n",
     {}},
    {"StageInMs",
     head + "[[stage]]\nkind = \"free\"\nduration = 2000\n",
     {"c.toml:5: duration = 2000 s", "ms, write 2"}},
    {"OfAHundredSeconds",
     head + motion + "duration = 100.0\nsynthetic = { seed = 1, peak = 2.0, duration = 16.0 }\n",
     {"c.toml:5: stage 1 lasts 100 s, but its motion only 16 s"}},
    {"WithTimeToRing", head + motion + "duration = 20.0\nsynthetic = { seed = 1, peak = 2.0, duration = 8.0 }\n", {}}};

class Remark : public ::testing::TestWithParam<Slipped> {};

TEST_P(Remark, SaysWhatWasProbablyMeant) {
  const bool staged = GetParam().text.find("[[stage]]") != std::string::npos;  // motions are made for a run alone
  const std::vector<std::string> found =
      remarks(parse_case(GetParam().text, "c.toml", staged ? CaseUse::run : CaseUse::geometry));
  if (GetParam().expected.empty()) {
    EXPECT_TRUE(found.empty()) << found.front();
    return;
  }
  ASSERT_EQ(found.size(), 1u);
  for (const std::string& part : GetParam().expected) EXPECT_NE(found[0].find(part), std::string::npos) << found[0];
}

INSTANTIATE_TEST_SUITE_P(Units, Remark, ::testing::ValuesIn(table), [](const auto& i) { return i.param.name; });

/// Plain columns of a motion along x: 200 samples a second, a sine of 2 Hz with this peak over 16 s.
std::string columns(double peak) {
  std::string text;
  for (int i = 0; i <= 3200; ++i)
    text +=
        fmt::format("{} {}\n", 0.005 * i, peak * std::sin(2.0 * M_PI * 2.0 * 0.005 * i) * std::exp(-0.1 * i * 0.005));
  return text;
}

std::vector<std::string> with_record(double peak, double duration) {
  const test::Folder folder;
  folder.write("a.txt", columns(peak));
  const std::string file =
      folder.write("c.toml", head + motion + fmt::format("duration = {}\nrecord = \"a.txt\"\n", duration));
  return remarks(read_case(file));
}

TEST(RemarkOnRecords, WithAPeakInAnotherUnit) {
  EXPECT_TRUE(with_record(2.0, 16.0).empty());
  const std::vector<std::string> gal = with_record(220.0, 16.0);
  ASSERT_EQ(gal.size(), 1u);
  for (const char* part : {"c.toml:6: the motion of stage 1 has a peak of 217.3 m/s2 (22.2 g)", "cm/s2, write 2.173"})
    EXPECT_NE(gal[0].find(part), std::string::npos) << gal[0];
  const std::vector<std::string> g = with_record(0.15, 16.0);
  ASSERT_EQ(g.size(), 1u);
  EXPECT_NE(g[0].find("meant in g, write 1.4"), std::string::npos) << g[0];
}

TEST(RemarkOnRecords, ThatAreShorterThanTheirStage) {
  EXPECT_TRUE(with_record(2.0, 30.0).empty());
  const std::vector<std::string> found = with_record(2.0, 100.0);
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("c.toml:5: stage 1 lasts 100 s, but its motion only 16 s"), std::string::npos) << found[0];
}

TEST(RemarkOnAssemblies, OfKilometres) {
  const std::string text = "[bridge]\ngenerator = \"wall\"\nlength_blocks = 1300\nblock_length = 20.0\ncourses = 2\n";
  const Case c = parse_case(text, "c.toml", CaseUse::geometry);
  const std::vector<std::string> found = remarks(c, make_assembly(c));
  ASSERT_EQ(found.size(), 1u);
  EXPECT_NE(found[0].find("c.toml: the largest side of the structure is 2.6e+04 m"), std::string::npos) << found[0];
  EXPECT_NE(found[0].find("meant in mm, write 26"), std::string::npos) << found[0];
}

/// Every case of the house, its tutorials and what their checks make of them.
TEST(RemarkOnCases, OfTheHouseAreNone) {
  int count = 0;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(VOUSSOIR_SOURCE_DIR "/cases")) {
    const std::string path = entry.path().string();
    const bool other = path.find("/campaigns/") != std::string::npos || path.find("/vehicles/") != std::string::npos;
    if (entry.path().extension() != ".toml" || other) continue;
    ++count;
    for (const std::string& remark : remarks(read_case(path, CaseUse::geometry))) ADD_FAILURE() << remark;
  }
  EXPECT_GE(count, 25);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
