// Messages of the case reader: each names file, line and key, what was found and what is right.
#include <gtest/gtest.h>

#include "io/case/case.h"
#include "io/toml/table_reader.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

/// A case text, and what the message must hold.
struct Wrong {
  const char* name;
  std::string text;
  std::vector<std::string> expected;
};

const std::string head = "[bridge]\ngenerator = \"wall\"\n";  // lines 1 and 2
const std::string composite =
    "[joints.masonry-masonry]\nkind = \"composite\"\nfracture_energy = [20, 80]\n";  // three lines
const std::string gravity = "[[stage]]\nkind = \"gravity\"\n";                       // two lines
const std::string motion = "[[stage]]\nkind = \"motion\"\nduration = 2.0\n";         // three lines

const std::string pulse =  // one line
    "pulse = { kind = \"sine\", axis = \"x\", amplitude = 1.0, frequency = 2.0 }\n";
const std::string free_stage = "[[stage]]\nkind = \"free\"\nduration = 2.0\n";  // three lines

std::string repeated(const std::string& text, int times) {
  std::string all;
  for (int i = 0; i < times; ++i) all += text;
  return all;
}

const std::vector<Wrong> table = {
    {"LoadOfWhat",
     head + gravity + "load = [{ force = [0, 0, 1] }]\n",
     {"c.toml:5:", "one of 'acceleration'", "'group' with 'force'", "'road' with 'pressure'"}},
    {"LoadWithoutForce", head + gravity + "load = [{ group = \"top\" }]\n", {"c.toml:5:", "needs 'force'", "in N"}},
    {"LoadUnit", head + gravity + "load = [{ acceleration = [0, 0, 98100] }]\n", {"c.toml:5: 'load'", "unit"}},
    {"CollapseWithoutPattern", head + "[[stage]]\nkind = \"collapse\"\n", {"c.toml:3:", "needs 'load'", "'tilt'"}},
    {"CollapseWithTwoPatterns",
     head + "[[stage]]\nkind = \"collapse\"\ntilt = [0, 1, 0]\nload = [{ acceleration = [1, 0, 0] }]\n",
     {"c.toml:5: 'tilt'", "both given"}},
    {"CollapseTiltNowhere",
     head + "[[stage]]\nkind = \"collapse\"\ntilt = [0, 0, 0]\n",
     {"c.toml:5: 'tilt'", "no direction"}},
    {"CollapseTolerance",
     head + "[[stage]]\nkind = \"collapse\"\ntilt = [0, 1, 0]\nto = 2\ntolerance = 1.0\n",
     {"c.toml:7: 'tolerance'", "from 2e-06 to 0.5"}},
    {"CollapseNotLast",
     head + "[[stage]]\nkind = \"collapse\"\ntilt = [0, 1, 0]\n" + gravity,
     {"c.toml:4: 'kind'", "must be the last"}},
    {"CollapseDuration",
     head + "[[stage]]\nkind = \"collapse\"\ntilt = [0, 1, 0]\nduration = 3\n",
     {"c.toml:6: 'duration'", "takes no simulated time"}},
    {"CollapseKeyElsewhere",
     head + gravity + "tilt = [0, 1, 0]\n",
     {"c.toml:5: 'tilt'", "is only for a collapse stage"}},
    {"PlaceWithoutAxis",
     head + free_stage + "place = [{ group = \"top\", angle = 5 }]\n",
     {"c.toml:6:", "needs 'through'", "in m"}},
    {"PlaceAxisNowhere",
     head + free_stage + "place = [{ group = \"top\", axis = [0, 0, 0] }]\n",
     {"c.toml:6: 'axis'", "no direction"}},
    {"PlaceUnderGravity", head + gravity + "place = [{ group = \"top\" }]\n", {"c.toml:5: 'place'", "free or motion"}},
    {"GuideWithoutGroup", head + "[[guide]]\nfree = [\"z\"]\n" + gravity, {"c.toml:3:", "needs 'group'"}},
    {"GuideNowhere",
     head + "[[guide]]\ngroup = \"base\"\n" + gravity,
     {"c.toml:3:", "needs 'free'", "or 'turn' = true"}},
    {"GuideAlongNoAxis",
     head + "[[guide]]\ngroup = \"base\"\nfree = [\"z\", \"up\"]\n" + gravity,
     {"c.toml:5: 'free'", "contains \"up\"", "\"x\", \"y\" or \"z\""}},
    {"GuideTwice",
     head + "[[guide]]\ngroup = \"base\"\nfree = \"z\"\n[[guide]]\ngroup = \"base\"\nfree = \"x\"\n" + gravity,
     {"c.toml:7: 'group'", "which another [[guide]] has"}},
    {"PlotWithoutChannel", head + gravity + "[[plot]]\nname = \"a\"\n", {"c.toml:5:", "needs 'y'"}},
    {"PlotNameIsAPath",
     head + gravity + "[[plot]]\nname = \"../a\"\ny = \"contacts\"\n",
     {"c.toml:6: 'name'", "letters, digits"}},
    {"PlotTwice",
     head + gravity + "[[plot]]\nname = \"a\"\ny = \"contacts\"\n[[plot]]\nname = \"a\"\ny = \"contacts\"\n",
     {"c.toml:9: 'name'", "which another plot has"}},
    {"DriveWithoutWay",
     head + free_stage + "drive = [{ group = \"base\" }]\n",
     {"c.toml:6:", "needs 'displacement'", "or 'velocity'"}},
    {"DriveWithTwoWays",
     head + free_stage + "drive = [{ group = \"base\", velocity = [0, 0, 1], displacement = [0, 0, 1] }]\n",
     {"c.toml:6: 'velocity'", "'displacement' are both given"}},
    {"DriveTooFast",
     head + free_stage + "drive = [{ group = \"base\", velocity = [0, 0, 11] }]\n",
     {"c.toml:6: 'velocity'", "above 10 m/s", "unit"}},
    {"DriveTooFar",
     head + free_stage + "drive = [{ group = \"base\", displacement = [0, 0, 21] }]\n",
     {"c.toml:6: 'displacement'", "10 m/s", "unit"}},
    {"DriveNotFinite",
     head + free_stage + "drive = [{ group = \"base\", displacement = [0, 0, nan] }]\n",
     {"c.toml:6: 'displacement'", "finite"}},
    {"DriveFactorWithoutMotion",
     head + free_stage + "drive = [{ group = \"base\", factor = 0.5 }]\n",
     {"c.toml:6: 'factor'", "this stage has none", "kind = \"motion\" or remove it"}},
    {"DriveDelayWithoutMotion",
     head + free_stage + "drive = [{ group = \"base\", velocity = [0, 0, 1], delay = 0.5 }]\n",
     {"c.toml:6: 'delay'", "this stage has none"}},
    {"DriveFactorRange",
     head + motion + pulse + "drive = [{ group = \"base\", factor = 11 }]\n",
     {"c.toml:7: 'factor'", "from -10 to 10"}},
    {"DriveDelayRange",
     head + motion + pulse + "drive = [{ group = \"base\", delay = -50.0 }]\n",
     {"c.toml:7: 'delay'", "from -10 to 10", "s"}},
    {"DriveWithoutWayInAMotion",
     head + motion + pulse + "drive = [{ group = \"base\" }]\n",
     {"c.toml:7:", "needs 'displacement'", "'factor' or 'delay'"}},
    {"DriveUnderGravity",
     head + gravity + "drive = [{ group = \"base\", velocity = [0, 0, 1] }]\n",
     {"c.toml:5: 'drive'", "takes no time"}},
    {"UnknownKey",
     head + "[damping]\nrtaio = 0.1\n",
     {"c.toml:4: unknown key 'rtaio' in [damping]: did you mean 'ratio'?"}},
    {"UnknownKeyListed",
     head + "[damping]\ncolour = 1\n",
     {"c.toml:4: unknown key 'colour' in [damping]: no key of this table has a similar name",
      "keys of [damping]:", "\n  key          default    expected", "\n  branches     ", "a whole number from 1 to 4",
      "\n  kind         \"maxwell\"  one of: none, maxwell, rayleigh, local"}},
    {"AllUnknownKeysAtOnce",
     head + "corses = 3\n[materials.masonry]\ndensty = 2000\n[damping]\nrtaio = 0.1\n" + free_stage +
         "labell = \"a\"\n[[stage]]\nkind = \"free\"\nduratoin = 1.0\n[[sensor]]\nname = \"a\"\n[output]\nevery = 1\n",
     {"c.toml: 6 unknown keys\n", "c.toml:3: unknown key 'corses' in [bridge]: did you mean 'courses'?",
      "c.toml:5: unknown key 'densty' in [materials.masonry]: did you mean 'density'?",
      "c.toml:7: unknown key 'rtaio' in [damping]: did you mean 'ratio'?",
      "c.toml:11: unknown key 'labell' in [[stage]] number 1: did you mean 'label'?",
      "c.toml:14: unknown key 'duratoin' in [[stage]] number 2: did you mean 'duration'?",
      "c.toml:18: unknown key 'every' in [output]: no key", "keys of [output]"}},
    {"UnknownKeysBesideAnotherError",
     head + "[damping]\nrtaio = 0.1\nbranches = 9\n" + gravity + "methd = \"newton\"\n",
     {"c.toml:5: 'branches' in [damping] is 9", "c.toml:8: unknown key 'methd'", "did you mean 'method'?"}},
    {"UnknownTable",
     head + "[dampin]\nratio = 0.1\n" + gravity,
     {"c.toml:3: unknown key 'dampin'", "did you mean 'damping'?"}},
    {"UnknownBridgeKey",
     head + "corses = 3\n" + gravity,
     {"c.toml:3: unknown key 'corses' in [bridge]: did you mean 'courses'?"}},
    {"WrongType",
     head + "[damping]\nratio = \"high\"\n",
     {"c.toml:4: 'ratio' in [damping] is text. It must be a number."}},
    {"WrongTypeUnit",
     head + "[output]\nhistory_every = true\n",
     {"c.toml:4: 'history_every'", "is true or false. It must be a number in s."}},
    {"NotFlag",
     head + "[contact]\nsearch = 1\n",
     {"c.toml:4: 'search' in [contact] is a number. It must be true or false."}},
    {"NotInteger",
     head + "[contact]\npoints_per_side = 3.5\n",
     {"'points_per_side'", "is a fraction. It must be a whole number."}},
    {"NotTable", "bridge = 3\n", {"c.toml:1: 'bridge'", "is a number. It must be a table."}},
    {"StageNotDoubleBrackets", head + "[stage]\nkind = \"gravity\"\n", {"c.toml:3: 'stage'", "[[stage]]"}},
    {"OutOfRange",
     head + "[damping]\nratio = 0.7\n",
     {"c.toml:4: 'ratio' in [damping] is 0.7. It must be from 0 to 0.5."}},
    {"OutOfRangeUnit",
     head + "thickness = -0.4\n" + gravity,
     {"c.toml:3: 'thickness' in [bridge] is -0.4. It must be from 0.001 to 20 m."}},
    {"GeneratorWhole", head + "courses = 2.5\n" + gravity, {"c.toml:3: 'courses'", "must be a whole number"}},
    {"NotFinite", head + "[damping]\nratio = nan\n", {"c.toml:4: 'ratio'", "must be a finite number"}},
    {"NotFiniteList",
     head + "[damping]\nband = [1.0, inf]\n",
     {"c.toml:4: 'band'", "is inf. It must be a finite number."}},
    {"Band",
     head + "[damping]\nband = [12, 0.5]\n",
     {"c.toml:4: 'band'", "[12, 0.5]", "first frequency must be the lower"}},
    {"BandLength", head + "[damping]\nband = [12]\n", {"c.toml:4: 'band'", "has 1 number. It must have 2."}},
    {"Syntax", head + "[damping\nratio = 1\n", {"c.toml:3: not valid TOML: "}},
    {"Twice", head + "generator = \"wall\"\n", {"c.toml:3: not valid TOML: "}},
    {"UnknownGenerator",
     "[bridge]\ngenerator = \"wal\"\n",
     {"c.toml:2: 'generator' in [bridge] is \"wal\": did you mean 'wall'?"}},
    {"UnknownGeneratorListed",
     "[bridge]\ngenerator = \"viaduct\"\n",
     {"c.toml:2: ", "expected one of: ", "cs1", "column"}},
    {"NoBridge", gravity, {"c.toml", "needs 'bridge'"}},
    {"NoGenerator", "[bridge]\n", {"c.toml:1: [bridge] needs 'generator'"}},
    {"GeneratorMisspelt",
     "[bridge]\ngenerater = \"wall\"\n",
     {"c.toml:2: unknown key 'generater'", "did you mean 'generator'?"}},
    {"GeneratorAndAssembly",
     head + "assembly = \"a.h5\"\n",
     {"c.toml:1: [bridge] has both 'generator' and 'assembly'"}},
    {"NoAssemblyFile",
     "[bridge]\nassembly = \"none.h5\"\n",
     {"c.toml:2: 'assembly'", "none.h5, but there is no such file"}},
    {"UnknownMaterial",
     head + "[materials.mansonry]\ndensity = 1\n" + gravity,
     {"c.toml:3: 'mansonry' in [materials] is not a material of \"wall\": did you mean 'masonry'?"}},
    {"MaterialKey",
     head + "[materials.masonry]\nfrction_angle = 30\n" + gravity,
     {"c.toml:4: unknown key 'frction_angle' in [materials.masonry]: did you mean 'friction_angle'?"}},
    {"Angle",
     head + "[materials.masonry]\nfriction_angle = 95\n" + gravity,
     {"c.toml:4: 'friction_angle'", "from 0 to 89 degrees"}},
    {"JointPair",
     head + "[joints.masonry]\nkn = 1e9\n" + gravity,
     {"c.toml:3: 'masonry' in [joints]", "with a hyphen between"}},
    {"JointMaterial",
     head + "[joints.masonry-steel]\nkn = 1e9\n" + gravity,
     {"c.toml:3: 'masonry-steel'", "two materials of this bridge"}},
    {"JointStiffness",
     head + "[joints.masonry-masonry]\nkn = 0\n" + gravity,
     {"c.toml:4: 'kn'", "is 0. It must be above 0 and at most"}},
    {"JointKind",
     head + "[joints.masonry-masonry]\nkind = \"plastic\"\n" + gravity,
     {"c.toml:4: 'kind'", "is \"plastic\": did you mean \"elastic\"? expected one of: brittle, softening, elastic"}},
    {"SofteningEnergy",
     head + "[joints.masonry-masonry]\nkind = \"softening\"\n" + gravity,
     {"c.toml:3: ", "needs 'fracture_energy'"}},
    {"CompositeEnergy",
     head + "[joints.masonry-masonry]\nkind = \"composite\"\ntensile_strength = 1e5\n" + gravity,
     {"c.toml:3: ", "needs 'fracture_energy'", "have a bond"}},
    {"CompositeKeyOfAnother",
     head + "[joints.masonry-masonry]\ncompressive_strength = 1e7\n" + gravity,
     {"c.toml:4: 'compressive_strength'", "kind = \"composite\""}},
    {"CrushingWithoutEnergy",
     head + composite + "compressive_strength = 1e7\n" + gravity,
     {"c.toml:3: ", "needs 'compressive_energy'"}},
    {"CrushingWithoutStrength",
     head + composite + "compressive_energy = 1e4\n" + gravity,
     {"c.toml:6: 'compressive_energy'", "needs 'compressive_strength'"}},
    {"CrushingOfNoStrength",
     head + composite + "compressive_strength = 0\ncompressive_energy = 1e4\n" + gravity,
     {"c.toml:6: 'compressive_strength'", "is 0. It must be above 0 and at most"}},
    {"CapBelowTension",
     head + composite + "tensile_strength = 4e5\ncompressive_strength = 1e6\ncompressive_energy = 1e4\n" + gravity,
     {"c.toml:7: 'compressive_strength'", "a third of it, 333333 Pa, which is below the tensile strength",
      "Raise it to at least 1.2e+06 Pa"}},
    {"DilationBeyondFriction",
     head + composite + "friction_angle = 30\ndilation_angle = 31\n" + gravity,
     {"c.toml:7: 'dilation_angle'", "is 31.0 degrees", "the friction angle, 30.0 degrees",
      "the residual friction angle, 30.0 degrees"}},
    {"DampingKind",
     head + "[damping]\nkind = \"viscous\"\n",
     {"c.toml:4: 'kind'", "expected one of: none, maxwell, rayleigh, local"}},
    {"MassScaling",
     head + "[analysis]\nmass_scaling_step = 1e-4\n",
     {"c.toml:3: [analysis] needs 'mass_scaling_limit'"}},
    {"NoStages", head, {"c.toml", "needs 'stage'"}},
    {"StageMisspelt",
     head + "[[stages]]\nkind = \"gravity\"\n",
     {"c.toml:3: unknown key 'stages'", "did you mean 'stage'?"}},
    {"EmptyStages", "stage = []\n" + head, {"needs 'stage'"}},
    {"EmptyStage", head + "[[stage]]\n", {"c.toml:3: [[stage]] number 1 needs 'kind'", "gravity, motion, free"}},
    {"StageKind",
     head + "[[stage]]\nkind = \"static\"\n",
     {"c.toml:4: 'kind'", "expected one of: gravity, motion, free"}},
    {"StageKindMisspelt",
     head + "[[stage]]\nkind = \"gravty\"\n",
     {"c.toml:4: 'kind'", "is \"gravty\": did you mean \"gravity\"? expected one of: gravity, motion, free"}},
    {"MotionDuration",
     head + "[[stage]]\nkind = \"motion\"\n",
     {"c.toml:3: [[stage]] number 1 needs 'duration' (a number in s)"}},
    {"DurationMisspelt",
     head + "[[stage]]\nkind = \"free\"\nduratoin = 1\n",
     {"c.toml:5: unknown key 'duratoin'", "did you mean 'duration'?"}},
    {"NegativeDuration",
     head + "[[stage]]\nkind = \"free\"\nduration = -1\n",
     {"c.toml:5: 'duration'", "is -1. It must be above 0 and at most"}},
    {"GravityDuration", head + gravity + "duration = 1\n", {"c.toml:5: 'duration'", "ends in equilibrium. Remove it."}},
    {"GravityRecord", head + gravity + "record = \"a\"\n", {"c.toml:5: 'record'", "is only for a motion stage"}},
    {"FreeMethod",
     head + "[[stage]]\nkind = \"free\"\nduration = 1\nmethod = \"newton\"\n",
     {"c.toml:6: 'method'", "is only for a gravity or quasi-static stage"}},
    {"NoSource", head + motion, {"c.toml:3: [[stage]] number 1 needs 'record'"}},
    {"RecordAndPulse",
     head + motion + "record = \"a\"\npulse = { kind = \"sine\" }\n",
     {"c.toml:3: ", "more than one of 'record', 'pulse'"}},
    {"NoRecord",
     head + motion + "record = \"nothere.txt\"\n",
     {"c.toml:6: 'record'", "nothere.txt\", but there is no such file"}},
    {"RecordNames", head + motion + "record = [\"\", \"\"]\n", {"c.toml:6: 'record'", "has no file name"}},
    {"FourRecords", head + motion + "record = [\"a\", \"b\", \"c\", \"d\"]\n", {"c.toml:6: 'record'", "has 4 files"}},
    {"RecordUnits",
     head + motion + "record = \"good.txt\"\nunits = \"gal\"\n",
     {"c.toml:7: 'units'", "expected one of: m/s2, g, cm/s2"}},
    {"RecordBegin",
     head + motion + "record = \"good.txt\"\nbegin = 9.0\n",
     {"good.txt: the record ends at", "'begin' is 9 s"}},
    {"RecordRow", head + motion + "record = \"bad.txt\"\n", {"bad.txt:3: 'oops' is not a number"}},
    {"PulseUnits",
     head + motion + "units = \"g\"\npulse = { kind = \"sine\" }\n",
     {"c.toml:6: 'units'", "is only for a 'record'"}},
    {"PulseKind",
     head + motion + "pulse = { kind = \"square\", axis = \"x\" }\n",
     {"c.toml:6: 'kind' in the pulse of [[stage]] number 1", "rectangular, half-sine, sine"}},
    {"PulseAmplitude",
     head + motion + "pulse = { kind = \"sine\", axis = \"x\" }\n",
     {"c.toml:6: ", "needs 'amplitude' (a number in m/s2)"}},
    {"PulseLength",
     head + motion + "pulse = { kind = \"rectangular\", axis = \"x\", amplitude = 1 }\n",
     {"c.toml:3: ", "rectangular pulse needs 'length' in s"}},
    {"PulseWithoutEnd",
     head + motion + "pulse = { kind = \"sine\", axis = \"x\", amplitude = 1, frequency = 1e-320 }\n",
     {"c.toml:3: ", "needs more than 50 million samples"}},
    {"PulseBoth",
     head + motion + "pulse = { kind = \"half-sine\", axis = \"x\", amplitude = 1, frequency = 2, length = 1 }\n",
     {"c.toml:3: ", "contradict", "0.25 s"}},
    {"LimitDemand",
     head + "[[stage]]\nkind = \"gravity\"\n[[limit_state]]\nname = \"a\"\ndemand = \"keystone\"\nthreshold = 1\n",
     {"c.toml:7: 'demand'", "such as \"edp.keystone_x\""}},
    {"SyntheticBoth",
     head + motion + "synthetic = { peak = 1, spectrum = \"ntc2018\", ag = 0.2, f0 = 2.4, tc = 0.3, soil = \"A\" }\n",
     {"c.toml:6: 'peak'", "Keep one"}},
    {"SyntheticSoil",
     head + motion + "synthetic = { peak = 1, soil = \"A\" }\n",
     {"c.toml:6: 'soil'", "needs a 'spectrum'"}},
    {"SyntheticCode",
     head + motion + "synthetic = { spectrum = \"ntc2008\", ag = 0.2 }\n",
     {"c.toml:6: 'spectrum'", "expected one of: ntc2018"}},
    {"SyntheticPeak", head + motion + "synthetic = { seed = 1 }\n", {"c.toml:6: ", "needs 'peak'"}},
    {"SyntheticAxes",
     head + motion + "synthetic = { peak = 1, axes = [\"w\"] }\n",
     {"c.toml:6: 'axes'", "\"w\". It must be a list of x, y and z."}},
    {"SensorTwice",
     head + gravity + "[[sensor]]\nid=\"a\"\nposition=[0,0,0]\ndirection=\"x\"\n[[sensor]]\nid=\"a\"\n",
     {"c.toml:10: 'id' in [[sensor]] number 2 is \"a\"", "needs its own id"}},
    {"SensorDirection",
     head + gravity + "[[sensor]]\nid=\"a\"\nposition=[0,0,0]\ndirection=[0,0,0]\n",
     {"c.toml:8: 'direction'", "is zero"}},
    {"SensorPosition",
     head + gravity + "[[sensor]]\nid=\"a\"\nposition=[0,0]\n",
     {"c.toml:7: 'position'", "has 2 numbers. It must have 3."}},
    {"PlaceFarAway",
     head + free_stage + "place = [{ group = \"top\", angle = 5, through = [0, 0, -1e308] }]\n",
     {"c.toml:6: 'through'", "-1e+308", "from -10000000 to 10000000 m"}},
    {"PlaceMovedFarAway",
     head + free_stage + "place = [{ group = \"top\", move = [1e9, 0, 0] }]\n",
     {"c.toml:6: 'move'", "from -10000000 to 10000000 m"}},
    {"SensorFarAway",
     head + gravity + "[[sensor]]\nid=\"a\"\nposition=[0,0,1e200]\n",
     {"c.toml:7: 'position'", "from -10000000 to 10000000 m"}},
    {"ForceTooLarge",
     head + gravity + "load = [{ group = \"top\", force = [0, 0, 1e300] }]\n",
     {"c.toml:5: 'force'", "1e+300"}},
    {"StepsWithoutEnd",
     head + "[analysis]\ntime_step = 1e-15\n" + free_stage,
     {"c.toml:4: 'time_step'", "2 s of simulated time would need 2e+15 time steps", "63.4 years", "At most 1e+11"}},
    {"CheckpointsWithoutEnd",
     head + "[output]\ncheckpoint_every = 1e-9\n" + free_stage,
     {"c.toml:4: 'checkpoint_every'", "2e+09 checkpoints", "at most 100000"}},
    {"FramesWithoutEnd",
     head + "[output]\nfields_every = 1e-12\n" + free_stage,
     {"c.toml:4: 'fields_every'", "2e+12 stored frames", "at most 100000"}},
    {"DottedKey", head + "x" + repeated(".x", 100000) + " = 1\n" + gravity, {"c.toml:3: a key has more than 32 parts"}},
    {"DottedHeading", head + "[x" + repeated(".\"y.z\"", 100000) + "]\n", {"c.toml:3: a key has more than 32 parts"}},
    {"BracketsInBrackets",
     head + "x = " + repeated("[", 100000) + repeated("]", 100000) + "\n",
     {"c.toml:3: brackets are nested 33 deep"}},
    {"LongAssembly",
     "[bridge]\nassembly = \"" + std::string(100000, 'w') + "\"\n",
     {"c.toml:2: ", "there is no such file"}},
    {"LongRecord",
     head + motion + "record = \"" + std::string(100000, 'w') + "\"\n",
     {"c.toml:6: ", "there is no such file"}},
    {"LongKey", head + std::string(2000000, 'k') + " = 1\n" + gravity, {"c.toml:3: ", "kkk", "(2000000 bytes)"}},
    {"LongWord", "[bridge]\ngenerator = \"" + std::string(2000000, 'w') + "\"\n", {"c.toml:2: ", "(2000000 bytes)"}},
    {"LongKind",
     head + "[[stage]]\nkind = \"" + std::string(2000000, 'w') + "\"\n",
     {"c.toml:4: ", "(2000000 bytes)", "expected one of: gravity"}},
};

class CaseError : public testing::TestWithParam<Wrong> {};

TEST_P(CaseError, SaysWhatIsWrongAndWhatIsRight) {
  const test::Folder folder;
  folder.write("good.txt", "0 0\n0.01 1\n0.02 0\n");
  folder.write("other.txt", "0 0\n0.02 1\n0.04 0\n");
  folder.write("bad.txt", "0 0\n0.01 1\n0.02 oops\n");
  const std::string path = folder.write("c.toml", GetParam().text);
  const std::string message = test::message_of<InputError>([&] { read_case(path); });
  EXPECT_TRUE(message.starts_with(folder.path())) << message;
  for (const std::string& part : GetParam().expected) EXPECT_NE(message.find(part), std::string::npos) << message;
  EXPECT_LT(message.size(), 2000u) << message.substr(0, 300);
}

TEST(CaseErrors, DotsInTextsCommentsAndListsOfNumbersAreNoNesting) {
  std::string numbers = "0.5", text = "...", more = "[[[";
  for (int i = 0; i < 100; ++i) numbers += ", 0.5", text += "...[[[{{{", more += "{{{[[[";
  const test::Folder folder;
  const std::string path = folder.path() + "/c.toml";
  const toml::table read =
      parse_toml("a = [" + numbers + "]\n# " + text + "\nb = \"" + text + "\\\"" + more + "\"\nc = '''" + text + "\n'" +
                     more + "'''\nd = \"\"\"" + text + "\n\"" + more + "\"\"\"\n",
                 path);
  EXPECT_EQ(read.size(), 4u);
  EXPECT_EQ(read["a"].as_array()->size(), 101u);
}

INSTANTIATE_TEST_SUITE_P(Messages, CaseError, testing::ValuesIn(table),
                         [](const auto& wrong) { return std::string(wrong.param.name); });

TEST(CaseErrors, MissingFileAndFolder) {
  const test::Folder folder;
  EXPECT_NE(test::message_of<InputError>([&] { read_case(folder / "none.toml"); }).find("none.toml: No such file"),
            std::string::npos);
  EXPECT_NE(test::message_of<InputError>([&] { read_case(folder.path()); }).find("it is a folder"), std::string::npos);
}

TEST(Suggestion, NearestWordOrList) {
  const std::vector<std::string> known = {"ratio", "band", "kind"};
  EXPECT_EQ(nearest_word("rato", known), "ratio");
  EXPECT_EQ(nearest_word("ratoi", known), "ratio");  // a swap is one mistake
  EXPECT_EQ(nearest_word("temperature", known), "");
  EXPECT_EQ(suggestion("x", known), ": expected one of: ratio, band, kind");
  EXPECT_EQ(nearest_word(std::string(2000000, 'r'), known), "");  // not compared letter by letter
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
