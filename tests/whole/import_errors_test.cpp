// Stones drawn elsewhere that cannot be used.
#include <gtest/gtest.h>

#include <algorithm>
#include <random>

#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

const std::string lower = cube("lower", 0, 0, 0, 1);

Outcome import(const Folder& folder, const std::string& file, const std::vector<std::string>& more = {}) {
  std::vector<std::string> words = {"import", file, "-o", "out.h5"};
  words.insert(words.end(), more.begin(), more.end());
  return voussoir(words, {.folder = folder.path()});
}

void expect_refused(const std::string& text, std::vector<std::string> pieces, const std::string& name = "stones.obj") {
  Folder folder;
  folder.write(name, text);
  pieces.push_back(name);
  SCOPED_TRACE(pieces[0]);
  expect_error(import(folder, name), 2, pieces);
  EXPECT_FALSE(exists(folder / "out.h5"));
}

TEST(ImportErrors, TheGoodOnesAreTaken) {
  Folder folder;
  folder.write("stones.obj", lower + cube("upper", 0, 0, 1, 9));
  const Outcome outcome = import(folder, "stones.obj");
  ASSERT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("2 blocks, 1 joint,"), std::string::npos) << outcome.out;
  EXPECT_EQ(import(folder, "stones.obj", {"-q"}).out, "");
}

TEST(ImportErrors, OverlapsAreNamed) {
  expect_refused(lower + cube("upper", 0.5, 0.5, 0.5, 9), {"overlap", "'lower'", "'upper'", "0.5 m"});
  expect_refused(lower + cube("twin", 0, 0, 0, 9), {"overlap", "'lower'", "'twin'"});
}

TEST(ImportErrors, StonesWithoutVolume) {
  const auto flat = [](std::string text, const std::string& from, const std::string& to) {
    while (text.find(from) != std::string::npos) text = exchanged(text, from, to);
    return text;
  };
  const std::string sheet = flat(cube("sheet", 0, 0, 0, 1), " 1\nv", " 0\nv");
  expect_refused(exchanged(sheet, "v 0 1 1\n", "v 0 1 0\n"), {"'sheet'", "stones.obj:10"});
  std::string point = "o point\n" + lower.substr(lower.find("f "));
  for (int k = 0; k < 8; ++k) point = "v 1 1 1\n" + point;
  expect_refused(point, {"'point'"});
  expect_refused(
      cube("good", 5, 0, 0, 1) + exchanged(flat(cube("leaf", 0, 0, 0, 9), " 1\nv", " 0\nv"), "v 0 1 1\n", "v 0 1 0\n"),
      {"'leaf'"});
}

TEST(ImportErrors, StonesThatAreNotConvex) {
  std::string bent = lower;  // one corner of the top pushed into the stone
  expect_refused(exchanged(bent, "v 1 1 1\n", "v 0.3 0.3 0.5\n"), {"'lower'", "not a convex stone", "convex pieces"});
}

TEST(ImportErrors, StonesThatAreOpen) {
  expect_refused(exchanged(lower, "f 5 6 7 8\n", ""), {"'lower'", "not closed"});
  expect_refused(exchanged(lower, "f 5 6 7 8\n", "f 8 7 6 5\n"), {"'lower'", "the same orientation"});
}

TEST(ImportErrors, InsideOutStonesAreTurnedAndSaid) {
  Folder folder;
  std::string text = lower;
  for (const auto& [a, b] : {std::pair{"4 3 2 1", "1 2 3 4"},
                             {"5 6 7 8", "8 7 6 5"},
                             {"1 2 6 5", "5 6 2 1"},
                             {"2 3 7 6", "6 7 3 2"},
                             {"3 4 8 7", "7 8 4 3"},
                             {"4 1 5 8", "8 5 1 4"}})
    text = exchanged(text, a, b);
  folder.write("stones.obj", text);
  const Outcome outcome = import(folder, "stones.obj");
  EXPECT_EQ(outcome.status, 0) << outcome.err;
  EXPECT_NE(outcome.out.find("'lower' (stone 0) was inside-out"), std::string::npos) << outcome.out;
}

TEST(ImportErrors, NumbersAndIndices) {
  expect_refused(exchanged(lower, "v 1 1 1\n", "v 1 nan 1\n"), {"stones.obj:8", "finite"});
  expect_refused(exchanged(lower, "v 1 1 1\n", "v 1 1e999 1\n"), {"stones.obj:8"});
  expect_refused(exchanged(lower, "v 1 1 1\n", "v 1 1\n"), {"stones.obj:8", "three"});
  expect_refused(exchanged(lower, "f 5 6 7 8", "f 5 6 7 80"), {"stones.obj:11", "'80'", "8 vertices"});
  expect_refused(exchanged(lower, "f 5 6 7 8", "f 5 6 7 0"), {"stones.obj:11", "'0'"});
  expect_refused(exchanged(lower, "f 5 6 7 8", "f 5 6"), {"stones.obj:11", "a face has 2 corners"});
  expect_refused(exchanged(lower, "f 5 6 7 8", "f 5 6 7 99999999999999999999"), {"stones.obj:11"});
}

TEST(ImportErrors, FilesThatHoldNothing) {
  for (const char* name : {"stones.obj", "stones.stl", "stones.ply"}) {
    expect_refused("", {""}, name);
    expect_refused("nothing to see\n", {""}, name);
  }
  expect_refused("solid\n", {"not read"}, "stones.dxf");
  Folder folder;
  expect_error(import(folder, "missing.obj"), 2, {"missing.obj"});
  expect_error(import(folder, "."), 2, {"."});
  folder.write("stones.obj", lower);
  expect_error(import(folder, "stones.obj", {"--fixed", "plinth"}), 2, {"'plinth'"});
  expect_error(import(folder, "stones.obj", {"--scale", "0"}), 2, {"--scale"});
  expect_error(import(folder, "stones.obj", {"--kn", "1e9"}), 2, {"kn", "ks"});
}

TEST(ImportErrors, OptionsThatSayNothing) {
  Folder folder;
  folder.write("stones.obj", lower + cube("upper", 0, 0, 1, 9));
  expect_error(import(folder, "stones.obj", {"--up", "w"}), 2, {"--up is 'w'", "-x, -y or -z"});
  expect_error(import(folder, "stones.obj", {"--cells", "some"}), 2, {"--cells is 'some'", "objects or names"});
  for (const char* share : {"-1", "0.2", "nan"})
    expect_error(import(folder, "stones.obj", {"--flatten", share}), 2, {"--flatten", "0 to 0.1"});
  expect_error(import(folder, "stones.obj", {"--materials", "none.toml"}), 2, {"none.toml"});
}

TEST(ImportErrors, UnitsMapsAndShapes) {
  Folder folder;
  folder.write("stones.obj", lower + cube("upper", 0, 0, 1, 9));
  const Outcome small = import(folder, "stones.obj", {"--units", "ft"});
  EXPECT_NE(small.out.find("0.06 t that can move"), std::string::npos) << small.out;  // 2000 × 0.3048³ kg
  expect_error(import(folder, "stones.obj", {"--units", "yd"}), 2, {"--units is 'yd'", "mm, in, ft"});
  expect_error(import(folder, "stones.obj", {"--units", "mm", "--scale", "0.001"}), 2, {"--units and --scale"});
  expect_error(import(folder, "stones.obj", {"--not-convex", "melt"}), 2, {"--not-convex is 'melt'", "hull, cut"});
  expect_error(import(folder, "stones.obj", {"--map", "none.toml"}), 2, {"none.toml"});
  folder.write("names.toml", "[names]\n\"lower\" = {component = \"bas\"}\n");
  expect_error(import(folder, "stones.obj", {"--map", "names.toml"}), 2, {"names.toml:2", "bas", "base"});
  folder.write("names.toml", "[names]\n\"upper\" = {component = \"base\", fixed = true}\n\"x*\" = {part = 1}\n");
  const Outcome mapped = import(folder, "stones.obj", {"--map", "names.toml"});
  for (const char* piece : {"no object fits 'x*'", "no row for the objects 'lower'", "base                1        1"})
    EXPECT_NE(mapped.out.find(piece), std::string::npos) << mapped.out << mapped.err;
  expect_error(import(folder, "out.h5", {"--map", "names.toml"}), 2, {"--map"});
}

TEST(ImportErrors, ExportAndBack) {
  Folder folder;
  folder.write("case.toml", "[bridge]\ngenerator = \"arch\"\n");
  const auto run = [&](const std::vector<std::string>& words) { return voussoir(words, {.folder = folder.path()}); };
  for (const char* file : {"arch.obj", "arch.json"}) {
    const Outcome out = run({"export", "case.toml", "-o", file});
    ASSERT_EQ(out.status, 0) << out.err;
    EXPECT_NE(out.out.find("joints are not written"), std::string::npos) << out.out;
    EXPECT_TRUE(exists(folder / "arch.names.toml"));
    const Outcome back = run({"import", file, "--map", "arch.names.toml", "-o", "back.h5"});
    ASSERT_EQ(back.status, 0) << back.err;
    const Outcome generated = run({"generate", "case.toml", "-o", "arch.h5"});
    const auto counts = [](const std::string& text) {
      return text.substr(text.find("component"), text.find("smallest") - text.find("component"));
    };
    EXPECT_EQ(counts(back.out).substr(0, counts(back.out).find(" joints")),
              counts(generated.out).substr(0, counts(generated.out).find(" joints")));
  }
  expect_error(run({"export", "case.toml"}), 2, {"-o FILE is missing"});
  expect_error(run({"export", "case.toml", "-o", "arch.stl"}), 2, {"arch.stl", ".obj or .json"});
  expect_error(run({"export", "none.toml", "-o", "arch.obj"}), 2, {"none.toml"});
}

/// Among the stones of this bridge is a wedge 0.7 mm wide.
TEST(ImportErrors, ABridgeComesBackWithItsJoints) {
  Folder folder;
  folder.write("case.toml", "[bridge]\ngenerator = \"cs2\"\n");
  const auto run = [&](const std::vector<std::string>& words) { return voussoir(words, {.folder = folder.path()}); };
  ASSERT_EQ(run({"export", "case.toml", "-o", "bridge.obj"}).status, 0);
  const Outcome back = run({"import", "bridge.obj", "--map", "bridge.names.toml", "--gap", "1e-6", "-o", "back.h5"});
  ASSERT_EQ(back.status, 0) << back.err;
  const Outcome generated = run({"generate", "case.toml", "-o", "bridge.h5"});
  const auto inventory = [](const std::string& text) {
    const std::size_t at = text.find("component      ");
    return text.substr(at, text.find("surface") - at);
  };
  EXPECT_EQ(inventory(back.out), inventory(generated.out));
}

/// Joints are counted where a run begins, and those of an assembly file are found anew by import.
TEST(ImportErrors, JointsAreCountedFromImportToRun) {
  Folder folder;
  folder.write("stones.obj", lower + cube("upper", 0, 0, 1, 9));
  const Outcome outcome = import(folder, "stones.obj", {"--cohesion", "1e5"});
  EXPECT_NE(outcome.out.find("1 joint: 1 bonded, 0 dry"), std::string::npos) << outcome.out;
  const Outcome again = voussoir({"import", "out.h5", "-o", "dry.h5", "--cohesion", "0"}, {.folder = folder.path()});
  EXPECT_NE(again.out.find("1 joint: 0 bonded, 1 dry"), std::string::npos) << again.out << again.err;
  const Outcome generated = voussoir({"generate", "dry.h5", "-o", "same.h5"}, {.folder = folder.path()});
  EXPECT_NE(generated.out.find("the joints are those of the file"), std::string::npos) << generated.err;
  folder.write("case.toml", "[bridge]\nassembly = \"out.h5\"\n\n[[stage]]\nkind = \"gravity\"\n");
  const Outcome run = voussoir({"run", "case.toml", "-o", "run", "--no-pictures"}, {.folder = folder.path()});
  ASSERT_EQ(run.status, 0) << run.err;
  EXPECT_NE(run.err.find("2 blocks; 1 joint: 1 bonded, 0 dry"), std::string::npos) << run.err;
  EXPECT_EQ(summary(folder / "run")["joint_kinds"],
            (nlohmann::json{{"bonded", 1}, {"dry", 0}, {"ties", 0}, {"fill", 0}}));
}

TEST(ImportErrors, GarbageOfEveryKind) {
  Folder folder;
  std::mt19937 random(5);
  const std::vector<std::string> heads = {
      "",
      "solid\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\n",
      "ply\nformat ascii 1.0\nelement vertex 999999999\n",
      "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\nelement face 1\n"
      "property list uchar int vertex_indices\nend_header\n0 0 0\n1 0 0\n0 1 0\n3 0 1 900\n",
      "ply\nformat binary_little_endian 1.0\nelement vertex 8\nproperty float x\nproperty float y\nproperty float z\n"
      "element face 6\nproperty list uchar int vertex_indices\nend_header\n",
      std::string(80, ' ') + "\xff\xff\xff\x7f",
      "{\"dtype\": \"x\", \"data\": {\"graph\": {\"node\": {\"0\": {\"block\": 7}}}}}",
      "{\"asset\": {\"version\": \"2.0\"}, \"nodes\": [{\"mesh\": 0}]}",
      std::string("glTF\2\0\0\0\xff\xff\0\0\xff\0\0\0JSON", 20)};
  for (const char* ending : {"obj", "stl", "ply", "json", "gltf", "glb"})
    for (const std::string& head : heads) {
      std::string bytes = head;
      for (int i = 0; i < 600; ++i) bytes += char(random());
      for (const std::string& text : {head, bytes}) {
        folder.write(std::string("stones.") + ending, text);
        SCOPED_TRACE(ending + (": " + head.substr(0, 60)));
        expect_error(import(folder, std::string("stones.") + ending), 2, {std::string("stones.") + ending});
      }
    }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
