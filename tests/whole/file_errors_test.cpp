// Files that are damaged, foreign or wrong inside: each is refused by name, none makes the program crash.
#include <gtest/gtest.h>

#include <filesystem>
#include <random>

#include "io/hdf5/assembly_file.h"
#include "io/hdf5/h5.h"
#include "tests/whole/cases.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

const std::string from_file = R"([bridge]
assembly = "wall.h5"
[[stage]]
kind = "gravity"
[[stage]]
kind = "free"
duration = 0.01
)";

/// A folder with wall.h5, its assembly, and read.toml, a case that reads it.
struct WithAssembly : Folder {
  WithAssembly() {
    write_wall(*this);
    EXPECT_EQ(voussoir({"generate", "wall.toml", "-o", "wall.h5"}, {.folder = path()}).status, 0);
    write("read.toml", from_file);
  }
  /// Every verb that reads assemblies refuses wall.h5 as it now is.
  void expect_refused(const std::vector<std::string>& pieces) const {
    std::vector<std::string> all = pieces;
    all.push_back("wall.h5");
    const std::vector<std::vector<std::string>> commands = {{"info", "wall.h5"}, {"run", "read.toml", "-o", "run"}};
    for (const auto& words : commands) {
      SCOPED_TRACE(words[0]);
      expect_error(voussoir(words, {.folder = path()}), 2, all);
    }
    EXPECT_FALSE(exists(*this / "run"));
  }
};

std::string random_bytes(std::size_t count, unsigned seed) {
  std::mt19937 random(seed);
  std::string bytes(count, '\0');
  for (char& c : bytes) c = char(random());
  return bytes;
}

TEST(FileErrors, AssembliesThatAreNoHdf5) {
  WithAssembly folder;
  for (const std::string& bytes : {std::string(), std::string("stones"), random_bytes(5000, 1)}) {
    set_bytes(folder / "wall.h5", bytes);
    folder.expect_refused({"not an HDF5 file"});
    expect_error(voussoir({"render", "wall.h5", "-o", "x.png"}, {.folder = folder.path()}), 2, {"wall.h5"});
    EXPECT_FALSE(exists(folder / "x.png"));
  }
  std::filesystem::remove(folder / "wall.h5");
  folder.expect_refused({"there is no"});
  std::filesystem::create_directory(folder / "wall.h5");
  expect_error(voussoir({"run", "read.toml", "-o", "run"}, {.folder = folder.path()}), 2, {"wall.h5", "folder"});
}

TEST(FileErrors, ForeignHdf5) {
  WithAssembly folder;
  h5::File foreign = h5::File::create(folder / "wall.h5");
  foreign.write<double>("temperature", std::vector<double>{1.0, 2.0}, {}, "K");
  foreign.save();
  folder.expect_refused({"format"});
  h5::File newer = h5::File::create(folder / "wall.h5");
  newer.set_text("/", "format", "voussoir-assembly");
  newer.set_integer("/", "format_version", 99);
  newer.save();
  folder.expect_refused({"99"});
  h5::File hollow = h5::File::create(folder / "wall.h5");
  hollow.set_text("/", "format", "voussoir-assembly");
  hollow.set_integer("/", "format_version", 1);
  hollow.save();
  folder.expect_refused({"blocks/"});
}

TEST(FileErrors, AssembliesCutOff) {
  WithAssembly folder;
  const std::string whole = bytes_of(folder / "wall.h5");
  for (std::size_t part = 0; part < 16; ++part) {
    set_bytes(folder / "wall.h5", whole.substr(0, whole.size() * part / 16));
    SCOPED_TRACE(part);
    expect_error(voussoir({"info", "wall.h5"}, {.folder = folder.path()}), 2, {"wall.h5"});
  }
  set_bytes(folder / "wall.h5", whole.substr(0, whole.size() - 1));
  folder.expect_refused({});
}

TEST(FileErrors, BytesChangedAnywhere) {
  WithAssembly folder;
  run_whole(folder, "wall.toml", "run", {"--until", "0.2"});
  const std::vector<std::string> files = {"wall.h5", "run/history.h5", "run/checkpoints/00000.200.h5"};
  std::mt19937 random(11);
  for (const std::string& file : files) {
    const std::string whole = bytes_of(folder / file);
    EXPECT_EQ(whole.find("FRHP"), std::string::npos) << file << " has a fractal heap: damage to it crashes HDF5 1.10.8";
    const std::string said = voussoir({"info", file}, {.folder = folder.path()}).out;
    for (int i = 0; i < 15; ++i) {
      std::string bytes = whole;
      const std::size_t at = random() % bytes.size();
      bytes[at] = char(bytes[at] ^ (1 << random() % 8));
      set_bytes(folder / file, bytes);
      SCOPED_TRACE(file + " at byte " + std::to_string(at));
      const Outcome outcome = voussoir({"info", file}, {.folder = folder.path()});
      if (outcome.status == 0)
        EXPECT_EQ(outcome.out, said);  // a byte that nobody reads
      else
        expect_error(outcome, 2, {file});
    }
  }
}

TEST(FileErrors, DamagedCheckpointsAreNamedByInfoAndRender) {
  Folder folder;
  write_wall(folder);
  run_whole(folder, "wall.toml", "run", {"--until", "0.2"});
  const std::string file = "run/checkpoints/00000.200.h5", whole = bytes_of(folder / file);
  std::string flipped = whole;
  flipped[flipped.size() / 2] ^= 1;
  const std::vector<std::string> kinds = {whole.substr(0, whole.size() / 2), "", random_bytes(3000, 3), flipped};
  for (std::size_t kind = 0; kind < kinds.size(); ++kind) {
    set_bytes(folder / file, kinds[kind]);
    SCOPED_TRACE(kind);
    expect_error(voussoir({"render", file, "-o", "x.png"}, {.folder = folder.path()}), 2, {file});
    if (kind < 3) expect_error(voussoir({"info", file}, {.folder = folder.path()}), 2, {file});
  }
  EXPECT_FALSE(exists(folder / "x.png"));
}

TEST(FileErrors, OneFileForAnother) {
  Folder folder;
  write_wall(folder);
  run_whole(folder, "wall.toml", "run");
  const Surroundings there{.folder = folder.path()};
  folder.write("read.toml", exchanged(from_file, "wall.h5", "run/history.h5"));
  expect_error(voussoir({"run", "read.toml", "-o", "other"}, there), 2, {"run/history.h5", "voussoir-history"});
  expect_error(voussoir({"render", "run/history.h5"}, there), 2, {"run/history.h5"});
  expect_error(voussoir({"render", "wall.toml"}, there), 2, {"wall.toml"});
  expect_error(voussoir({"run", "run/assembly.h5"}, there), 2, {"run/assembly.h5"});
  expect_error(voussoir({"import", "run/history.h5", "-o", "x.h5"}, there), 2, {"run/history.h5", "voussoir-history"});
  std::filesystem::copy_file(folder / "run/assembly.h5", folder / "run/checkpoints/00009.000.h5");
  expect_error(voussoir({"resume", "run"}, there), 2, {"00009.000.h5", "voussoir-assembly"});
}

TEST(FileErrors, BlocksThatAreWrong) {
  WithAssembly folder;
  const Assembly good = read_assembly(folder / "wall.h5");
  const auto refused = [&](const std::function<void(Assembly&)>& spoil, const std::vector<std::string>& pieces) {
    Assembly bad = good;
    spoil(bad);
    write_assembly(folder / "wall.h5", bad);
    SCOPED_TRACE(pieces.back());
    folder.expect_refused(pieces);
  };
  const auto cell = [](Assembly& a) -> Polyhedron& { return a.blocks[7].cells[0]; };
  refused(
      [&](Assembly& a) {
        for (auto& f : cell(a).faces) std::reverse(f.begin(), f.end());
      },
      {"block 7", "inside-out"});
  refused(
      [&](Assembly& a) {
        for (Vec3& v : cell(a).vertices) v.y() = 0.0;
      },
      {"block 7", "no volume"});
  refused([&](Assembly& a) { cell(a).vertices[2].x() = std::nan(""); }, {"blocks/vertices", "not a finite number"});
  refused([&](Assembly& a) { cell(a).vertices[2].x() = INFINITY; }, {"blocks/vertices", "not a finite number"});
  refused([&](Assembly& a) { cell(a).faces.pop_back(); }, {"block 7", "close"});
  refused([&](Assembly& a) { cell(a).faces[0][0] = 77; }, {"blocks/face_vertices", "out of range"});
  refused([&](Assembly& a) { a.materials[0].density = 0.0; }, {"materials/density"});
  refused(
      [&](Assembly& a) {
        for (Block& b : a.blocks) b.fixed = false;
      },
      {"no block is fixed"});
  refused([&](Assembly& a) { a.joints[3].kn = -1.0; }, {"joints/kn", "row 3"});
  refused([&](Assembly& a) { a.joints[3].b = 4000; }, {"joints/blocks", "out of range"});
}

TEST(FileErrors, OverlappingBlocksOfAnAssemblyAreNamed) {
  WithAssembly folder;
  Assembly bad = read_assembly(folder / "wall.h5");
  for (Vec3& v : bad.blocks[7].cells[0].vertices) v.x() += 0.05;  // into its neighbour in the course
  bad.blocks[7].centroid.x() += 0.05;
  std::erase_if(bad.joints, [](const Joint& j) { return j.a == 7 || j.b == 7; });
  write_assembly(folder / "wall.h5", bad);
  expect_error(voussoir({"run", "read.toml", "-o", "run"}, {.folder = folder.path()}), 2,
               {"wall.h5", "overlap", "7", "8"});
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
