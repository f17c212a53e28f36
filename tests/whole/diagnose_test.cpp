// voussoir hide and diagnose, as a user calls them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include "solver/base/json_file.h"
#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

const std::string bridge = R"([bridge]
generator = "cs2"
abutments = "free"
backfill = "rigid"
block_scale = 3.0
)";

nlohmann::json diagnosis(const std::string& directory) {
  return read_json(directory + "/diagnosis.json");
}

void hide(const Folder& folder, const std::vector<std::string>& more) {
  folder.write("bridge.toml", bridge);
  std::vector<std::string> words = {"hide", "bridge.toml", "-o", "hidden"};
  words.insert(words.end(), more.begin(), more.end());
  const Outcome outcome = voussoir(words, {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
}

TEST(Diagnose, FindsWhatIsHiddenAndWritesACaseThatHasIt) {
  const Folder folder;
  hide(folder, {"--effect", "abutment_restraint both stiffness_share=0.5", "--sensors", "rich", "--seed", "11"});
  const Outcome outcome = voussoir(
      {"diagnose", "bridge.toml", "--measured", "hidden/measured", "-o", "out", "--fits", "5", "--threads", "2"},
      {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("verdict: found"), std::string::npos) << outcome.out;
  const nlohmann::json json = diagnosis(folder / "out");
  EXPECT_EQ(json["verdict"], "found");
  ASSERT_GE(json["effects"].size(), 1u);
  EXPECT_EQ(json["effects"][0]["name"], "abutment_restraint");
  EXPECT_EQ(json["effects"][0]["where"], "both");
  EXPECT_TRUE(json["effects"][0]["parameters"]["stiffness_share"].contains("std"));
  EXPECT_LT(json["gap"]["fit"]["after"].get<double>(), 0.5 * json["gap"]["fit"]["before"].get<double>());
  EXPECT_TRUE(json["gap"]["held_back"].contains("after"));
  EXPECT_FALSE(json["where"].empty());
  double all = 0.0;  // f goes with the root of all stiffness
  for (const auto& part : json["modes"][0]["sensitivity"]) all += part["stiffness"].get<double>();
  EXPECT_NEAR(all, 0.5, 1e-6);
  for (const char* file : {"corrected.toml", "diagnosis.html", "images/sensors.png", "images/residual_before.png",
                           "images/mode_1_after.png"})
    EXPECT_TRUE(exists(folder / ("out/" + std::string(file)))) << file;
  // Its modes before and after can be looked at, unless three.js was missing.
  const Outcome view = voussoir({"view", "out"}, {.folder = folder.path()});
  const bool built = view.err.find("built without three.js") == std::string::npos;
  EXPECT_EQ(view.status == 0, built) << view.err;
  if (built) {
    const std::string page = bytes_of(folder / "out/view.html");
    EXPECT_NE(page.find(fmt::format("\"mode {} before: ", json["modes"][0]["mode"].get<std::string>())),
              std::string::npos);
    EXPECT_NE(page.find(fmt::format("\"mode {} after: {:.3f} s", json["modes"][0]["mode"].get<std::string>(),
                                    json["modes"][0]["after"].get<double>())),
              std::string::npos);
  }
  // The corrected case is a case.
  const Outcome modal =
      voussoir({"modal", "out/corrected.toml", "-n", "3", "--no-pictures"}, {.folder = folder.path()});
  ASSERT_EQ(modal.status, 0) << modal.err;
  EXPECT_NE(modal.out.find("abutment_restraint both"), std::string::npos);
}

/// A plan is judged before anything is measured.
TEST(Diagnose, SaysWhatAPlanWouldShow) {
  const Folder folder;
  hide(folder, {"--sensors", "sparse"});
  const Outcome outcome = voussoir({"diagnose", "bridge.toml", "--plan", "hidden/measured/sensors.csv", "--plan-modes",
                                    "4", "-o", "plan", "--threads", "2"},
                                   {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("least amounts that these data would show"), std::string::npos) << outcome.out;
  EXPECT_NE(outcome.out.find("a sensor at ("), std::string::npos) << outcome.out;
  const nlohmann::json json = read_json(folder / "plan/plan.json");
  EXPECT_EQ(json["modes"].size(), 4u);
  EXPECT_GT(json["detectable"].size(), 20u);
  ASSERT_EQ(json["further"].size(), 6u);
  EXPECT_FALSE(json["further"][0]["sensor"].get<std::string>().empty());
  EXPECT_LT(json["further"][0]["factor"].get<double>(), 1.0);
  EXPECT_TRUE(exists(folder / "plan/plan.html"));
  EXPECT_TRUE(exists(folder / "plan/images/sensors.png"));
  // What a plan is expected to bring means nothing beside what was measured.
  const Outcome both = voussoir({"diagnose", "bridge.toml", "--measured", "hidden/measured", "--plan-modes", "4"},
                                {.folder = folder.path()});
  EXPECT_EQ(both.status, 2);
  EXPECT_NE(both.err.find("--plan-modes"), std::string::npos) << both.err;
  // The suggestion is a row of a plan.
  const nlohmann::json& first = json["further"][0];
  folder.write("more.csv",
               bytes_of(folder / "hidden/measured/sensors.csv") + "B01," + first["sensor"].get<std::string>() + "\n");
  const Outcome more = voussoir({"diagnose", "bridge.toml", "--plan", "more.csv", "--plan-modes", "4", "-o", "more",
                                 "--threads", "2", "--no-page"},
                                {.folder = folder.path()});
  ASSERT_EQ(more.status, 0) << more.err;
  EXPECT_FALSE(exists(folder / "more/plan.html"));
}

/// Blocks 1.25 times as large are more than the generator accepts: the error of the mesh stays unknown, and that is
/// said.
TEST(Diagnose, SaysThatTheErrorOfTheMeshIsUnknown) {
  const Folder folder;
  folder.write("bridge.toml", exchanged(bridge, "block_scale = 3.0", "block_scale = 5.0"));
  folder.write("sensors.csv", "id,x,y,z,direction\nA01,8,-3,16.5,y\n");
  const Outcome outcome = voussoir({"diagnose", "bridge.toml", "--plan", "sensors.csv", "--plan-modes", "2", "-o",
                                    "plan", "--threads", "2", "--no-page"},
                                   {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("block_scale <= 4.8"), std::string::npos) << outcome.out;
}

TEST(Diagnose, WantsMeasurementsOrAPlan) {
  const Folder folder;
  folder.write("bridge.toml", bridge);
  const Outcome neither = voussoir({"diagnose", "bridge.toml"}, {.folder = folder.path()});
  EXPECT_EQ(neither.status, 2);
  EXPECT_NE(neither.err.find("--plan FILE"), std::string::npos) << neither.err;
  const Outcome both =
      voussoir({"diagnose", "bridge.toml", "--measured", "a", "--plan", "b.csv"}, {.folder = folder.path()});
  EXPECT_EQ(both.status, 2);
  EXPECT_NE(both.err.find("Both are given"), std::string::npos) << both.err;
}

/// A deformable fill is in what is measured and in what is compared with it.
TEST(Diagnose, FindsWhatABridgeWithADeformableFillLacks) {
  const Folder folder;
  folder.write("filled.toml",
               "[bridge]\ngenerator = \"cs2\"\nabutments = \"free\"\nbackfill = \"deformable\"\nblock_scale = 3.0\n"
               "fill_edge = 2.0\n");
  const Outcome hidden = voussoir({"hide", "filled.toml", "-o", "hidden", "--effect",
                                   "abutment_restraint both stiffness_share=0.5", "--sensors", "rich", "--seed", "11"},
                                  {.folder = folder.path()});
  ASSERT_EQ(hidden.status, 0) << hidden.err;
  const Outcome outcome = voussoir({"diagnose", "filled.toml", "--measured", "hidden/measured", "-o", "out", "--fits",
                                    "5", "--threads", "2", "--no-page"},
                                   {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json json = diagnosis(folder / "out");
  EXPECT_EQ(json["verdict"], "found") << outcome.out;
  ASSERT_GE(json["effects"].size(), 1u);
  EXPECT_EQ(json["effects"][0]["name"], "abutment_restraint");
  EXPECT_EQ(json["effects"][0]["where"], "both");
  // The fill moves in the shapes that are kept.
  for (const char* file : {"modes_before.pvd", "modes_after.pvd", "modes_before_fill.pvd", "mode_01_after_fill.vtu"})
    EXPECT_TRUE(exists(folder / ("out/vtk/" + std::string(file)))) << file;
  const Outcome view = voussoir({"view", "out", "-o", "view.html"}, {.folder = folder.path()});
  EXPECT_EQ(view.status == 0, view.err.find("built without three.js") == std::string::npos) << view.err;
  double all = 0.0;  // the fill's part is among them
  for (const auto& part : json["modes"][0]["sensitivity"]) all += part["stiffness"].get<double>();
  EXPECT_NEAR(all, 0.5, 1e-6);
}

/// A support that moves otherwise shows only where the ground's motion is known; the explicit solver then follows the
/// recording better with it.
TEST(Diagnose, UnderARecordedMotionFindsTheSupportThatMovesOtherwise) {
  const Folder folder;
  hide(folder,
       {"--effect", "support_motion pier 0 factor=0.3 delay=0", "--sensors", "rich", "--shaken", "60", "--noise",
        "0.005", "--scatter", "0.01", "--materials", "0.02", "--defects", "0", "--mesh", "1", "--seed", "3"});
  const Outcome outcome = voussoir({"diagnose", "bridge.toml", "--measured", "hidden/measured", "-o", "out", "--fits",
                                    "6", "--threads", "2", "--run-seconds", "6"},
                                   {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json json = diagnosis(folder / "out");
  EXPECT_EQ(json["verdict"], "found") << outcome.out;
  ASSERT_GE(json["effects"].size(), 1u);
  EXPECT_EQ(json["effects"][0]["name"], "support_motion") << outcome.out;
  EXPECT_EQ(json["effects"][0]["where"], "pier 0");
  ASSERT_TRUE(json.contains("recorded"));
  EXPECT_LT(json["recorded"]["error"]["after"].get<double>(), json["recorded"]["error"]["before"].get<double>());
  const std::string page = bytes_of(folder / "out/diagnosis.html");
  EXPECT_NE(page.find("Response to the recorded ground motion"), std::string::npos);
  EXPECT_NE(bytes_of(folder / "out/corrected.toml").find("support_motion"), std::string::npos);
}

/// The answer lies beside the measurements here; what the program opens is watched.
TEST(Diagnose, OpensNothingButTheCaseAndTheMeasurements) {
  const Folder folder;
  hide(folder, {"--sensors", "none", "--modes", "3"});
  if (!exists("/usr/bin/strace")) GTEST_SKIP() << "strace is not installed";
  const std::string command =
      std::string("cd '") + folder.path() + "' && strace -f -e trace=open,openat -o trace.txt '" + VOUSSOIR_PROGRAM +
      "' diagnose bridge.toml --measured hidden/measured -o out --no-page --threads 1 > said.txt 2>&1";
  if (std::system(command.c_str()) != 0 && bytes_of(folder / "trace.txt").empty())
    GTEST_SKIP() << "strace cannot trace here: " << bytes_of(folder / "said.txt");
  const std::string trace = bytes_of(folder / "trace.txt");
  ASSERT_NE(trace.find("hidden/measured/modes.csv"), std::string::npos) << trace;
  EXPECT_EQ(trace.find("answer"), std::string::npos);
  std::size_t opened = 0;
  for (std::size_t at = trace.find('"'); at != std::string::npos; at = trace.find('"', at + 1)) {
    const std::size_t end = trace.find('"', at + 1);
    const std::string name = trace.substr(at + 1, end - at - 1);
    at = end;
    const bool system = name.starts_with("/etc/") || name.starts_with("/lib/") || name.starts_with("/usr/") ||
                        name.starts_with("/proc/") || name.starts_with("/sys/") || name.starts_with("/dev/") ||
                        name.starts_with("/lib64/") || name.ends_with(".so") || name.find(".so.") != std::string::npos;
    const bool own = name == "bridge.toml" || name.starts_with("hidden/measured") || name.starts_with("out") ||
                     name.find("/out/") != std::string::npos;
    EXPECT_TRUE(system || own) << name;
    opened += own;
  }
  EXPECT_GE(opened, 3u);
}

TEST(Diagnose, OfRecordingsIdentifiesTheModesFirst) {
  const Folder folder;
  hide(folder, {"--sensors", "sparse", "--minutes", "8", "--modes", "4", "--seed", "5"});
  EXPECT_FALSE(exists(folder / "hidden/measured/modes.csv"));
  const Outcome outcome =
      voussoir({"diagnose", "bridge.toml", "--measured", "hidden/measured", "-o", "out", "--no-page", "--fits", "4"},
               {.folder = folder.path()});
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  const nlohmann::json json = diagnosis(folder / "out");
  EXPECT_GE(json["modes"].size(), 4u);
  for (const char* part : {"frequency-domain decomposition", "periods of the lowest mode"})
    EXPECT_NE(outcome.out.find(part), std::string::npos) << outcome.out;
  for (const nlohmann::json& mode : json["modes"])
    EXPECT_NEAR(mode["frequency"]["measured"].get<double>() * mode["measured"].get<double>(), 1.0, 1e-12);
}

TEST(Diagnose, SaysWhatIsWrongWithItsInput) {
  const Folder folder;
  hide(folder, {"--sensors", "sparse"});
  const auto run = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {"diagnose", "bridge.toml", "-o", "out", "--no-page"};
    words.insert(words.end(), more.begin(), more.end());
    return voussoir(words, {.folder = folder.path()});
  };
  expect_error(run({"--measured", "nowhere"}), 2, {"nowhere", "no such folder"});
  expect_error(run({"--measured", "hidden/measured", "--hold-back", "17"}), 2, {"--hold-back", "17"});
  expect_error(run({"--measured", "hidden/measured", "--without", "scor"}), 2, {"'scor'", "scour"});
  const std::string sensors = bytes_of(folder / "hidden/measured/sensors.csv");
  const std::size_t second = sensors.find('\n') + 1;
  set_bytes(folder / "hidden/measured/sensors.csv",
            sensors.substr(0, second) + "far,500,0,0,x\n" + sensors.substr(second));
  expect_error(run({"--measured", "hidden/measured"}), 2, {"sensors.csv:2", "'far'", "0.5 m"});
  set_bytes(folder / "hidden/measured/sensors.csv", sensors);
  set_bytes(folder / "hidden/measured/modes.csv", "mode,period\n1,-0.3\n");
  expect_error(run({"--measured", "hidden/measured"}), 2, {"modes.csv:2", "-0.3"});
}

/// Results beside the case: the corrected case has its assembly, and the files of the user stay as they are.
TEST(Diagnose, KeepsTheFilesOfTheUser) {
  const Folder folder;
  hide(folder, {"--sensors", "rich", "--seed", "3"});
  ASSERT_EQ(voussoir({"generate", "bridge.toml", "-o", "bridge.h5"}, {.folder = folder.path()}).status, 0);
  const std::string text = "[bridge]\nassembly = \"bridge.h5\"\n";
  folder.write("case.toml", text);
  const auto run = [&] {
    return voussoir({"diagnose", "case.toml", "--measured", "hidden/measured", "-o", ".", "--fits", "1", "--no-page",
                     "--no-least-amounts", "--threads", "2"},
                    {.folder = folder.path()});
  };
  folder.write("assembly.h5", "of another bridge");
  expect_error(run(), 2, {"assembly.h5 exists and is not a copy", "-o"});
  EXPECT_EQ(bytes_of(folder / "assembly.h5"), "of another bridge");
  std::filesystem::remove(folder / "assembly.h5");
  const Outcome outcome = run();
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_EQ(bytes_of(folder / "case.toml"), text);
  EXPECT_EQ(bytes_of(folder / "assembly.h5"), bytes_of(folder / "bridge.h5"));
  EXPECT_FALSE(exists(folder / "corrected.new"));
  const Outcome modal = voussoir({"modal", "corrected.toml", "-n", "1", "--no-pictures"}, {.folder = folder.path()});
  EXPECT_EQ(modal.status, 0) << modal.err;
  // Another diagnosis in the same folder replaces its own copies.
  folder.write("assembly.h5", "of an earlier diagnosis");
  ASSERT_EQ(run().status, 0);
  EXPECT_EQ(bytes_of(folder / "assembly.h5"), bytes_of(folder / "bridge.h5"));
}

TEST(Hide, SaysWhatIsWrongWithItsInput) {
  const Folder folder;
  folder.write("bridge.toml", bridge);
  const auto run = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {"hide", "bridge.toml", "-o", "out"};
    words.insert(words.end(), more.begin(), more.end());
    return voussoir(words, {.folder = folder.path()});
  };
  expect_error(run({"--effect", "scor"}), 2, {"'scor'", "scour"});
  expect_error(run({"--effect", "scour pier 7 x-"}), 2, {"pier 7 x-", "pier 0 x-"});
  expect_error(run({"--effect", "scour pier 0 x- lost_share=much"}), 2, {"lost_share=much"});
  expect_error(run({"--effect", "scour pier 0 x- lost_share=0,4"}), 2, {"lost_share=0,4", "PARAMETER=NUMBER"});
  expect_error(run({"--effect", "support_motion pier 0 factor=0.5"}), 2, {"support_motion", "--shaken"});
  expect_error(run({"--effect", "sensor_fault channel A01y delay=0.01"}), 2, {"late clock", "--minutes"});
  expect_error(run({"--trace", "--minutes", "2"}), 2, {"--trace"});
  expect_error(run({"--sensors", "some"}), 2, {"some", "sparse"});
  expect_error(run({"--sensors", "41"}), 2, {"41", "5 to 40"});
  expect_error(run({"--sensors", "none.csv"}), 2, {"none.csv", "no such file"});
  expect_error(run({"--truth", "backfil=none"}), 2, {"backfil", "'backfill'"});
  expect_error(run({"--truth", "backfill"}), 2, {"KEY=VALUE"});
  expect_error(run({"--loosen", "x=1..2"}), 2, {"changes nothing"});
  expect_error(run({"--parapet-gaps", "2"}), 2, {"no parapet"});
  expect_error(run({"--noise-said", "0.5", "--minutes", "2"}), 2, {"--noise-said"});
  EXPECT_FALSE(exists(folder / "out/measured"));
}

TEST(Hide, KeepsTheBlocksOfAnAssemblyFile) {
  const Folder folder;
  folder.write("bridge.toml", bridge);
  ASSERT_EQ(voussoir({"generate", "bridge.toml", "-o", "bridge.h5"}, {.folder = folder.path()}).status, 0);
  folder.write("import.toml", "[bridge]\nassembly = \"bridge.h5\"\n");
  const auto run = [&](std::vector<std::string> more) {
    std::vector<std::string> words = {"hide", "import.toml", "-o", "hidden"};
    words.insert(words.end(), more.begin(), more.end());
    return voussoir(words, {.folder = folder.path()});
  };
  expect_error(run({"--mesh", "0.8"}), 2, {"--mesh", "assembly file"});
  expect_error(run({"--truth", "width=8"}), 2, {"--truth", "generator"});
  ASSERT_EQ(run({"--effect", "joint_softening pier 0 factor=0.3"}).status, 0);
  const std::string answer = bytes_of(folder / "hidden/answer.toml");
  EXPECT_NE(answer.find("mesh = 1\n"), std::string::npos) << answer;
  EXPECT_NE(answer.find("defects = 0\n"), std::string::npos) << answer;
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
