// A deformable fill that is run: what is left of it in files and pictures.
#include <gtest/gtest.h>

#include <filesystem>

#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// Two tetrahedra on the upper face of the unit cube.
const std::string heap =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n5\n1 0.2 0.2 1\n2 0.8 0.2 1\n3 0.2 0.8 1\n4 0.2 0.2 1.5\n5 0.8 0.8 "
    "1\n$EndNodes\n$Elements\n2\n1 4 2 0 1 1 2 3 4\n2 4 2 0 1 2 5 3 4\n$EndElements\n";

const std::string shaken = R"([bridge]
assembly = "both.h5"
[[stage]]
kind = "gravity"
[[stage]]
kind = "motion"
duration = 0.04
pulse = { kind = "sine", axis = "x", amplitude = 9.0, frequency = 5.0 }
[output]
fields_every = 0.02
)";

/// A heap of two tetrahedra on a stone, shaken, in "run".
struct FillShown : testing::Test {
  Folder folder;
  Surroundings there{.folder = folder.path(), .environment = {{"DISPLAY", ""}}};

  void SetUp() override {
    folder.write("stone.obj", cube("stone", 0, 0, 0, 1));
    folder.write("heap.msh", heap);
    folder.write("c.toml", shaken);
    ASSERT_EQ(voussoir({"import", "stone.obj", "-o", "stone.h5"}, there).status, 0);
    const Outcome both = voussoir({"import", "heap.msh", "--into", "stone.h5", "-o", "both.h5"}, there);
    ASSERT_EQ(both.status, 0) << both.err;
  }
  std::string picture(std::vector<std::string> words) {
    words.insert(words.begin(), "render");
    words.insert(words.end(), {"--width", "320", "--height", "240", "-o", "picture.png"});
    std::filesystem::remove(folder / "picture.png");
    const Outcome outcome = voussoir(words, there);
    EXPECT_EQ(outcome.status, 0) << outcome.err;
    return bytes_of(folder / "picture.png");
  }
};

TEST_F(FillShown, ARunLeavesFramesAndPictures) {
  const Outcome run = voussoir({"run", "c.toml", "-o", "run"}, there);
  ASSERT_EQ(run.status, 0) << run.err;
  for (const char* file :
       {"vtk/fill.pvd", "vtk/fill_000000.000.vtu", "vtk/fill_000000.020.vtu", "vtk/fill_000000.040.vtu",
        "images/plastic_front.png", "images/plastic_oblique.png", "images/yield_front.png"})
    EXPECT_TRUE(exists(folder / "run/" + file)) << file;
  const std::string frames = bytes_of(folder / "run/vtk/fill.pvd");
  EXPECT_NE(frames.find("fill_000000.020.vtu"), std::string::npos) << frames;
  for (const char* name : {"stress", "plastic_shear_strain", "yields_now", "ComponentName4=\"YZ\""})
    EXPECT_NE(bytes_of(folder / "run/vtk/fill_000000.040.vtu").find(name), std::string::npos) << name;

  const nlohmann::json fill = summary(folder / "run")["fill"];
  EXPECT_EQ(fill["nodes"], 5);
  EXPECT_EQ(fill["tetrahedra"], 2);
  EXPECT_GT(fill["largest_displacement"].get<double>(), 1e-6);
  EXPECT_LE(fill["yielded_in_tension"].get<double>(), 1.0);

  // The fill is hidden as backfill is, and shown when it is coloured.
  const std::string shown = picture({"run", "--hide", "none"});
  EXPECT_TRUE(shown != picture({"run"}));
  EXPECT_EQ(shown.substr(0, 4), "\x89PNG");
  const std::string plastic = picture({"run", "--colour", "plastic"});
  EXPECT_TRUE(plastic != picture({"run", "--colour", "yield"}));
  EXPECT_TRUE(plastic != picture({"run", "--colour", "plastic", "--cut", "y=0.3"}));
  EXPECT_TRUE(picture({"run", "--colour", "yield", "--time", "0.04"}) ==
              picture({"run/checkpoints/stage_02_00000.040.h5", "--colour", "yield"}));
  EXPECT_EQ(picture({"run/assembly.h5", "--colour", "plastic"}).substr(0, 4), "\x89PNG");

  const auto refused = [&](std::vector<std::string> words, const std::vector<std::string>& pieces) {
    words.insert(words.begin(), {"render", "run", "-o", "no.png"});
    expect_error(voussoir(words, there), 2, pieces);
  };
  refused({"--colour", "plastic", "--hide", "backfill"}, {"plastic", "--hide none"});
  refused({"--cut", "w=1"}, {"'w=1'", "y=0.5"});
  refused({"--cut", "y=7"}, {"y = 7 m", "0.000 to 1.000 m"});
  refused({"--cut", "x=0.5", "--view", "front"}, {"front", "side or oblique"});
  EXPECT_FALSE(exists(folder / "no.png"));

  // Damage is named.
  const std::string frame = folder / "run/vtk/fill_000000.040.vtu", whole = bytes_of(frame);
  set_bytes(frame, whole.substr(0, whole.size() / 2));
  refused({"--hide", "none"}, {"fill_000000.040.vtu"});
}

TEST_F(FillShown, AResumedRunHasTheSameFrames) {
  ASSERT_EQ(voussoir({"run", "c.toml", "-o", "whole", "--no-pictures"}, there).status, 0);
  ASSERT_EQ(voussoir({"run", "c.toml", "-o", "parts", "--no-pictures", "--until", "0.03"}, there).status, 0);
  ASSERT_EQ(voussoir({"resume", "parts", "--no-pictures"}, there).status, 0);
  for (const char* file : {"vtk/fill.pvd", "vtk/fill_000000.040.vtu"})
    EXPECT_TRUE(bytes_of(folder / "whole/" + file) == bytes_of(folder / "parts/" + file)) << file;
}

TEST_F(FillShown, ModesMoveItInFilesAndPictures) {
  const Outcome modal =
      voussoir({"modal", "c.toml", "-n", "2", "-o", "modes", "--width", "320", "--height", "240"}, there);
  ASSERT_EQ(modal.status, 0) << modal.err;
  EXPECT_NE(modal.out.find("1 block, a fill of 5 nodes and 2 tetrahedra, "), std::string::npos) << modal.out;
  for (const char* file : {"modes/vtk/modes_fill.pvd", "modes/vtk/mode_fill_02.vtu", "modes/images/mode_02.png"})
    EXPECT_TRUE(exists(folder / file)) << file;
  EXPECT_NE(voussoir({"info", "modes/modes.h5"}, there).out.find("5 nodes of a fill"), std::string::npos);
  const std::string shown = bytes_of(folder / "modes/images/mode_02.png");
  ASSERT_EQ(
      voussoir({"modal", "c.toml", "-n", "1", "-o", "modes", "--width", "320", "--height", "240", "--hide", "backfill"},
               there)
          .status,
      0);
  EXPECT_TRUE(shown != bytes_of(folder / "modes/images/mode_01.png"));
  EXPECT_FALSE(exists(folder / "modes/vtk/mode_fill_02.vtu")) << "of the analysis before";
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
