// A deformable fill as a user meets it: generated, looked at, imported, run, resumed, asked for its modes.
#include <gtest/gtest.h>

#include "solver/base/json_file.h"
#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

const std::string bridge =
    "[bridge]\ngenerator = \"cs1\"\nspans = 1\nblock_scale = 3.0\nfill_edge = 1.5\nabutment_leaf_length = "
    "1.5\nbackfill = \"deformable\"\n";

void expect_holds(const std::string& text, const std::vector<std::string>& pieces) {
  for (const std::string& piece : pieces) EXPECT_NE(text.find(piece), std::string::npos) << piece << "\nin\n" << text;
}

TEST(Fill, GenerateAndInfoSayWhatItIs) {
  Folder folder;
  folder.write("c.toml", bridge);
  const Outcome made = voussoir({"generate", "c.toml", "-o", "c.h5"}, {.folder = folder.path()});
  ASSERT_EQ(made.status, 0) << made.err;
  const std::vector<std::string> words = {"deformable fill", "nodes",          "tetrahedra, in 3 parts", "patches",
                                          "volume",          "longest edge",   "shortest edge",          "edge ratio",
                                          "smallest angle",  "smallest height"};
  expect_holds(made.out, words);
  expect_holds(made.out, {"its space", "asked for 1.5 m"});
  EXPECT_EQ(made.out.find("not reached"), std::string::npos) << made.out;
  const Outcome seen = voussoir({"info", "c.h5"}, {.folder = folder.path()});
  ASSERT_EQ(seen.status, 0) << seen.err;
  expect_holds(seen.out, words);
}

TEST(Fill, TwoProgramsMakeTheSameFile) {
  Folder folder;
  folder.write("c.toml", bridge);
  for (const char* file : {"one.h5", "two.h5"})
    ASSERT_EQ(voussoir({"generate", "c.toml", "-o", file}, {.folder = folder.path()}).status, 0);
  EXPECT_EQ(bytes_of(folder / "one.h5"), bytes_of(folder / "two.h5"));
}

/// Held at its ends, or its thrust would push the abutments out.
const std::string shaken = bridge +
                           "abutments = \"restrained\"\n[damping]\nkind = \"maxwell\"\n[[stage]]\nkind = \"gravity\"\n"
                           "[[stage]]\nkind = \"motion\"\nduration = 0.2\n"
                           "synthetic = { seed = 1, peak = 3.5, axes = [\"x\", \"y\"] }\n";

TEST(Fill, RunsAndGoesOnFromItsCheckpoints) {
  Folder folder;
  folder.write("c.toml", shaken);
  run_whole(folder, "c.toml", "whole");
  run_whole(folder, "c.toml", "parts", {"--until", "0.09"});
  const Outcome end = voussoir({"resume", "parts", "--no-pictures"}, {.folder = folder.path()});
  ASSERT_EQ(end.status, 0) << end.err;
  expect_same_run(folder / "whole", folder / "parts");
  const nlohmann::json found = summary(folder / "whole");
  EXPECT_TRUE(found.at("finished").get<bool>());
  EXPECT_LT(found.at("energy_error").get<double>(), 0.01) << json_text(found);
}

TEST(Fill, TheStepNamesANode) {
  Folder folder;
  std::string fine = shaken;
  fine.replace(fine.find("1.5"), 3, "1.0");  // of a coarser one a stone sets the step
  folder.write("c.toml", fine);
  const Outcome seen = voussoir({"step", "c.toml"}, {.folder = folder.path()});
  ASSERT_EQ(seen.status, 0) << seen.err;
  expect_holds(seen.out, {"set by node", "of the fill at", "bodies and nodes that demand"});
}

TEST(Fill, ModesKnowIt) {
  Folder folder;
  folder.write("c.toml", shaken);
  for (const char* state : {"intact", "gravity"}) {
    const auto end = voussoir({"modal", "c.toml", "--modes", "3", "--state", state, "--no-pictures", "-o", state},
                              {.folder = folder.path()});
    ASSERT_EQ(end.status, 0) << end.err;
    expect_holds(end.out, {state == std::string("intact") ? "transverse" : "joints as they rest under gravity"});
  }
}

/// A tetrahedron on the upper face of the unit cube.
const std::string heap =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n4\n1 0.2 0.2 1\n2 0.8 0.2 1\n3 0.2 0.8 1\n4 0.2 0.2 1.5\n$EndNodes\n"
    "$Elements\n1\n1 4 2 0 1 1 2 3 4\n$EndElements\n";

TEST(Fill, ImportPutsItIntoAnAssembly) {
  Folder folder;
  folder.write("stone.obj", cube("stone", 0, 0, 0, 1));
  folder.write("heap.msh", heap);
  const Surroundings there = {.folder = folder.path()};
  ASSERT_EQ(voussoir({"import", "stone.obj", "-o", "stone.h5"}, there).status, 0);
  const Outcome outcome = voussoir({"import", "heap.msh", "--into", "stone.h5", "-o", "both.h5"}, there);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  expect_holds(outcome.out,
               {"the fill's material \"backfill\" is new", "4 nodes, 1 tetrahedron", "1, which cover 0.180 of"});
  expect_holds(voussoir({"info", "both.h5"}, there).out, {"1 block (", "deformable fill"});
  // A material of the assembly, and only what fits together.
  EXPECT_EQ(voussoir({"import", "heap.msh", "--into", "stone.h5", "-o", "b.h5", "--material", "stone"}, there).status,
            0);
  expect_error(
      voussoir({"import", "heap.msh", "--into", "stone.h5", "-o", "b.h5", "--material", "stone", "--density", "1800"},
               there),
      2, {"--density", "\"stone\"", "--material"});
  expect_error(voussoir({"import", "heap.msh", "--into", "both.h5", "-o", "b.h5"}, there), 2,
               {"heap.msh", "already has"});
  expect_error(voussoir({"import", "stone.obj", "--into", "both.h5", "-o", "b.h5"}, there), 2, {"--into", ".msh"});
  expect_error(voussoir({"import", "heap.msh", "--fixed", "none", "-o", "b.h5"}, there), 2, {"--fixed"});
}

TEST(Fill, ImportAlone) {
  Folder folder;
  folder.write("heap.msh", heap);
  const Surroundings there = {.folder = folder.path()};
  const Outcome outcome = voussoir({"import", "heap.msh", "-o", "heap.h5"}, there);
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  expect_holds(outcome.out, {"holds only the fill", "4 nodes, 1 tetrahedron"});
  const Outcome seen = voussoir({"info", "heap.h5"}, there);
  EXPECT_EQ(seen.status, 0) << seen.err;
  expect_holds(seen.out, {"0 blocks", "deformable fill"});
  folder.write("heap.toml", "[bridge]\nassembly = \"heap.h5\"\n\n[[stage]]\nkind = \"gravity\"\n");
  EXPECT_EQ(voussoir({"step", "heap.toml"}, there).status, 0);
}

TEST(Fill, ImportInWrongUnitsDoesNotTouch) {
  Folder folder;
  folder.write("stone.obj", cube("stone", 0, 0, 0, 1));
  folder.write("heap.msh", heap);
  const Surroundings there = {.folder = folder.path()};
  ASSERT_EQ(voussoir({"import", "stone.obj", "-o", "stone.h5"}, there).status, 0);
  expect_error(voussoir({"import", "heap.msh", "--scale", "0.001", "--into", "stone.h5", "-o", "b.h5"}, there), 2,
               {"heap.msh", "does not touch the masonry", "unit (metres)"});
  EXPECT_FALSE(exists(folder / "b.h5"));
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
