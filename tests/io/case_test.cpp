// Case files: what is read, and that a resolved copy is the same case.
#include "io/case/case.h"

#include <gtest/gtest.h>

#include "io/case/degrees.h"
#include "io/hdf5/assembly_file.h"
#include "io/records/curve.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::Folder;

const char* const full = R"(
[bridge]
generator = "wall"
length_blocks = 4
courses = 3

[materials.masonry]
density = 1800.0
tensile_strength = 0.1e6
friction_angle = 33.3

[joints.masonry-masonry]
kn = 5e9
ks = 2e9
cohesion = 0.2e6
residual_friction_angle = 28.7
fracture_energy = [50.0, 100.0]

[analysis]
gravity = [0.1, 0.0, -9.81]
safety = 0.7

[contact]
points_per_side = 4
gap_tolerance = 2e-4
reclip_angle = 2.5

[damping]
kind = "rayleigh"
ratio = 0.05
band = [1, 20.0]

[[stage]]
kind = "gravity"
method = "relaxation"

[[stage]]
kind = "motion"
duration = 2.5
record = ["x.txt", "", "z.txt"]
units = "g"
scale = 1.5

[[stage]]
kind = "motion"
duration = 3
pulse = { kind = "sine", axis = "y", amplitude = 4.0, frequency = 2.0 }

[[stage]]
kind = "motion"
duration = 6.0
synthetic = { seed = 3, peak = 2.0, axes = ["x", "y"], frequency = 3.1 }
label = "noise \"three\""

[[stage]]
kind = "free"
duration = 1.0

[output]
history_every = 0.01

[[sensor]]
id = "a1"
position = [0.3, 0.0, 0.7]
direction = [1.0, 2.0, 3.0]

[[sensor]]
id = "a2"
position = [0.3, 0.0, 0.7]
direction = "y"
)";

class CaseFile : public testing::Test {
 protected:
  void SetUp() override {
    folder.write("x.txt", "# t a\n0.0 0.0\n0.01, 0.1\n0.02\t-0.3\n");
    folder.write("z.txt", "0 0\n0.01 0.05\n");
  }
  Folder folder;
};

TEST_F(CaseFile, EveryTableIsRead) {
  const Case c = read_case(folder.write("case.toml", full));
  const SolverSettings& s = c.settings;
  EXPECT_EQ(c.generator, "wall");
  EXPECT_EQ(c.generator_input("courses"), 3.0);
  EXPECT_EQ(c.generator_input("block_height"), 0.5);
  EXPECT_EQ(c.generator_input.gap_tolerance, 2e-4);
  EXPECT_EQ(c.generator_input.materials.at("masonry").density, 1800.0);
  EXPECT_NEAR(c.generator_input.materials.at("masonry").friction_angle, 0.58119464091411, 1e-12);
  EXPECT_EQ(s.gravity, Vec3(0.1, 0.0, -9.81));
  EXPECT_EQ(s.step.safety, 0.7);
  EXPECT_EQ(s.contact.points_per_side, 4);
  EXPECT_NEAR(s.contact.reclip_angle, 0.0436332312998582, 1e-15);
  EXPECT_EQ(s.damping.kind, DampingSettings::Kind::rayleigh);
  EXPECT_EQ(s.damping.band[0], 1.0);
  EXPECT_EQ(s.output.history_every, 0.01);
  EXPECT_EQ(s.output.checkpoint_every, 5.0);
  ASSERT_EQ(c.sensors.size(), 2u);
  EXPECT_NEAR((c.sensors[0].direction - Vec3(1, 2, 3).normalized()).norm(), 0.0, 1e-15);
  EXPECT_EQ(c.sensors[1].direction, Vec3::UnitY());
}

TEST_F(CaseFile, JointLawTakesWhatItLeavesOutFromTheMaterial) {
  const auto joint = read_case(folder.write("case.toml", full)).generator_input.joints.at("masonry-masonry");
  ASSERT_TRUE(joint.has_law);
  EXPECT_EQ(joint.kn, 5e9);
  EXPECT_EQ(joint.law.kind, JointLaw::Kind::softening);
  EXPECT_EQ(joint.law.tension, 0.1e6);
  EXPECT_EQ(joint.law.cohesion, 0.2e6);
  EXPECT_NEAR(joint.law.friction_angle, 0.58119464091411, 1e-12);
  EXPECT_NEAR(joint.law.residual_friction_angle, 0.50090949537, 1e-9);
  EXPECT_EQ(joint.law.residual_cohesion, 0.0);
  EXPECT_EQ(joint.law.fracture_energy[1], 100.0);
}

TEST_F(CaseFile, StagesAndMotions) {
  const Case c = read_case(folder.write("case.toml", full));
  const auto& stages = c.settings.stages;
  ASSERT_EQ(stages.size(), 5u);
  EXPECT_EQ(stages[0].method, StageSettings::Method::relaxation);
  const GroundMotion& record = stages[1].motion;
  ASSERT_EQ(record.acceleration.size(), 3u);
  EXPECT_DOUBLE_EQ(record.dt, 0.01);
  EXPECT_NEAR(record.acceleration[2].x(), -0.3 * 9.80665 * 1.5, 1e-12);
  EXPECT_NEAR(record.acceleration[1].z(), 0.05 * 9.80665 * 1.5, 1e-12);
  EXPECT_EQ(record.acceleration[2].z(), 0.0);  // shorter component ends in zeros
  EXPECT_EQ(stages[2].label, "motion (pulse sine y)");
  EXPECT_NEAR(stages[2].motion.duration(), 0.5, 0.01);
  EXPECT_NEAR(stages[3].motion.duration(), 6.0, 1e-9);
  EXPECT_EQ(stages[4].kind, StageSettings::Kind::free);
}

bool same_motion(const GroundMotion& a, const GroundMotion& b) {
  return a.dt == b.dt && a.acceleration == b.acceleration;
}

TEST_F(CaseFile, ResolvedCopyIsTheSameCaseBitForBit) {
  const Case c = read_case(folder.write("case.toml", full));
  const Folder run;
  write_resolved_case(c, run.path());
  EXPECT_EQ(test::bytes_of(run / "motion_2_x.txt"), test::bytes_of(folder / "x.txt"));
  const Case copy = read_case(run / "case.toml");
  EXPECT_EQ(resolved_text(copy), resolved_text(c));
  EXPECT_EQ(copy.hash, c.hash);
  for (std::size_t i = 0; i < c.settings.stages.size(); ++i) {
    EXPECT_TRUE(same_motion(copy.settings.stages[i].motion, c.settings.stages[i].motion)) << i;
    EXPECT_EQ(copy.settings.stages[i].label, c.settings.stages[i].label);
  }
  EXPECT_EQ(copy.generator_input.values, c.generator_input.values);
  EXPECT_EQ(copy.generator_input.joints.at("masonry-masonry").law, c.generator_input.joints.at("masonry-masonry").law);
  EXPECT_EQ(copy.settings.contact.reclip_angle, c.settings.contact.reclip_angle);
  EXPECT_EQ(copy.sensors[0].direction, c.sensors[0].direction);
}

TEST_F(CaseFile, HashSeesTheCaseAndTheRecords) {
  const std::uint64_t hash = read_case(folder.write("case.toml", full)).hash;
  std::string other = full;
  other.replace(other.find("ratio = 0.05"), 12, "ratio = 0.06");
  EXPECT_NE(read_case(folder.write("case.toml", other)).hash, hash);
  EXPECT_EQ(read_case(folder.write("case.toml", std::string("# a comment\n") + full)).hash, hash);
  folder.write("z.txt", "0 0\n0.01 0.06\n");
  EXPECT_NE(read_case(folder.write("case.toml", full)).hash, hash);
}

TEST_F(CaseFile, CompositeJointsSurviveResolving) {
  const std::string text =
      "[bridge]\ngenerator = \"wall\"\nkn = 1e10\nks = 4e9\n[joints.masonry-masonry]\nkind = \"composite\"\n"
      "tensile_strength = 1e5\ncohesion = 2e5\nfriction_angle = 37\nresidual_friction_angle = 31\n"
      "dilation_angle = 11\nfracture_energy = [20, 80]\ncompressive_strength = 9e6\ncompressive_energy = 2e4\n"
      "compressive_peak = 1e-3\ncap_shear = 4\ndilation_length = 0.002\ndilation_pressure = 1e6\n"
      "[[stage]]\nkind = \"gravity\"\n";
  const Case c = parse_case(text, folder / "case.toml");
  const Case copy = parse_case(resolved_text(c), folder / "case.toml");
  EXPECT_EQ(copy.hash, c.hash);
  for (const Case* one : {&c, &copy}) {
    const JointLaw& law = one->generator_input.joints.at("masonry-masonry").law;
    EXPECT_EQ(law.kind, JointLaw::Kind::composite);
    EXPECT_EQ(law.compressive_strength, 9e6);
    EXPECT_EQ(law.compressive_energy, 2e4);
    EXPECT_EQ(law.compressive_peak, 1e-3);
    EXPECT_EQ(law.cap_shear, 4.0);
    EXPECT_EQ(law.dilation_length, 0.002);
    EXPECT_EQ(law.dilation_pressure, 1e6);
  }
  EXPECT_NO_THROW(make_assembly(c));
}

/// Said with the least that will do, once the stiffness of the joints is known.
TEST_F(CaseFile, CompressiveEnergyTooSmallForTheStiffness) {
  const std::string text =
      "[bridge]\ngenerator = \"wall\"\nkn = 1e10\nks = 4e9\n[joints.masonry-masonry]\nkind = \"composite\"\n"
      "fracture_energy = [20, 80]\ncompressive_strength = 9e6\ncompressive_energy = 1e4\n"
      "[[stage]]\nkind = \"gravity\"\n";
  try {
    make_assembly(parse_case(text, folder / "case.toml"));
    FAIL() << "was taken";
  } catch (const InputError& error) {
    const std::string what = error.what();  // (67/75) fc² / (0.7 ks + 0.3 kn)
    EXPECT_NE(what.find("compressive_energy, 10000 J/m2, is too small"), std::string::npos) << what;
    EXPECT_NE(what.find("Give more than 1.248e+04 J/m2"), std::string::npos) << what;
  }
}

TEST_F(CaseFile, DrivesSurviveResolving) {
  const std::string text =
      "[bridge]\ngenerator = \"arch\"\n[[stage]]\nkind = \"free\"\nduration = 2.0\ndrive = [{ group = \"springing "
      "left\", "
      "displacement = [0.1, -0.2, 0.3] }, { group = \"springing right\", velocity = [0.01, 0.02, 0.03] }]\n";
  const Case c = parse_case(text, folder / "case.toml");
  const Case copy = parse_case(resolved_text(c), folder / "case.toml");
  EXPECT_EQ(copy.hash, c.hash);
  for (const Case* one : {&c, &copy}) {
    const std::vector<Drive>& drives = one->settings.stages.at(0).drives;
    ASSERT_EQ(drives.size(), 2u);
    EXPECT_EQ(drives[0].group, "springing left");
    EXPECT_EQ(drives[0].displacement, Vec3(0.1, -0.2, 0.3));
    EXPECT_EQ(drives[0].velocity, Vec3(0, 0, 0));
    EXPECT_EQ(drives[1].velocity, Vec3(0.01, 0.02, 0.03));
  }
}

TEST_F(CaseFile, SupportsThatMoveOtherwiseSurviveResolving) {
  const std::string text =
      "[bridge]\ngenerator = \"arch\"\n[[stage]]\nkind = \"motion\"\nduration = 2.0\n"
      "pulse = { kind = \"sine\", axis = \"x\", amplitude = 1.0, frequency = 2.0 }\n"
      "drive = [{ group = \"springing left\", factor = 0.8, delay = 0.05 }, "
      "{ group = \"springing right\", velocity = [0.01, 0.02, 0.03], delay = -0.1 }]\n";
  const Case c = parse_case(text, folder / "case.toml");
  const Case copy = parse_case(resolved_text(c), folder / "case.toml");
  EXPECT_EQ(copy.hash, c.hash);
  for (const Case* one : {&c, &copy}) {
    const std::vector<Drive>& drives = one->settings.stages.at(0).drives;
    ASSERT_EQ(drives.size(), 2u);
    EXPECT_EQ(drives[0].factor, 0.8);
    EXPECT_EQ(drives[0].delay, 0.05);
    EXPECT_EQ(drives[0].displacement, Vec3(0, 0, 0));
    EXPECT_EQ(drives[1].factor, 1.0);
    EXPECT_EQ(drives[1].delay, -0.1);
    EXPECT_EQ(drives[1].velocity, Vec3(0.01, 0.02, 0.03));
  }
}

TEST_F(CaseFile, GuidesSurviveResolving) {
  const std::string text =
      "[bridge]\ngenerator = \"arch\"\n[[guide]]\ngroup = \"springing left\"\nfree = [\"z\", \"x\"]\n[[guide]]\ngroup "
      "= "
      "\"springing right\"\nturn = true\n[[stage]]\nkind = \"gravity\"\n";
  const Case c = parse_case(text, folder / "case.toml");
  const Case copy = parse_case(resolved_text(c), folder / "case.toml");
  EXPECT_EQ(copy.hash, c.hash);
  for (const Case* one : {&c, &copy}) {
    const std::vector<Guide>& guides = one->settings.guides;
    ASSERT_EQ(guides.size(), 2u);
    EXPECT_EQ(guides[0].group, "springing left");
    EXPECT_EQ(guides[0].free, (std::array<bool, 3>{true, false, true}));
    EXPECT_FALSE(guides[0].turn);
    EXPECT_TRUE(guides[1].turn);
  }
}

/// A file that says its unit itself is refused with another beside it, also in the resolved copy.
TEST_F(CaseFile, RecordsThatSayTheirUnitSurviveResolving) {
  folder.write("x.AT2",
               "PEER\nEV, 1/1/2000, ST, 000\nACCELERATION TIME SERIES IN UNITS OF G\nNPTS=    4, DT=   .0050 SEC\n"
               " .1 .2 .1 .0\n");
  const Case c = parse_case(
      "[bridge]\ngenerator = \"column\"\n[[stage]]\nkind = \"motion\"\nduration = 0.1\nrecord = [\"\", \"x.AT2\"]\n",
      folder / "c.toml");
  const Folder run;
  write_resolved_case(c, run.path());
  const Case copy = read_case(run / "case.toml");
  EXPECT_EQ(copy.hash, c.hash);
  ASSERT_EQ(copy.settings.stages[0].motion.acceleration.size(), 4u);
  EXPECT_DOUBLE_EQ(copy.settings.stages[0].motion.acceleration[1].y(), 0.2 * 9.80665);
}

/// A plot changes nothing in a run, so not its hash either; a measured curve goes along with the resolved case, and one
/// that is not there is no error.
TEST_F(CaseFile, PlotsSurviveResolving) {
  const std::string plain = "[bridge]\ngenerator = \"column\"\n[[stage]]\nkind = \"gravity\"\n";
  folder.write("there.csv", "Test unit,1\nmm,kN\n0,0\n0.5,1e1,extra\n\n1, 12\n");
  const std::string file = folder.write(
      "case.toml", plain +
                       "[[plot]]\nname = \"force\"\ny = \"energy/kinetic\"\ny_factor = 0.001\nmeasured = [{ file = "
                       "\"there.csv\", label = \"test 1\" }, { file = \"elsewhere.csv\" }]\n");
  const Case c = read_case(file);
  EXPECT_EQ(c.hash, parse_case(plain, "plain.toml").hash);
  std::filesystem::create_directory(folder / "run");
  write_resolved_case(c, folder / "run");
  const Case copy = read_case(folder / "run/case.toml");
  ASSERT_EQ(copy.plots.size(), 1u);
  const PlotSpec& plot = copy.plots[0];
  EXPECT_EQ(plot.name, "force");
  EXPECT_EQ(plot.x, "time");
  EXPECT_EQ(plot.y_factor, 0.001);
  ASSERT_EQ(plot.measured.size(), 2u);
  EXPECT_EQ(plot.measured[0].label, "test 1");
  EXPECT_EQ(plot.measured[0].text, c.plots[0].measured[0].text);
  EXPECT_EQ(plot.measured[1].label, "elsewhere");
  EXPECT_TRUE(plot.measured[1].text.empty());
}

TEST_F(CaseFile, MeasuredCurvesAreTwoColumnsUnderHeadings) {
  const Curve curve = parse_curve("Test unit,SW.1\n[mm],[kN]\n# note\n0;0\n0.5\t1e1 7\r\n\n+1, -12\n", "a.csv");
  EXPECT_EQ(curve.x, (std::vector<double>{0, 0.5, 1}));
  EXPECT_EQ(curve.y, (std::vector<double>{0, 10, -12}));
  const auto refused = [](const std::string& text, const std::string& word) {
    try {
      parse_curve(text, "a.csv");
      ADD_FAILURE() << text;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(word), std::string::npos) << error.what();
    }
  };
  refused("0,0\n1,nan\n", "a.csv:2:");
  refused("0,0\n1\n", "a.csv:2:");
  refused("mm,kN\n", "0 lines begin with two numbers");
  refused("", "0 lines");
}

TEST_F(CaseFile, PlacementsSurviveResolving) {
  const std::string text =
      "[bridge]\ngenerator = \"column\"\n[[stage]]\nkind = \"free\"\nduration = 2.0\nplace = [{ group = \"top\", "
      "move = [0.1, 0.2, 0.3], angle = 7.0, axis = [1, 2, 3], through = [4, 5, 6] }, { group = \"all\" }]\n";
  const Case c = parse_case(text, folder / "case.toml");
  const Case copy = parse_case(resolved_text(c), folder / "case.toml");
  EXPECT_EQ(copy.hash, c.hash);
  for (const Case* one : {&c, &copy}) {
    const std::vector<Placement>& placements = one->settings.stages.at(0).placements;
    ASSERT_EQ(placements.size(), 2u);
    EXPECT_EQ(placements[0].move, Vec3(0.1, 0.2, 0.3));
    EXPECT_NEAR(placements[0].angle, 7.0 * 3.14159265358979 / 180.0, 1e-14);
    EXPECT_EQ(placements[0].axis, Vec3(1, 2, 3));
    EXPECT_EQ(placements[0].through, Vec3(4, 5, 6));
    EXPECT_EQ(placements[1].angle, 0.0);
  }
}

TEST_F(CaseFile, LoadsAndCollapseSurviveResolving) {
  const std::string text =
      "[bridge]\ngenerator = \"arch\"\n[[stage]]\nkind = \"gravity\"\nload = [{ acceleration = [0.1, 0, 0] }]\n"
      "[[stage]]\nkind = \"free\"\nduration = 1.0\nload = []\n"
      "[[stage]]\nkind = \"collapse\"\nto = 2.0\ndisplacement = 0.05\nconfirm = 0.0\n"
      "load = [{ group = \"voussoir 3\", force = [1, 2, 3], at = [4, 5, 6] }, { group = \"keystone 0\", force = [7, 8, "
      "9] }]\n";
  const Case c = parse_case(text, folder / "case.toml");
  const Case copy = parse_case(resolved_text(c), folder / "case.toml");
  EXPECT_EQ(copy.hash, c.hash);
  for (const Case* one : {&c, &copy}) {
    const std::vector<StageSettings>& stages = one->settings.stages;
    EXPECT_EQ(stages.at(0).loads->acceleration, Vec3(0.1, 0, 0));
    EXPECT_TRUE(stages.at(1).loads->forces.empty());
    ASSERT_EQ(stages.at(2).loads->forces.size(), 2u);
    EXPECT_EQ(stages[2].loads->forces[0].at, Vec3(4, 5, 6));
    EXPECT_FALSE(stages[2].loads->forces[1].at);
    EXPECT_EQ(stages[2].loads->forces[1].force, Vec3(7, 8, 9));
    EXPECT_EQ(stages[2].collapse.to, 2.0);
    EXPECT_EQ(stages[2].collapse.tolerance, 2e-3);
    EXPECT_EQ(stages[2].collapse.displacement, 0.05);
    EXPECT_EQ(stages[2].collapse.confirm, 0.0);
  }
}

TEST_F(CaseFile, DefaultsOfEveryGeneratorSurviveResolving) {
  for (const Generator& generator : generators()) {
    const std::string text = "[bridge]\ngenerator = \"" + generator.name + "\"\n[[stage]]\nkind = \"gravity\"\n";
    const Case c = parse_case(text, folder / "case.toml");
    const Case copy = parse_case(resolved_text(c), folder / "case.toml");
    EXPECT_EQ(copy.hash, c.hash) << generator.name;
    for (const Parameter& p : generator.parameters) EXPECT_EQ(c.generator_input(p.name), p.value) << p.name;
    for (const Material& m : generator.materials) {
      const Material& own = c.generator_input.materials.at(m.name);
      EXPECT_NEAR(own.friction_angle, m.friction_angle, 1e-15);
      EXPECT_EQ(copy.generator_input.materials.at(m.name).friction_angle, own.friction_angle);
    }
  }
}

TEST_F(CaseFile, ListsOfSpansAreReadAndWrittenOut) {
  const std::string bridge =
      "[bridge]\ngenerator = \"bridge\"\nwidth = 5.5\n[[bridge.span]]\nshape = \"segmental\"\nclear_span = 6.0\nrepeat "
      "= 2\n"
      "[[bridge.span]]\nshape = \"surveyed\"\nintrados = [[0.0, 0.0], [2.0, 1.1], [4.0, "
      "0.1]]\n[[bridge.pier]]\nthickness = "
      "1.3\n[bridge.abutment.left]\nlength = 2.5\n";
  const std::string stage = "[[stage]]\nkind = \"gravity\"\n";
  const Case c = parse_case(bridge + stage, folder / "case.toml");
  const GeneratorInput& in = c.generator_input;
  EXPECT_EQ(in.entries.at("span"), 3u);
  EXPECT_EQ(in("span.2.clear_span"), 6.0);
  EXPECT_EQ(in("span.3.clear_span"), 8.0) << "the default";
  EXPECT_EQ(in.choices.at("span.3.shape"), "surveyed");
  EXPECT_EQ(in.profiles.at("span.3.intrados"), (Polygon{{0, 0, 0}, {2, 0, 1.1}, {4, 0, 0.1}}));
  EXPECT_EQ(in("abutment.left.length"), 2.5);
  EXPECT_EQ(in("abutment.right.length"), 4.0);
  const Case copy = parse_case(resolved_text(c), folder / "case.toml");
  EXPECT_EQ(copy.hash, c.hash);
  EXPECT_EQ(copy.generator_input.values, in.values);
  EXPECT_EQ(copy.generator_input.profiles, in.profiles);

  const auto refused = [&](const std::string& more, const std::vector<std::string>& words) {
    const std::string text = test::message_of<InputError>([&] { parse_case(more + stage, folder / "case.toml"); });
    for (const std::string& word : words) EXPECT_NE(text.find(word), std::string::npos) << text;
  };
  refused("[bridge]\ngenerator = \"bridge\"\n[[bridge.span]]\nshap = \"segmental\"\n",
          {"case.toml:4", "'shap'", "[[span]] number 1", "did you mean 'shape'?"});
  refused("[bridge]\ngenerator = \"bridge\"\n[[bridge.span]]\nrise = -1.0\n", {"case.toml:4", "'rise'"});
  refused("[bridge]\ngenerator = \"bridge\"\n[bridge.abutment.midle]\nlength = 2.0\n",
          {"'midle'", "[bridge.abutment]"});
  refused("[bridge]\ngenerator = \"bridge\"\n[bridge.span]\nrise = 1.0\n", {"'span'", "double brackets"});
  refused("[bridge]\ngenerator = \"bridge\"\n[[bridge.span]]\nrepeat = 100\n", {"'repeat'"});
  refused("[bridge]\ngenerator = \"bridge\"\n[[bridge.span]]\nintrados = [[0.0, 0.0], [2.0]]\n",
          {"'intrados'", "entry 2", "[x, z]"});
  refused("[bridge]\ngenerator = \"bridge\"\n[[bridge.span]]\nintrados = [[0.0, 0.0], [-2.0, 1.0]]\n",
          {"'intrados'", "left to right"});
}

TEST_F(CaseFile, MaterialsOfTheCasesOwnAndRingThicknessesAreReadAndWrittenOut) {
  const std::string bridge =
      "[bridge]\ngenerator = \"bridge\"\n[[bridge.span]]\nmaterial = \"granite\"\n"
      "ring_thicknesses = [[0.3, 0.2], [0.25, 0.4]]\n[[bridge.pier]]\nmaterial = \"tuff\"\n";
  const std::string materials =
      "[materials.tuff]\nyoungs_modulus = 2e9\n[materials.masonry]\ndensity = 2000.0\n"
      "[materials.granite]\nfriction_angle = 35.0\n";
  const std::string rest = "[joints.granite-tuff]\nkn = 1e9\n[[stage]]\nkind = \"gravity\"\n";
  const Case c = parse_case(bridge + materials + rest, folder / "case.toml");
  const GeneratorInput& in = c.generator_input;
  EXPECT_EQ(in.profiles.at("span.1.ring_thicknesses"), (Polygon{{0.3, 0.0, 0.2}, {0.25, 0.0, 0.4}}));
  EXPECT_EQ(in.materials.at("tuff").youngs_modulus, 2e9);
  EXPECT_EQ(in.materials.at("tuff").density, 2000.0) << "as masonry in this case, wherever it stands";
  EXPECT_EQ(in.materials.at("granite").youngs_modulus, in.materials.at("vault").youngs_modulus);
  const Case copy = parse_case(resolved_text(c), folder / "case.toml");
  EXPECT_EQ(copy.hash, c.hash);
  EXPECT_EQ(resolved_text(copy), resolved_text(c));
  EXPECT_EQ(copy.generator_input.choices, in.choices);
  EXPECT_EQ(copy.generator_input.values, in.values);
  EXPECT_EQ(copy.generator_input.profiles, in.profiles);

  const auto refused = [&](const std::string& text, const std::vector<std::string>& words) {
    const std::string said = test::message_of<InputError>([&] { parse_case(text + rest, folder / "case.toml"); });
    for (const std::string& word : words) EXPECT_NE(said.find(word), std::string::npos) << said;
  };
  refused(bridge + "[materials.granite]\ndensity = 2600.0\n",
          {"pier.1.material = \"tuff\"", "the materials are: backfill, granite", "[materials.tuff]"});
  refused(bridge + materials + "[materials.gravel]\ndensity = 1800.0\n", {"'gravel'", "is not a material"});
  refused(bridge + "[materials.granit]\ndensity = 1800.0\n", {"'granit'", "did you mean 'granite'?"});
  refused("[bridge]\ngenerator = \"bridge\"\n[[bridge.span]]\nring_thickness = 0.5\nring_thicknesses = [[0.3, 0.3]]\n",
          {"'ring_thicknesses'", "'ring_thickness' are both given"});
  refused("[bridge]\ngenerator = \"bridge\"\n[[bridge.span]]\nring_thicknesses = [[0.3]]\n",
          {"'ring_thicknesses'", "[crown, springing]"});
}

TEST_F(CaseFile, BaselineCorrectionAndOneColumn) {
  folder.write("a.txt", "0.1\n0.2\n-0.1\n0.3\n0.1\n0.2\n-0.2\n");
  const std::string head =
      "[bridge]\ngenerator = \"column\"\n[[stage]]\nkind = \"motion\"\nduration = 1.0\nrecord = \"a.txt\"\n"
      "dt = 0.02\nunits = \"cm/s2\"\n";
  const GroundMotion plain = parse_case(head, folder / "c.toml").settings.stages[0].motion;
  const GroundMotion corrected = parse_case(head + "correct = true\n", folder / "c.toml").settings.stages[0].motion;
  EXPECT_EQ(plain.dt, 0.02);
  EXPECT_DOUBLE_EQ(plain.acceleration[3].x(), 0.003);
  double velocity = 0.0;
  for (std::size_t i = 1; i < corrected.acceleration.size(); ++i)
    velocity += 0.01 * (corrected.acceleration[i].x() + corrected.acceleration[i - 1].x());
  EXPECT_NEAR(velocity, 0.0, 1e-15);
  const GroundMotion late = parse_case(head + "begin = 0.04\n", folder / "c.toml").settings.stages[0].motion;
  ASSERT_EQ(late.acceleration.size(), 5u);
  EXPECT_EQ(late.acceleration[0], plain.acceleration[2]);
}

TEST_F(CaseFile, ResolvedCopiesKeepFormatsAndSpectra) {
  folder.write(
      "e.asc",
      "EVENT_NAME: N\nSAMPLING_INTERVAL_S: 0.01\nNDATA: 4\nUNITS: cm/s^2\nDATA_TYPE: ACCELERATION\n1\n2\n-3\n4\n");
  const std::string text =
      "[bridge]\ngenerator = \"column\"\n[[stage]]\nkind = \"motion\"\nduration = 1.0\nrecord = \"e.asc\"\n"
      "[[stage]]\nkind = \"motion\"\nduration = 4.0\nsynthetic = { spectrum = \"ntc2018\", ag = 0.2607, f0 = 2.36, "
      "tc = 0.35, soil = \"D\", axes = [\"x\", \"z\"], seed = 7 }\n";
  const Case c = parse_case(text, folder / "c.toml");
  EXPECT_DOUBLE_EQ(c.settings.stages[0].motion.acceleration[2].x(), -0.03);
  const std::string limit = "[[limit_state]]\nname = \"out\"\ndemand = \"edp.keystone_x\"\nthreshold = 0.02\n";
  EXPECT_EQ(parse_case(text + limit, folder / "c.toml").hash, c.hash);
  const std::string small = "[bridge]\ngenerator = \"column\"\n[[stage]]\nkind = \"gravity\"\n" + limit;
  const Case again = parse_case(resolved_text(parse_case(small, "c.toml")), "c.toml");
  ASSERT_EQ(again.limits.size(), 1u);
  EXPECT_EQ(again.limits[0].demand, "edp.keystone_x");
  EXPECT_EQ(again.limits[0].threshold, 0.02);
  ASSERT_TRUE(c.motions[1].synthetic.spectrum);
  std::filesystem::create_directory(folder / "copy");
  write_resolved_case(c, folder / "copy");
  const Case copy = read_case(folder / "copy/case.toml");
  EXPECT_EQ(copy.hash, c.hash);
  EXPECT_EQ(copy.motions[1].synthetic, c.motions[1].synthetic);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_EQ(copy.settings.stages[i].motion.acceleration, c.settings.stages[i].motion.acceleration);
}

TEST_F(CaseFile, GeometryNeedsNoStage) {
  const std::string text = "[bridge]\ngenerator = \"column\"\n";
  EXPECT_EQ(parse_case(text, "c.toml", CaseUse::geometry).settings.stages.size(), 0u);
  EXPECT_THROW(parse_case(text, "c.toml"), InputError);
}

TEST_F(CaseFile, AssemblyIsMadeAndSensorsFindTheirBlock) {
  const Case c = read_case(folder.write("case.toml", full));
  const Assembly assembly = make_assembly(c);
  EXPECT_EQ(assembly.case_text, full);
  ASSERT_EQ(assembly.sensors.size(), 2u);
  const Box box = block_box(assembly.blocks[std::size_t(assembly.sensors[0].block)]);
  EXPECT_TRUE((Vec3(0.3, 0.0, 0.7).array() >= box.low.array()).all() &&
              (Vec3(0.3, 0.0, 0.7).array() <= box.high.array()).all());
  Assembly again = assembly;
  const std::string message = test::message_of<InputError>([&] {
    attach_sensors(again, {{"far", {0, 5, 0}, {1, 0, 0}}});
  });
  EXPECT_NE(message.find("sensor \"far\""), std::string::npos) << message;
}

TEST_F(CaseFile, AssemblyFileWithJointOverride) {
  const Case wall = read_case(folder.write("case.toml", full));
  write_assembly(folder / "wall.h5", make_assembly(wall));
  const std::string text =
      "[bridge]\nassembly = \"wall.h5\"\n[joints.masonry-masonry]\nkn = 7e9\ntensile_strength = 1.0\n"
      "cohesion = 2.0\nfriction_angle = 20\n[[stage]]\nkind = \"gravity\"\n";
  const Case c = parse_case(text, folder / "c.toml");
  const Assembly assembly = make_assembly(c);
  for (const Joint& joint : assembly.joints) {
    EXPECT_EQ(joint.kn, 7e9);
    EXPECT_EQ(joint.ks, 2e9);
    EXPECT_EQ(assembly.laws[std::size_t(joint.law)].cohesion, 2.0);
  }
  // The run directory's copy of the case and of the assembly give the same again.
  const Folder run;
  write_resolved_case(c, run.path());
  write_assembly(run / "assembly.h5", assembly);
  const Case copy = read_case(run / "case.toml");
  EXPECT_EQ(copy.hash, c.hash);
  EXPECT_EQ(assembly_hash(make_assembly(copy)), assembly_hash(assembly));
}

TEST(Degrees, SurviveWritingAndReading) {
  for (int i = 0; i <= 890; ++i) {
    const double degrees = 0.1 * i, radians = to_radians(degrees);
    EXPECT_EQ(to_radians(std::stod(degrees_text(radians))), radians) << degrees;
  }
  EXPECT_EQ(degrees_text(to_radians(30.0)), "30.0");
  EXPECT_EQ(degrees_text(to_radians(33.3)), "33.3");
  EXPECT_NEAR(writable_angle(0.7), 0.7, 2e-16);
  EXPECT_EQ(writable_angle(writable_angle(0.05)), writable_angle(0.05));
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
