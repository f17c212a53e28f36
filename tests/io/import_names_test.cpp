// Stones drawn elsewhere that become parts of a bridge by their names, and shapes that are not convex.
#include <gtest/gtest.h>

#include "io/hdf5/assembly_file.h"
#include "io/hdf5/h5.h"
#include "io/vtk/import.h"
#include "solver/base/error.h"
#include "tests/folder.h"
#include "tests/viz/surface_texts.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using namespace test;

/// Two feet, a lintel of three stones between them, and a corbel of two pieces on the right one.
std::string doorway() {
  return obj_of({{"foot left", make_box({0, 0, 0}, {1, 1, 1})},
                 {"foot right", make_box({3, 0, 0}, {4, 1, 1})},
                 {"lintel_1", make_box({0, 0, 1}, {1.5, 1, 2})},
                 {"lintel_2", make_box({1.5, 0, 1}, {2.5, 1, 2})},
                 {"lintel_3", make_box({2.5, 0, 1}, {4, 1, 2})},
                 {"corbel a", make_box({3, 0, 2}, {4, 1, 3})},
                 {"corbel b", make_box({3, 0, 3}, {5, 1, 3.5})}});
}

Import import_with(const std::string& shapes, const std::string& names, ImportOptions options = {},
                   const std::string& file = "stones.obj") {
  const Folder folder;
  if (!names.empty()) options.map = read_name_map(folder.write("names.toml", names), options.material);
  options.keep_fixed = true;  // as the program does where --fixed is not given
  return import_blocks(folder.write(file, shapes), options);
}

TEST(ImportNames, GiveComponentsMaterialsGroupsAndCells) {
  const Import import = import_with(doorway(), R"(
[names]
"foot*" = {component = "base", fixed = true, material = "granite"}
"foot left" = {group = "base abutment left"}
"foot right" = {part = 1, group = "base abutment right"}
"lintel_*" = {component = "arch", part = 0}
"lintel_2" = {group = "keystone 0"}
"corbel *" = {component = "parapet", block = "corbel"}
[materials.granite]
density = 2700
)");
  const Assembly& a = import.assembly;
  ASSERT_EQ(a.blocks.size(), 6u);
  EXPECT_EQ(a.blocks[5].cells.size(), 2u);
  EXPECT_EQ(a.blocks[5].component, Component::parapet);
  EXPECT_EQ(a.blocks[1].component, Component::base);
  EXPECT_EQ(a.blocks[1].part, 1);
  EXPECT_EQ(a.blocks[3].component, Component::arch);
  EXPECT_NEAR(a.blocks[0].mass, 2700.0, 1e-9);
  EXPECT_NEAR(a.blocks[3].mass, 2000.0, 1e-9);
  for (std::size_t i = 0; i < 6; ++i) EXPECT_EQ(a.blocks[i].fixed, i < 2) << i;
  EXPECT_EQ(a.groups.at("keystone 0"), std::vector<std::int64_t>{3});
  EXPECT_EQ(a.groups.at("base abutment right"), std::vector<std::int64_t>{1});
  EXPECT_EQ(a.groups.at("object corbel"), std::vector<std::int64_t>{5});
  EXPECT_EQ(a.joints.size(), 5u);
  EXPECT_EQ(import.notes.size(), 1u) << import.notes[1];  // the cells
}

TEST(ImportNames, WhatDoesNotFitIsSaid) {
  const Import import = import_with(doorway(), R"(
object_groups = false
[names]
"lintel*" = {component = "arch"}
"keystone*" = {group = "keystone 0"}
[layers]
"Deck" = {component = "parapet"}
[materials.granite]
density = 2700
)");
  const auto said = [&](const std::string& piece) {
    return std::any_of(import.notes.begin(), import.notes.end(),
                       [&](const std::string& note) { return note.find(piece) != std::string::npos; });
  };
  EXPECT_TRUE(said("names.toml: no object fits 'keystone*'"));
  EXPECT_TRUE(said("names.toml: no layer of the drawing fits 'Deck'"));
  EXPECT_TRUE(said("the map has no row for the objects 'corbel a', 'corbel b', 'foot left', 'foot right'"));
  EXPECT_TRUE(said("no stone has the material granite"));
  EXPECT_TRUE(import.assembly.groups.empty());
  // Nothing is fixed by the map, so what is lowest is.
  EXPECT_TRUE(import.assembly.blocks[0].fixed);
}

TEST(ImportNames, WhatCannotBeIsAnError) {
  const auto says = [](const std::string& names, const std::string& piece) {
    const std::string said = message_of<InputError>([&] { import_with(doorway(), names); });
    EXPECT_NE(said.find(piece), std::string::npos) << said;
  };
  says("[names]\n\"lintel*\" = {material = \"granit\"}\n[materials.granite]\ndensity = 1\n", "granite");
  says("[names]\n\"corbel*\" = {block = \"c\"}\n\"corbel a\" = {part = 1}\n\"corbel b\" = {part = 2}\n",
       "the pieces of 'c' have different values of part");
  says("[names]\n\"foot*\" = {block = \"feet\"}\n", "has no face in contact with the others");
}

TEST(ImportNames, LayersOfAnObjAreItsGroups) {
  std::string text = doorway();
  text.insert(text.find("o lintel_1"), "g Vault\n");
  text.insert(text.find("o corbel a"), "g Top\n");
  const Import import =
      import_with(text, "[layers]\nVault = {component = \"arch\"}\n\"T*\" = {component = \"parapet\"}\n");
  const auto of = [&](std::size_t i) { return import.assembly.blocks[i].component; };
  EXPECT_EQ(of(0), Component::block);
  EXPECT_EQ(of(2), Component::arch);
  EXPECT_EQ(of(4), Component::arch);
  EXPECT_EQ(of(6), Component::parapet);
}

/// Components that generated bridges have rules for: backfill rubs on masonry.
TEST(ImportNames, BackfillMeetsMasonryByFriction) {
  const Import import = import_with(doorway(), "[names]\n\"corbel*\" = {component = \"backfill\"}\n");
  bool found = false;
  for (const Joint& joint : import.assembly.joints) {
    if (joint.a != 4 || joint.b != 5) continue;
    found = true;
    EXPECT_NEAR(import.assembly.laws[std::size_t(joint.law)].friction_angle, 35.0 * M_PI / 180.0, 1e-12);
    // A fifth of E over twice the distance of the masonry's centroid.
    EXPECT_NEAR(joint.kn, 0.2 * 4e9 / 1.0, 1e-3);
  }
  EXPECT_TRUE(found);
}

const Polygon corbel_outline = {{0, 0, 1}, {0.5, 0, 1}, {0.5, 0, 2.2}, {1.2, 0, 2.2}, {1.2, 0, 2.5}, {0, 0, 2.5}};

TEST(ImportNames, AShapeThatIsNotConvexIsCutOrItsHullTaken) {
  const std::string text =
      obj_of({{"pier", make_box({0, 0, 0}, {0.5, 0.5, 1})}, {"corbel", make_prism(corbel_outline, {0, 0.5, 0})}});
  const double stone = 2000.0 * 0.5 * (0.5 * 1.2 + 1.2 * 0.3);
  ImportOptions options;
  options.not_convex = NotConvex::hull;
  const Import hull = import_with(text, "", options);
  // The hull bridges the corner under the corbel's head: a triangle of 0.7 by 1.2.
  EXPECT_NEAR(hull.assembly.blocks[1].mass, stone + 2000.0 * 0.5 * 0.5 * 0.7 * 1.2, 1e-9);
  EXPECT_EQ(hull.assembly.blocks[1].cells.size(), 1u);
  EXPECT_NE(hull.notes.at(0).find("convex hull; the volume grows by up to 43.8 %"), std::string::npos) << hull.notes[0];
  try {
    const Import cut = import_with(text, "[names]\n\"corbel\" = {not_convex = \"cut\"}\n\"pier\" = {part = 0}\n");
    ASSERT_EQ(cut.assembly.blocks.size(), 2u);
    EXPECT_EQ(cut.assembly.blocks[1].cells.size(), 2u);
    EXPECT_NEAR(cut.assembly.blocks[1].mass, stone, 1e-9);
    EXPECT_EQ(cut.assembly.joints.size(), 1u);
    EXPECT_NE(cut.notes.at(0).find("1 shape was cut into 2 convex cells"), std::string::npos) << cut.notes[0];
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("libcgal-dev"), std::string::npos) << error.what();
  }
  EXPECT_NE(message_of<InputError>([&] { import_with(text, ""); }).find("--not-convex cut"), std::string::npos);
}

/// A warp beyond --flatten: the message says how far corners stand off and what can be done; the hull is one of it.
TEST(ImportNames, AWarpedStoneMayBeReplacedByItsHull) {
  Polyhedron warped = make_box({0, 0, 1}, {1, 1, 2});
  for (Vec3& p : warped.vertices)
    if (p.z() > 1.5) p.z() += (p.x() > 0.5) == (p.y() > 0.5) ? 0.1 : -0.1;
  const std::string text = obj_of({{"flat", make_box({0, 0, 0}, {1, 1, 1})}, {"warped", warped}});
  const std::string said = message_of<InputError>([&] { import_with(text, ""); });
  for (const char* piece : {"'warped'", "its corners lie up to 0.1 m off a plane"})
    EXPECT_NE(said.find(piece), std::string::npos) << said;
  ImportOptions options;
  options.not_convex = NotConvex::hull;
  const Import import = import_with(text, "", options);
  // Corners of the top at 2.1, 1.9, 2.1, 1.9: the two triangles of the hull stand 1/30 above the mean on average.
  EXPECT_NEAR(import.assembly.blocks[1].mass, 2000.0 * (1.0 + 0.1 / 3.0), 1e-6);
  EXPECT_EQ(import.assembly.joints.size(), 1u);
  EXPECT_TRUE(has_note(import, "grows by up to 3.33 %"));
}

TEST(ImportNames, ADrawingInAnotherUnitIsSaid) {
  const std::string text =
      obj_of({{"low", make_box({0, 0, 0}, {3000, 900, 600})}, {"high", make_box({0, 0, 600}, {3000, 900, 1200})}});
  const auto says = [&](const ImportOptions& options) {
    for (const std::string& note : import_with(text, "", options).notes)
      if (note.find("--units") != std::string::npos) return true;
    return false;
  };
  ImportOptions options;
  EXPECT_TRUE(says(options));
  options.scale = 0.001;
  EXPECT_FALSE(says(options));
  options.scale = 1e-6;
  options.search = careful_search(1e-8);
  EXPECT_TRUE(says(options));
}

/// Groups of objects stand in one table of the file: thousands of datasets take long to write and to read.
TEST(ImportNames, ObjectsStandInOneTable) {
  const Folder folder;
  std::vector<std::pair<std::string, Polyhedron>> stones;
  for (int k = 0; k < 300; ++k)
    stones.emplace_back(fmt::format("stone {}", k), make_box({double(k), 0, 0}, {k + 1.0, 1, 1}));
  const Import import =
      import_with(obj_of(stones), "[names]\n\"stone 7\" = {group = \"keystone 0\"}\n\"*\" = {part = 0}\n");
  write_assembly(folder / "a.h5", import.assembly);
  const h5::File file = h5::File::open(folder / "a.h5");
  EXPECT_EQ(file.names("groups"), std::vector<std::string>{"keystone 0"});
  EXPECT_EQ(file.read_texts("objects/names").size(), 300u);
  EXPECT_EQ(file.integer("/", "format_version"), 3);
  EXPECT_EQ(read_assembly(folder / "a.h5").groups, import.assembly.groups);
  Assembly plain = import.assembly;
  std::erase_if(plain.groups, [](const auto& group) { return group.first.starts_with("object "); });
  write_assembly(folder / "b.h5", plain);
  EXPECT_EQ(h5::File::open(folder / "b.h5").integer("/", "format_version"), 2);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
