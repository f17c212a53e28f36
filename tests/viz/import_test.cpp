// Stones from OBJ, PLY and STL files: round trips, taking apart, and errors that name object and line.
#include "io/vtk/import.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "io/case/material_table.h"
#include "io/hdf5/assembly_file.h"
#include "io/vtk/shells.h"
#include "io/vtk/surface_file.h"
#include "solver/base/error.h"
#include "tests/folder.h"
#include "tests/viz/scenes.h"
#include "tests/viz/surface_texts.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using namespace test;

/// Three unit cubes in a pile of two and one beside: whole faces shared, coincident vertices and edges.
std::vector<Polyhedron> pile() {
  return {make_box({0, 0, 0}, {1, 1, 1}), make_box({0, 0, 1}, {1, 1, 2}), make_box({1, 0, 0}, {2, 1, 1})};
}

void expect_pile(const Import& import, double unit = 1.0) {
  ASSERT_EQ(import.assembly.blocks.size(), 3u);
  for (const Block& block : import.assembly.blocks) {
    EXPECT_EQ(block.cells[0].vertices.size(), 8u);
    EXPECT_EQ(block.cells[0].faces.size(), 6u);
    EXPECT_NEAR(block.mass, 2000.0 * unit * unit * unit, 1e-3 * unit);
  }
  // Cubes 0 and 2 stand on the ground and are fixed: the joint between them is of no use and dropped.
  EXPECT_TRUE(import.assembly.blocks[0].fixed);
  EXPECT_FALSE(import.assembly.blocks[1].fixed);
  EXPECT_TRUE(import.assembly.blocks[2].fixed);
  EXPECT_EQ(import.joints.joints, 1);
  ASSERT_EQ(import.assembly.joints.size(), 1u);
  EXPECT_NEAR(import.assembly.joints[0].area, unit * unit, 1e-6);
  EXPECT_GT(import.assembly.joints[0].kn, 0.0);
  EXPECT_EQ(import.assembly.laws.size(), 1u);
}

TEST(Import, ObjObjectsBecomeStones) {
  const Folder folder;
  int first = 1;
  std::string text = "# a pile\nmtllib none.mtl\n";
  const auto shapes = pile();
  for (std::size_t i = 0; i < 3; ++i) text += obj_text(shapes[i], fmt::format("stone {}", i), first);
  set_bytes(folder / "pile.obj", text);
  const Import import = import_blocks(folder / "pile.obj");
  expect_pile(import);
  EXPECT_EQ(import.names[1], "stone 1");
  EXPECT_EQ(import.assembly.groups.at("object stone 1"), std::vector<std::int64_t>{1});
  EXPECT_TRUE(import.notes.empty());
}

TEST(Import, StlShellsAreToldApartEvenWhereTheyTouch) {
  const Folder folder;
  set_bytes(folder / "one.stl", stl_text(pile(), true));
  expect_pile(import_blocks(folder / "one.stl"));
  set_bytes(folder / "many.STL", stl_text(pile(), false));
  expect_pile(import_blocks(folder / "many.STL"));
}

TEST(Import, PlyInMillimetres) {
  const Folder folder;
  auto shapes = pile();
  for (auto& shape : shapes)
    for (Vec3& v : shape.vertices) v *= 500.0;
  set_bytes(folder / "pile.ply", ply_text(shapes));
  ImportOptions options;
  options.scale = 0.001;
  expect_pile(import_blocks(folder / "pile.ply", options), 0.5);
}

TEST(Import, InsideOutStonesAreTurnedAndSaid) {
  const Folder folder;
  int first = 1;
  const auto shapes = pile();
  const std::string good = obj_text(shapes[0], "good", first);  // `first` counts on from one to the next
  set_bytes(folder / "a.obj", good + obj_text(shapes[1], "turned", first, true));
  const Import import = import_blocks(folder / "a.obj");
  ASSERT_EQ(import.notes.size(), 1u);
  EXPECT_NE(import.notes[0].find("'turned'"), std::string::npos);
  EXPECT_GT(import.assembly.blocks[1].mass, 0.0);
  // All of a triangle soup the wrong way round.
  auto mirrored = shapes;
  for (auto& shape : mirrored)
    for (auto& loop : shape.faces) std::reverse(loop.begin(), loop.end());
  set_bytes(folder / "soup.stl", stl_text(mirrored, true));
  const Import soup = import_blocks(folder / "soup.stl");
  expect_pile(soup);
  EXPECT_EQ(soup.notes.size(), 3u);
}

TEST(Import, NegativeIndicesGroupsAndContinuedLines) {
  const Folder folder;
  set_bytes(folder / "t.obj",
            "g a\nv 0 0 0\nv 1 0 0\nv 0 1 0\nv 0 0 1\n"
            "f -4 -2 -3\nf -4/1/1 -3/2/2 \\\n -1/3/3\nf 2 3 4 # a comment\nf 1//2 4//1 3//2\n");
  const Import import = import_blocks(folder / "t.obj");
  ASSERT_EQ(import.assembly.blocks.size(), 1u);
  EXPECT_EQ(import.names[0], "a");
  EXPECT_NEAR(import.assembly.blocks[0].mass, 2000.0 / 6.0, 1e-9);
}

TEST(Import, FixedListTakesNumbersAndNames) {
  const Folder folder;
  int first = 1;
  std::string text;
  for (const auto& shape : pile()) text += obj_text(shape, fmt::format("s{}", first), first);
  set_bytes(folder / "p.obj", text);
  ImportOptions options;
  options.fixed = "1,s17";
  const Import import = import_blocks(folder / "p.obj", options);
  EXPECT_FALSE(import.assembly.blocks[0].fixed);
  EXPECT_TRUE(import.assembly.blocks[1].fixed);
  EXPECT_TRUE(import.assembly.blocks[2].fixed);
  options.fixed = "none";
  EXPECT_EQ(import_blocks(folder / "p.obj", options).notes.size(), 1u);
  options.fixed = "base";
  EXPECT_NE(message_of<InputError>([&] { import_blocks(folder / "p.obj", options); }).find("no stone 'base'"),
            std::string::npos);
}

TEST(Import, AnOpenShapeIsNamedWithItsLine) {
  const Folder folder;
  int first = 1;
  Polyhedron open = make_box({0, 0, 1}, {1, 1, 2});
  open.faces.pop_back();
  const std::string good = obj_text(make_box({0, 0, 0}, {1, 1, 1}), "good", first);
  set_bytes(folder / "o.obj", good + obj_text(open, "leaky", first));
  const std::string message = message_of<InputError>([&] { import_blocks(folder / "o.obj"); });
  EXPECT_NE(message.find("o.obj:25: object 'leaky'"), std::string::npos) << message;  // 15 lines, o, 8 v, first f
  EXPECT_NE(message.find("4 edges"), std::string::npos) << message;
}

TEST(Import, ANonConvexShapeIsNamed) {
  const Folder folder;
  int first = 1;
  // A dart: the fourth corner pushed in.
  const Polyhedron dart = make_prism({{0, 0, 0}, {2, 0, 0}, {0.4, 0.4, 0}, {0, 2, 0}}, {0, 0, 1});
  set_bytes(folder / "d.obj", obj_text(dart, "dart", first));
  const std::string message = message_of<InputError>([&] { import_blocks(folder / "d.obj"); });
  EXPECT_NE(message.find("'dart'"), std::string::npos) << message;
  EXPECT_NE(message.find("not a convex stone"), std::string::npos) << message;
}

TEST(Import, AFlatShapeIsNamed) {
  const Folder folder;
  set_bytes(folder / "f.obj", "o sheet\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n");
  const std::string message = message_of<InputError>([&] { import_blocks(folder / "f.obj"); });
  EXPECT_NE(message.find("'sheet' encloses no volume"), std::string::npos) << message;
}

TEST(Import, OverlapsAreNamedWithBothStones) {
  const Folder folder;
  int first = 1;
  const std::string lower = obj_text(make_box({0, 0, 0}, {1, 1, 1}), "lower", first);
  set_bytes(folder / "x.obj", lower + obj_text(make_box({0.2, 0, 0.9}, {1.2, 1, 1.9}), "upper", first));
  const std::string message = message_of<InputError>([&] { import_blocks(folder / "x.obj"); });
  EXPECT_NE(message.find("'lower'"), std::string::npos) << message;
  EXPECT_NE(message.find("'upper'"), std::string::npos) << message;
  EXPECT_NE(message.find("0.1 m"), std::string::npos) << message;
}

TEST(Import, BadTextIsNamedWithItsLine) {
  const Folder folder;
  const auto message = [&](const std::string& text) {
    set_bytes(folder / "b.obj", text);
    return message_of<InputError>([&] { import_blocks(folder / "b.obj"); });
  };
  EXPECT_NE(message("v 0 0 0\nv 1 nan 0\n").find("b.obj:2"), std::string::npos);
  EXPECT_NE(message("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n").find("b.obj:4: face corner '4'"), std::string::npos);
  EXPECT_NE(message("v 0 0 0\nf 1 1\n").find("it needs at least 3"), std::string::npos);
  EXPECT_NE(message("# empty\n").find("no faces"), std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { import_blocks(folder / "a.dae"); }).find("no such file"), std::string::npos);
  set_bytes(folder / "a.dae", "x");
  EXPECT_NE(message_of<InputError>([&] { import_blocks(folder / "a.dae"); }).find("'.dae'"), std::string::npos);
}
}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
