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
#include "tests/viz/folder.h"
#include "tests/viz/scenes.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::Folder;
using test::message_of;
using test::write_text;

std::vector<std::array<int, 3>> triangles(const Polyhedron& shape) {
  std::vector<std::array<int, 3>> out;
  for (const auto& loop : shape.faces)
    for (std::size_t k = 1; k + 1 < loop.size(); ++k) out.push_back({loop[0], loop[k], loop[k + 1]});
  return out;
}

std::string obj_text(const Polyhedron& shape, const std::string& name, int& first, bool reversed = false) {
  std::string text = "o " + name + "\n";
  for (const Vec3& v : shape.vertices) text += fmt::format("v {} {} {}\n", v.x(), v.y(), v.z());
  for (auto loop : shape.faces) {
    if (reversed) std::reverse(loop.begin(), loop.end());
    text += "f";
    for (int v : loop) text += fmt::format(" {}//1", v + first);
    text += "\n";
  }
  first += int(shape.vertices.size());
  return text;
}

std::string stl_text(const std::vector<Polyhedron>& shapes, bool one_solid) {
  std::string text = one_solid ? "solid all\n" : "";
  for (std::size_t i = 0; i < shapes.size(); ++i) {
    if (!one_solid) text += fmt::format("solid s{}\n", i);
    for (const auto& t : triangles(shapes[i])) {
      text += "facet normal 0 0 0\nouter loop\n";
      for (int v : t) {
        const Vec3& p = shapes[i].vertices[v];
        text += fmt::format("vertex {} {} {}\n", p.x(), p.y(), p.z());
      }
      text += "endloop\nendfacet\n";
    }
    if (!one_solid) text += fmt::format("endsolid s{}\n", i);
  }
  return text + (one_solid ? "endsolid all\n" : "");
}

std::string ply_text(const std::vector<Polyhedron>& shapes) {
  std::string vertices, faces;
  int first = 0, count = 0;
  for (const Polyhedron& shape : shapes) {
    for (const Vec3& v : shape.vertices) vertices += fmt::format("{} {} {}\n", v.x(), v.y(), v.z());
    for (const auto& t : triangles(shape)) {
      faces += fmt::format("3 {} {} {}\n", t[0] + first, t[1] + first, t[2] + first);
      ++count;
    }
    first += int(shape.vertices.size());
  }
  return fmt::format(
             "ply\nformat ascii 1.0\nelement vertex {}\nproperty float x\nproperty float y\nproperty float z\n"
             "element face {}\nproperty list uchar int vertex_indices\nend_header\n",
             first, count) +
         vertices + faces;
}

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
  write_text(folder / "pile.obj", text);
  const Import import = import_blocks(folder / "pile.obj");
  expect_pile(import);
  EXPECT_EQ(import.names[1], "stone 1");
  EXPECT_EQ(import.assembly.groups.at("object stone 1"), std::vector<std::int64_t>{1});
  EXPECT_TRUE(import.notes.empty());
}

TEST(Import, StlShellsAreToldApartEvenWhereTheyTouch) {
  const Folder folder;
  write_text(folder / "one.stl", stl_text(pile(), true));
  expect_pile(import_blocks(folder / "one.stl"));
  write_text(folder / "many.STL", stl_text(pile(), false));
  expect_pile(import_blocks(folder / "many.STL"));
}

TEST(Import, PlyInMillimetres) {
  const Folder folder;
  auto shapes = pile();
  for (auto& shape : shapes)
    for (Vec3& v : shape.vertices) v *= 500.0;
  write_text(folder / "pile.ply", ply_text(shapes));
  ImportOptions options;
  options.scale = 0.001;
  expect_pile(import_blocks(folder / "pile.ply", options), 0.5);
}

TEST(Import, InsideOutStonesAreTurnedAndSaid) {
  const Folder folder;
  int first = 1;
  const auto shapes = pile();
  const std::string good = obj_text(shapes[0], "good", first);  // `first` counts on from one to the next
  write_text(folder / "a.obj", good + obj_text(shapes[1], "turned", first, true));
  const Import import = import_blocks(folder / "a.obj");
  ASSERT_EQ(import.notes.size(), 1u);
  EXPECT_NE(import.notes[0].find("'turned'"), std::string::npos);
  EXPECT_GT(import.assembly.blocks[1].mass, 0.0);
  // All of a triangle soup the wrong way round.
  auto mirrored = shapes;
  for (auto& shape : mirrored)
    for (auto& loop : shape.faces) std::reverse(loop.begin(), loop.end());
  write_text(folder / "soup.stl", stl_text(mirrored, true));
  const Import soup = import_blocks(folder / "soup.stl");
  expect_pile(soup);
  EXPECT_EQ(soup.notes.size(), 3u);
}

TEST(Import, NegativeIndicesGroupsAndContinuedLines) {
  const Folder folder;
  write_text(folder / "t.obj",
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
  write_text(folder / "p.obj", text);
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
  write_text(folder / "o.obj", good + obj_text(open, "leaky", first));
  const std::string message = message_of<InputError>([&] { import_blocks(folder / "o.obj"); });
  EXPECT_NE(message.find("o.obj:25: object 'leaky'"), std::string::npos) << message;  // 15 lines, o, 8 v, first f
  EXPECT_NE(message.find("4 edges"), std::string::npos) << message;
}

TEST(Import, ANonConvexShapeIsNamed) {
  const Folder folder;
  int first = 1;
  // A dart: the fourth corner pushed in.
  const Polyhedron dart = make_prism({{0, 0, 0}, {2, 0, 0}, {0.4, 0.4, 0}, {0, 2, 0}}, {0, 0, 1});
  write_text(folder / "d.obj", obj_text(dart, "dart", first));
  const std::string message = message_of<InputError>([&] { import_blocks(folder / "d.obj"); });
  EXPECT_NE(message.find("'dart'"), std::string::npos) << message;
  EXPECT_NE(message.find("not a convex stone"), std::string::npos) << message;
}

TEST(Import, AFlatShapeIsNamed) {
  const Folder folder;
  write_text(folder / "f.obj", "o sheet\nv 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\nf 3 2 1\n");
  const std::string message = message_of<InputError>([&] { import_blocks(folder / "f.obj"); });
  EXPECT_NE(message.find("'sheet' bounds no volume"), std::string::npos) << message;
}

TEST(Import, OverlapsAreNamedWithBothStones) {
  const Folder folder;
  int first = 1;
  const std::string lower = obj_text(make_box({0, 0, 0}, {1, 1, 1}), "lower", first);
  write_text(folder / "x.obj", lower + obj_text(make_box({0.2, 0, 0.9}, {1.2, 1, 1.9}), "upper", first));
  const std::string message = message_of<InputError>([&] { import_blocks(folder / "x.obj"); });
  EXPECT_NE(message.find("'lower'"), std::string::npos) << message;
  EXPECT_NE(message.find("'upper'"), std::string::npos) << message;
  EXPECT_NE(message.find("0.1 m"), std::string::npos) << message;
}

TEST(Import, BadTextIsNamedWithItsLine) {
  const Folder folder;
  const auto message = [&](const std::string& text) {
    write_text(folder / "b.obj", text);
    return message_of<InputError>([&] { import_blocks(folder / "b.obj"); });
  };
  EXPECT_NE(message("v 0 0 0\nv 1 nan 0\n").find("b.obj:2"), std::string::npos);
  EXPECT_NE(message("v 0 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 4\n").find("b.obj:4: face corner '4'"), std::string::npos);
  EXPECT_NE(message("v 0 0 0\nf 1 1\n").find("three corners"), std::string::npos);
  EXPECT_NE(message("# empty\n").find("no faces"), std::string::npos);
  EXPECT_NE(message_of<InputError>([&] { import_blocks(folder / "a.dae"); }).find("no such file"), std::string::npos);
  write_text(folder / "a.dae", "x");
  EXPECT_NE(message_of<InputError>([&] { import_blocks(folder / "a.dae"); }).find("'.dae'"), std::string::npos);
}

TEST(Import, ShapeDoesNotDependOnTriangulation) {
  const Folder folder;
  const Polyhedron stone = test::voussoir_stone(3.0, 3.6, 0.3, 0.5, 1.2);
  int first = 1;
  write_text(folder / "loops.obj", obj_text(stone, "s", first));
  Polyhedron soup{stone.vertices, {}};
  for (const auto& t : triangles(stone)) soup.faces.push_back({t[1], t[2], t[0]});
  first = 1;
  write_text(folder / "triangles.obj", obj_text(soup, "s", first));
  const auto a = import_blocks(folder / "loops.obj"), b = import_blocks(folder / "triangles.obj");
  EXPECT_EQ(b.assembly.blocks[0].cells[0].faces.size(), 6u);
  EXPECT_NEAR(a.assembly.blocks[0].mass, b.assembly.blocks[0].mass, 1e-9);
  EXPECT_NEAR(a.assembly.blocks[0].mass, 2000.0 * 0.5 * std::sin(0.2) * (3.6 * 3.6 - 9.0) * 1.2, 1e-9);
}

/// Two rings of stones of a dome, each between two cones; the lower ring stands on the ground. Twelve stones a ring.
std::vector<std::pair<std::string, Polyhedron>> dome(double thousandths) {
  std::vector<std::pair<std::string, Polyhedron>> stones;
  const auto at = [&](double radius, double height, double turn) {
    const Vec3 p(radius * std::cos(turn), radius * std::sin(turn), height);
    const auto rounded = [&](double x) { return std::round(x * 1000.0) / 1000.0; };
    return thousandths > 0.0 ? Vec3(rounded(p.x()), rounded(p.y()), rounded(p.z())) : p;
  };
  const double ring[3][4] = {{5.0, 0.0, 5.4, 0.0}, {4.9, 0.8, 5.28, 0.9}, {4.6, 1.6, 4.95, 1.8}};
  for (int r = 0; r < 2; ++r)
    for (int k = 0; k < 12; ++k) {
      Polyhedron stone;
      for (const int level : {r, r + 1})
        for (const double turn : {2.0 * M_PI * k / 12, 2.0 * M_PI * (k + 1) / 12})
          for (const int side : {0, 2}) stone.vertices.push_back(at(ring[level][side], ring[level][side + 1], turn));
      // 0 inner, 1 outer, both at the first turn; 2, 3 at the second; 4 to 7 above.
      stone.faces = {{0, 2, 3, 1}, {4, 5, 7, 6}, {0, 4, 6, 2}, {1, 3, 7, 5}, {0, 1, 5, 4}, {2, 6, 7, 3}};
      stones.emplace_back(fmt::format("c{}_{}", r, k), stone);
    }
  return stones;
}

std::string obj_of(const std::vector<std::pair<std::string, Polyhedron>>& stones) {
  std::string text;
  int first = 1;
  for (const auto& [name, shape] : stones) text += obj_text(shape, name, first);
  return text;
}

bool has_note(const Import& import, const std::string& piece) {
  return std::any_of(import.notes.begin(), import.notes.end(),
                     [&](const std::string& note) { return note.find(piece) != std::string::npos; });
}

/// Coordinates to the millimetre: faces are warped by half of one, which is no shape.
TEST(Import, ADomeInMillimetresIsTheSameDome) {
  const Folder folder;
  write_text(folder / "exact.obj", obj_of(dome(0.0)));
  write_text(folder / "mm.obj", obj_of(dome(1.0)));
  const Import exact = import_blocks(folder / "exact.obj"), rounded = import_blocks(folder / "mm.obj");
  EXPECT_TRUE(exact.notes.empty());
  for (const Import* import : {&exact, &rounded}) {
    EXPECT_EQ(import->assembly.blocks.size(), 24u);
    EXPECT_EQ(import->assembly.joints.size(), 24u);  // 12 between the rings, 12 within the upper one
  }
  double mass = 0.0, change = 0.0;
  for (std::size_t i = 0; i < 24; ++i) {
    mass += exact.assembly.blocks[i].mass;
    change += rounded.assembly.blocks[i].mass - exact.assembly.blocks[i].mass;
  }
  EXPECT_LT(std::abs(change), 1e-3 * mass);
  EXPECT_TRUE(has_note(rounded, "stones had faces that are not plane; corners were moved by up to"));
}

/// The same in triangles and single precision, far from the origin.
TEST(Import, ADomeInSinglePrecisionFarAway) {
  const Folder folder;
  std::vector<Polyhedron> shapes;
  for (auto& [name, shape] : dome(0.0)) {
    for (Vec3& v : shape.vertices) v = (v + Vec3(1000, 2000, 30)).cast<float>().cast<double>();
    shapes.push_back(shape);
  }
  write_text(folder / "far.stl", stl_text(shapes, false));
  const Import import = import_blocks(folder / "far.stl");
  EXPECT_EQ(import.assembly.blocks.size(), 24u);
  EXPECT_EQ(import.assembly.joints.size(), 24u);
}

TEST(Import, AWarpThatIsAShapeIsNamedWithTheOptionThatAllowsIt) {
  const Folder folder;
  Polyhedron warped = make_box({0, 0, 1}, {1, 1, 2});
  for (Vec3& p : warped.vertices)
    if (p.z() > 1.5) p.z() += (p.x() > 0.5) == (p.y() > 0.5) ? 0.012 : -0.012;
  write_text(folder / "w.obj", obj_of({{"flat", make_box({0, 0, 0}, {1, 1, 1})}, {"warped", warped}}));
  ImportOptions options;
  const std::string message = message_of<InputError>([&] { import_blocks(folder / "w.obj", options); });
  for (const char* piece : {"'warped'", "0.012 m", "--flatten 0.001", "give --flatten 0.01"})
    EXPECT_NE(message.find(piece), std::string::npos) << message;
  options.flatten = 0.01;
  const Import import = import_blocks(folder / "w.obj", options);
  EXPECT_NEAR(import.assembly.blocks[1].mass, 2000.0, 1e-6);
  EXPECT_EQ(import.assembly.joints.size(), 1u);
}

TEST(Import, FacesThatStandTwiceAreTakenOnce) {
  const Folder folder;
  std::string text;
  int first = 1;
  for (const auto& [name, shape] :
       {std::pair{"low", make_box({0, 0, 0}, {1, 1, 1})}, {"high", make_box({0, 0, 1}, {1, 1, 2})}}) {
    const std::string once = obj_text(shape, name, first);
    text += once + once.substr(once.find("f "));
  }
  write_text(folder / "twice.obj", text);
  const Import import = import_blocks(folder / "twice.obj");
  EXPECT_EQ(import.assembly.blocks.size(), 2u);
  EXPECT_EQ(import.assembly.joints.size(), 1u);
  EXPECT_TRUE(has_note(import, "'low': 6 faces stand there twice"));
}

/// An arch drawn with y up lies on its side when z is taken for it.
TEST(Import, TheWayUp) {
  const Folder folder;
  std::vector<std::pair<std::string, Polyhedron>> stones;
  for (int k = 0; k < 3; ++k) {
    Polyhedron box = make_box({0, 0, 0.4 * k}, {1, 2, 0.4 * (k + 1)});
    for (Vec3& p : box.vertices) p = Vec3(p.x(), p.z(), -p.y());  // y up
    stones.emplace_back(fmt::format("s{}", k), box);
  }
  write_text(folder / "y.obj", obj_of(stones));
  ImportOptions options;
  const Import flat = import_blocks(folder / "y.obj", options);
  EXPECT_TRUE(has_note(flat, "every stone is fixed"));
  EXPECT_TRUE(has_note(flat, "3 of 3 stones reach down to the lowest point and are fixed; with --up y it would be 1"));
  options.up = "y";
  const Import right = import_blocks(folder / "y.obj", options);
  EXPECT_TRUE(right.notes.empty());
  EXPECT_EQ(right.assembly.joints.size(), 2u);
  EXPECT_NEAR(right.assembly.blocks[2].centroid.z(), 1.0, 1e-12);
  EXPECT_NEAR(right.assembly.blocks[2].centroid.y(), 1.0, 1e-12);  // turned, not mirrored
  // The axis that is named points up afterwards, whichever it is.
  for (const char* up : {"x", "y", "z", "-x", "-y", "-z"}) {
    options.up = up;
    options.fixed = "s0";
    const Vec3 axis = Vec3::Unit(std::string("xyz").find(up[std::strlen(up) - 1])) * (up[0] == '-' ? -1.0 : 1.0);
    const Assembly turned = import_blocks(folder / "y.obj", options).assembly;
    const Vec3 centre = mass_properties(stones[2].second).centroid;
    EXPECT_NEAR(turned.blocks[2].centroid.z(), centre.dot(axis), 1e-12) << up;
    EXPECT_NEAR(turned.blocks[2].mass, 1600.0, 1e-9) << up;
  }
  options.up = "w";
  EXPECT_NE(message_of<InputError>([&] { import_blocks(folder / "y.obj", options); }).find("--up is 'w'"),
            std::string::npos);
}

TEST(Import, StonesThatDoNotTouchAreSaid) {
  const Folder folder;
  write_text(folder / "a.obj",
             obj_of({{"a", make_box({0, 0, 0}, {1, 1, 1})}, {"b", make_box({0, 0, 1.1}, {1, 1, 2})}}));
  EXPECT_TRUE(has_note(import_blocks(folder / "a.obj"), "no joint was found"));
}

/// A corbel of two boxes: as cells of one stone it has the joints of one, and its weight on the pier.
TEST(Import, PiecesBecomeCellsOfOneStone) {
  const Folder folder;
  const Polyhedron pier = make_box({0, 0, 0}, {0.5, 0.5, 1}), shaft = make_box({0, 0, 1}, {0.5, 0.5, 2.2}),
                   head = make_box({0, 0, 2.2}, {1.2, 0.5, 2.5});
  const auto expect_corbel = [&](const Import& import, std::size_t joints) {
    ASSERT_EQ(import.assembly.blocks.size(), 2u);
    EXPECT_EQ(import.assembly.joints.size(), joints);
    EXPECT_EQ(import.assembly.blocks[1].cells.size(), 2u);
    EXPECT_NEAR(import.assembly.blocks[1].mass, 2000.0 * 0.5 * (0.5 * 1.2 + 1.2 * 0.3), 1e-9);
    EXPECT_EQ(import.assembly.groups.at("object corbel"), std::vector<std::int64_t>{1});
    EXPECT_TRUE(has_note(import, "1 stones are made of several cells, 2 cells in all"));
  };
  ImportOptions options;
  // Two closed shapes of one object.
  std::string text = obj_of({{"pier", pier}, {"corbel", shaft}});
  int first = 17;
  const std::string second = obj_text(head, "corbel", first);
  write_text(folder / "o.obj", text + second.substr(second.find('\n') + 1));
  EXPECT_EQ(import_blocks(folder / "o.obj", options).assembly.blocks.size(), 3u);
  options.cells = CellRule::objects;
  expect_corbel(import_blocks(folder / "o.obj", options), 1);
  // Two objects, by their names.
  write_text(folder / "n.obj", obj_of({{"pier", pier}, {"corbel.1", shaft}, {"corbel.2", head}}));
  EXPECT_EQ(import_blocks(folder / "n.obj", options).assembly.blocks.size(), 3u);
  options.cells = CellRule::names;
  expect_corbel(import_blocks(folder / "n.obj", options), 1);
  // Pieces that do not touch are no stone.
  write_text(folder / "p.obj",
             obj_of({{"pier", pier}, {"corbel.1", shaft}, {"corbel.2", make_box({0, 0, 3}, {1, 1, 4})}}));
  EXPECT_NE(message_of<InputError>([&] { import_blocks(folder / "p.obj", options); }).find("the pieces of 'corbel'"),
            std::string::npos);
  // Drawn as one shape, it is told how to be cut.
  const Polyhedron whole =
      make_prism({{0, 0, 1}, {0.5, 0, 1}, {0.5, 0, 2.2}, {1.2, 0, 2.2}, {1.2, 0, 2.5}, {0, 0, 2.5}}, {0, 0.5, 0});
  write_text(folder / "w.obj", obj_of({{"pier", pier}, {"corbel", whole}}));
  const std::string message = message_of<InputError>([&] { import_blocks(folder / "w.obj"); });
  EXPECT_NE(message.find("leave these in one object and give --cells objects"), std::string::npos) << message;
}

TEST(Import, MaterialsByObject) {
  const Folder folder;
  write_text(folder / "p.obj", obj_of({{"sill", make_box({0, 0, 0}, {1, 1, 1})},
                                       {"clamp a", make_box({0, 0, 1}, {1, 1, 2})},
                                       {"clamp b", make_box({0, 0, 2}, {1, 1, 3})},
                                       {"cap", make_box({0, 0, 3}, {1, 1, 4})}}));
  const auto imported = [&](const std::string& table) {
    write_text(folder / "m.toml", table);
    ImportOptions options;
    options.materials = read_material_table(folder / "m.toml", options.material);
    return import_blocks(folder / "p.obj", options).assembly;
  };
  const std::string iron = "[materials.iron]\nobjects = [\"clamp*\"]\ndensity = 7800\nyoungs_modulus = 2e11\n";
  const Assembly a = imported(iron);
  ASSERT_EQ(a.materials.size(), 2u);
  EXPECT_EQ(a.materials[0].name, "iron");
  EXPECT_EQ(a.materials[1].name, "stone");
  EXPECT_EQ(a.materials[0].shear_modulus, 1.6e9);  // as of all
  EXPECT_NEAR(a.blocks[1].mass, 7800.0, 1e-9);
  EXPECT_NEAR(a.blocks[3].mass, 2000.0, 1e-9);
  EXPECT_NEAR(a.joints[2].kn, 1.0 / (0.5 / 2e11 + 0.5 / 4e9), 1.0);  // clamp b and cap
  const Assembly b = imported(iron + "[materials.lime]\ndensity = 1700\n");
  EXPECT_EQ(b.materials.size(), 2u);
  EXPECT_NEAR(b.blocks[3].mass, 1700.0, 1e-9);
  const auto refused = [&](const std::string& table) { return message_of<InputError>([&] { imported(table); }); };
  EXPECT_NE(refused(iron + "[materials.lead]\nobjects = \"clamp b\"\n").find("fits two materials"), std::string::npos);
  EXPECT_NE(refused("[materials.lead]\nobjects = \"peg\"\n").find("no object has such a name"), std::string::npos);
  EXPECT_NE(refused("[materials.lead]\ndensity = -1\n").find("m.toml:2"), std::string::npos);
  EXPECT_NE(refused("[materials.a]\n[materials.b]\n").find("only one"), std::string::npos);
  EXPECT_NE(refused("lead = 1\n").find("m.toml:1"), std::string::npos);
}

/// An assembly of another program: what it leaves out is found, and options change what they name.
TEST(Import, AnAssemblyFile) {
  const Folder folder;
  write_text(folder / "p.obj", obj_of({{"a", make_box({0, 0, 0}, {1, 1, 1})},
                                       {"b", make_box({0, 0, 1}, {1, 1, 2})},
                                       {"c", make_box({0, 0, 2}, {1, 1, 3})}}));
  Assembly first = import_blocks(folder / "p.obj").assembly;
  first.materials[0] = {"own", 1700.0, 3e9, 1e9, 0.0, 0.0, 0.4};
  finish_blocks(first);
  first.joints.pop_back();
  write_assembly(folder / "own.h5", first);
  ImportOptions options;
  options.keep_fixed = true;
  options.material.cohesion = 7e4;
  options.given = {&Material::cohesion};
  const Import again = import_blocks(folder / "own.h5", options);
  EXPECT_EQ(again.assembly.joints.size(), 2u);
  EXPECT_TRUE(has_note(again, "its 1 joints have been left out, and 2 found anew"));
  EXPECT_EQ(again.assembly.materials[0].youngs_modulus, 3e9);
  EXPECT_EQ(again.assembly.materials[0].friction_angle, 0.4);
  EXPECT_EQ(again.assembly.laws.at(0).cohesion, 7e4);
  EXPECT_TRUE(again.assembly.blocks[0].fixed);
  options.keep_fixed = false;
  options.fixed = "c";
  EXPECT_TRUE(import_blocks(folder / "own.h5", options).assembly.blocks[2].fixed);
  // Densities alone: the rest is as the options say.
  first.materials[0] = {"material 0", 1700.0};
  write_assembly(folder / "own.h5", first);
  const Import filled = import_blocks(folder / "own.h5", options);
  EXPECT_EQ(filled.assembly.materials[0].density, 1700.0);
  EXPECT_EQ(filled.assembly.materials[0].youngs_modulus, 4e9);
  EXPECT_TRUE(has_note(filled, "it states densities alone"));
  // What shapes do not tell is not thrown away.
  first.laws[0].kind = JointLaw::Kind::tie;
  write_assembly(folder / "own.h5", first);
  EXPECT_NE(message_of<InputError>([&] { import_blocks(folder / "own.h5", options); }).find("it holds ties"),
            std::string::npos);
  options.scale = 0.001;
  EXPECT_NE(message_of<InputError>([&] { import_blocks(folder / "own.h5", options); }).find("--scale"),
            std::string::npos);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
