// Stones from surface files: shapes that are drawn coarsely, warped, far away, the wrong way up; pieces of one stone.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>

#include "io/case/material_table.h"
#include "io/hdf5/assembly_file.h"
#include "io/vtk/import.h"
#include "io/vtk/shells.h"
#include "io/vtk/surface_file.h"
#include "solver/base/error.h"
#include "tests/folder.h"
#include "tests/viz/scenes.h"
#include "tests/viz/surface_texts.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using namespace test;

TEST(Import, ShapeDoesNotDependOnTriangulation) {
  const Folder folder;
  const Polyhedron stone = test::voussoir_stone(3.0, 3.6, 0.3, 0.5, 1.2);
  int first = 1;
  set_bytes(folder / "loops.obj", obj_text(stone, "s", first));
  Polyhedron soup{stone.vertices, {}};
  for (const auto& t : triangles(stone)) soup.faces.push_back({t[1], t[2], t[0]});
  first = 1;
  set_bytes(folder / "triangles.obj", obj_text(soup, "s", first));
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

/// Coordinates to the millimetre: faces are warped by half of one, which is no shape.
TEST(Import, ADomeInMillimetresIsTheSameDome) {
  const Folder folder;
  set_bytes(folder / "exact.obj", obj_of(dome(0.0)));
  set_bytes(folder / "mm.obj", obj_of(dome(1.0)));
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
  EXPECT_TRUE(has_note(
      rounded, "stones had faces that were not plane; the program has made them plane and moved corners by up to"));
}

/// The same in triangles and single precision, far from the origin.
TEST(Import, ADomeInSinglePrecisionFarAway) {
  const Folder folder;
  std::vector<Polyhedron> shapes;
  for (auto& [name, shape] : dome(0.0)) {
    for (Vec3& v : shape.vertices) v = (v + Vec3(1000, 2000, 30)).cast<float>().cast<double>();
    shapes.push_back(shape);
  }
  set_bytes(folder / "far.stl", stl_text(shapes, false));
  const Import import = import_blocks(folder / "far.stl");
  EXPECT_EQ(import.assembly.blocks.size(), 24u);
  EXPECT_EQ(import.assembly.joints.size(), 24u);
}

TEST(Import, AWarpThatIsAShapeIsNamedWithTheOptionThatAllowsIt) {
  const Folder folder;
  Polyhedron warped = make_box({0, 0, 1}, {1, 1, 2});
  for (Vec3& p : warped.vertices)
    if (p.z() > 1.5) p.z() += (p.x() > 0.5) == (p.y() > 0.5) ? 0.012 : -0.012;
  set_bytes(folder / "w.obj", obj_of({{"flat", make_box({0, 0, 0}, {1, 1, 1})}, {"warped", warped}}));
  ImportOptions options;
  const std::string message = message_of<InputError>([&] { import_blocks(folder / "w.obj", options); });
  for (const char* piece : {"'warped'", "0.012 m", "--flatten 0.001", "Give --flatten 0.01"})
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
  set_bytes(folder / "twice.obj", text);
  const Import import = import_blocks(folder / "twice.obj");
  EXPECT_EQ(import.assembly.blocks.size(), 2u);
  EXPECT_EQ(import.assembly.joints.size(), 1u);
  EXPECT_TRUE(has_note(import, "'low': 6 faces occur twice"));
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
  set_bytes(folder / "y.obj", obj_of(stones));
  ImportOptions options;
  const Import flat = import_blocks(folder / "y.obj", options);
  EXPECT_TRUE(has_note(flat, "every stone is fixed"));
  EXPECT_TRUE(has_note(flat, "3 of 3 stones reach the lowest point and are fixed; with --up y there would be 1"));
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
  set_bytes(folder / "a.obj", obj_of({{"a", make_box({0, 0, 0}, {1, 1, 1})}, {"b", make_box({0, 0, 1.1}, {1, 1, 2})}}));
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
    EXPECT_TRUE(has_note(import, "1 stone consists of several cells, 2 cells in all"));
  };
  ImportOptions options;
  // Two closed shapes of one object.
  std::string text = obj_of({{"pier", pier}, {"corbel", shaft}});
  int first = 17;
  const std::string second = obj_text(head, "corbel", first);
  set_bytes(folder / "o.obj", text + second.substr(second.find('\n') + 1));
  EXPECT_EQ(import_blocks(folder / "o.obj", options).assembly.blocks.size(), 3u);
  options.cells = CellRule::objects;
  expect_corbel(import_blocks(folder / "o.obj", options), 1);
  // Two objects, by their names.
  set_bytes(folder / "n.obj", obj_of({{"pier", pier}, {"corbel.1", shaft}, {"corbel.2", head}}));
  EXPECT_EQ(import_blocks(folder / "n.obj", options).assembly.blocks.size(), 3u);
  options.cells = CellRule::names;
  expect_corbel(import_blocks(folder / "n.obj", options), 1);
  // Pieces that do not touch are no stone.
  set_bytes(folder / "p.obj",
            obj_of({{"pier", pier}, {"corbel.1", shaft}, {"corbel.2", make_box({0, 0, 3}, {1, 1, 4})}}));
  EXPECT_NE(message_of<InputError>([&] { import_blocks(folder / "p.obj", options); }).find("the pieces of 'corbel'"),
            std::string::npos);
  // Drawn as one shape, it is told how to be cut.
  const Polyhedron whole =
      make_prism({{0, 0, 1}, {0.5, 0, 1}, {0.5, 0, 2.2}, {1.2, 0, 2.2}, {1.2, 0, 2.5}, {0, 0, 2.5}}, {0, 0.5, 0});
  set_bytes(folder / "w.obj", obj_of({{"pier", pier}, {"corbel", whole}}));
  const std::string message = message_of<InputError>([&] { import_blocks(folder / "w.obj"); });
  EXPECT_NE(message.find("Put the pieces into one object and give --cells objects"), std::string::npos) << message;
}

TEST(Import, MaterialsByObject) {
  const Folder folder;
  set_bytes(folder / "p.obj", obj_of({{"sill", make_box({0, 0, 0}, {1, 1, 1})},
                                      {"clamp a", make_box({0, 0, 1}, {1, 1, 2})},
                                      {"clamp b", make_box({0, 0, 2}, {1, 1, 3})},
                                      {"cap", make_box({0, 0, 3}, {1, 1, 4})}}));
  const auto imported = [&](const std::string& table) {
    set_bytes(folder / "m.toml", table);
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
  EXPECT_NE(refused("[materials.a]\n[materials.b]\n").find("Only one"), std::string::npos);
  EXPECT_NE(refused("lead = 1\n").find("m.toml:1"), std::string::npos);
}

/// An assembly of another program: what it leaves out is found, and options change what they name.
TEST(Import, AnAssemblyFile) {
  const Folder folder;
  set_bytes(folder / "p.obj", obj_of({{"a", make_box({0, 0, 0}, {1, 1, 1})},
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
  EXPECT_TRUE(has_note(again, "has ignored its 1 joint and has found 2 joints"));
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
  EXPECT_TRUE(has_note(filled, "the file states only densities"));
  // What shapes do not tell is not thrown away.
  first.laws[0].kind = JointLaw::Kind::tie;
  write_assembly(folder / "own.h5", first);
  EXPECT_NE(message_of<InputError>([&] { import_blocks(folder / "own.h5", options); }).find("it has ties"),
            std::string::npos);
  options.scale = 0.001;
  EXPECT_NE(message_of<InputError>([&] { import_blocks(folder / "own.h5", options); }).find("--scale"),
            std::string::npos);
}
}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
