// Gmsh files: what is read of them, in each of their forms, and what damaged ones say.
#include "io/msh/msh_file.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cstring>
#include <filesystem>

#include "geometry/fill_mesh.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

const std::string two_tets =
    "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n6\n1 0 0 0\n2 1000 0 0\n3 0 1000 0\n4 0 0 1000\n5 0 0 -1000\n"
    "9 7 7 7\n$EndNodes\n$Elements\n4\n1 15 2 0 1 1\n2 2 2 0 1 1 2 3\n3 4 2 0 1 1 2 3 4\n4 4 2 0 1 1 2 3 5\n"
    "$EndElements\n";
const std::string one_tet_41 =
    "$MeshFormat\n4.1 0 8\n$EndMeshFormat\n$Entities\n0 0 0 1\n1 0 0 0 1 1 1 0 0\n$EndEntities\n$Nodes\n1 4 1 4\n"
    "3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n$EndNodes\n$Elements\n1 1 1 1\n3 1 4 1\n1 1 2 3 "
    "4\n$EndElements\n";

std::string error(const std::string& text) {
  return test::message_of<InputError>([&] { parse_msh(text, "fill.msh", 1.0); });
}

std::string with(std::string text, const std::string& what, const std::string& by) {
  const std::size_t at = text.find(what);
  EXPECT_NE(at, std::string::npos) << what;
  return text.replace(at, what.size(), by);
}

void expect_said(const std::string& text, std::initializer_list<const char*> parts) {
  const std::string said = error(text);
  for (const char* part : parts) EXPECT_NE(said.find(part), std::string::npos) << part << " is not in: " << said;
}

/// Bytes of numbers, those of a machine of the other byte order when asked.
struct Bytes {
  std::string text;
  bool swapped = false;
  template <class Number>
  Bytes& operator<<(Number value) {
    char raw[sizeof value];
    std::memcpy(raw, &value, sizeof value);
    if (swapped) std::reverse(std::begin(raw), std::end(raw));
    text.append(raw, sizeof value);
    return *this;
  }
  Bytes& words(const std::string& more) {
    text += more;
    return *this;
  }
};

const double corners[4][3] = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}};

std::string binary_22(bool swapped) {
  Bytes b{"", swapped};
  (b.words("$MeshFormat\n2.2 1 8\n") << 1).words("\n$EndMeshFormat\n$Nodes\n4\n");
  for (int i = 0; i < 4; ++i) b << i + 1 << corners[i][0] << corners[i][1] << corners[i][2];
  b.words("\n$EndNodes\n$Elements\n2\n") << 2 << 1 << 2 << 1 << 5 << 6 << 1 << 2 << 3;  // a triangle
  (b << 4 << 1 << 2 << 2 << 5 << 6 << 1 << 2 << 3 << 4).words("\n$EndElements\n");
  return b.text;
}

std::string binary_41(bool swapped) {
  using Size = std::uint64_t;
  Bytes b{"", swapped};
  (b.words("$MeshFormat\n4.1 1 8\n") << 1).words("\n$EndMeshFormat\n$Nodes\n");
  b << Size(1) << Size(4) << Size(1) << Size(4) << 3 << 1 << 0 << Size(4) << Size(1) << Size(2) << Size(3) << Size(4);
  for (const auto& corner : corners) b << corner[0] << corner[1] << corner[2];
  b.words("\n$EndNodes\n$Elements\n") << Size(1) << Size(1) << Size(1) << Size(1) << 3 << 1 << 4 << Size(1);
  (b << Size(1) << Size(1) << Size(2) << Size(3) << Size(4)).words("\n$EndElements\n");
  return b.text;
}

TEST(MshFile, TetrahedraAreTakenAndTurned) {
  const test::Folder folder;
  const FillMesh mesh = read_msh(folder.write("fill.msh", two_tets), 0.001);
  ASSERT_EQ(mesh.nodes.size(), 5u);  // the sixth is used by no tetrahedron
  EXPECT_EQ(mesh.tets.size(), 2u);
  EXPECT_EQ(mesh.triangles.size(), 6u);
  EXPECT_NEAR(fill_volume(mesh), 2.0 / 6.0, 1e-15);
  EXPECT_EQ(mesh.nodes[3], Vec3(0, 0, 1));
}

TEST(MshFile, EveryFormGivesTheSameMesh) {
  for (const std::string& text : {one_tet_41, binary_22(false), binary_22(true), binary_41(false), binary_41(true)}) {
    const FillMesh mesh = parse_msh(text, "fill.msh", 1.0);
    ASSERT_EQ(mesh.nodes.size(), 4u);
    for (int i = 0; i < 4; ++i)
      EXPECT_EQ(mesh.nodes[std::size_t(i)], Vec3(corners[i][0], corners[i][1], corners[i][2]));
    EXPECT_NEAR(fill_volume(mesh), 1.0 / 6.0, 1e-15);
  }
}

TEST(MshFile, NodesStandInTheOrderOfTheirNumbers) {
  std::string text = with(one_tet_41, "\n1\n2\n3\n4\n", "\n40\n2\n7\n1\n");
  text = with(text, "1 1 2 3 4\n$End", "1 40 2 7 1\n$End");
  EXPECT_EQ(parse_msh(text, "fill.msh", 1.0).nodes[0], Vec3(0, 0, 1));
}

TEST(MshFile, ParametricNodesAndWindowsLineEnds) {
  std::string text = with(one_tet_41, "3 1 0 4\n1\n2\n3\n4\n0 0 0\n1 0 0\n0 1 0\n0 0 1\n",
                          "2 1 1 4\n1\n2\n3\n4\n0 0 0 .1 .2\n1 0 0 .1 .2\n0 1 0 .1 .2\n0 0 1 .1 .2\n");
  std::string windows;
  for (const char c : text) windows += c == '\n' ? "\r\n" : std::string(1, c);
  EXPECT_NEAR(fill_volume(parse_msh(windows, "fill.msh", 1.0)), 1.0 / 6.0, 1e-15);
}

TEST(MshFile, OthersAreRefusedByName) {
  expect_said("solid cube\n", {"fill.msh is not a Gmsh mesh: it begins with \"solid\""});
  expect_said("$MeshFormat\n1 0 8\n", {"of version 1; save it as version 4.1 or 2.2"});
  expect_said("", {"is not a Gmsh mesh"});
  expect_said(
      "$MeshFormat\n2.2 0 8\n$EndMeshFormat\n$Nodes\n10\n1 0 0 0\n2 1 0 0\n3 0 1 0\n4 0 0 1\n5 .5 0 0\n6 .5 .5 0\n"
      "7 0 .5 0\n8 0 0 .5\n9 0 .5 .5\n10 .5 0 .5\n$EndNodes\n$Elements\n1\n1 11 2 0 1 1 2 3 4 5 6 7 8 9 "
      "10\n$EndElements\n",
      {"tetrahedron", "of 10 nodes, but a fill must have tetrahedra of 4 nodes only"});
  EXPECT_NE(test::message_of<InputError>([] { read_msh("/nowhere/fill.msh"); }), "");
}

TEST(MshFile, WithoutTetrahedraTheCauseIsSaid) {
  const std::string nodes = two_tets.substr(0, two_tets.find("$Elements"));
  expect_said(nodes + "$Elements\n1\n1 2 2 0 1 1 2 3\n$EndElements\n", {"has no tetrahedra", "gmsh FILE -3"});
  // A physical group on the surface, by number (2.2) and by name (4.1).
  expect_said(nodes + "$Elements\n1\n1 2 2 7 1 1 2 3\n$EndElements\n",
              {"its physical groups have surfaces only", "Add a physical volume", "Mesh.SaveAll = 1"});
  std::string named = with(one_tet_41, "$Entities", "$PhysicalNames\n1\n2 3 \"skin\"\n$EndPhysicalNames\n$Entities");
  named = with(named, "3 1 4 1\n1 1 2 3 4\n", "2 1 2 1\n1 1 2 3\n");
  expect_said(named, {"its physical groups have surfaces only"});
}

TEST(MshFile, WhatIsOutOfRangeIsNamedByItsLine) {
  expect_said(with(one_tet_41, "1 1 2 3 4\n$", "1 1 2 3 -1\n$"), {"has the node -1, which does not exist"});
  expect_said(with(one_tet_41, "1 1 2 3 4\n$", "1 1 2 3 18446744073709551616\n$"),
              {"fill.msh:23: ", "18446744073709551616"});
  expect_said(with(one_tet_41, "3 1 4 1\n", "3 1 4 999999999999\n"), {"fill.msh:22: ", "999999999999 elements"});
  expect_said(with(one_tet_41, "3 1 0 4\n", "3 1 0 -4\n"), {"fill.msh:10: ", "-4 nodes"});
  expect_said(with(one_tet_41, "1 4 1 4\n", "1 4000000000 1 4\n"), {"fill.msh:9: ", "4000000000 nodes"});
  expect_said(with(two_tets, "2 1000 0 0", "2 1e308 0 0"), {"1e+308", "at most 1e+07 m", "--scale"});
  expect_said(with(two_tets, "2 1000 0 0", "2 1e999 0 0"), {"fill.msh:7: ", "1e999"});
  expect_said(with(two_tets, "2 1000 0 0", "2 nan 0 0"), {"fill.msh:7: ", "nan"});
  expect_said(with(two_tets, "2 1000 0 0", "-2 1000 0 0"), {"fill.msh:7: ", "number -2"});
  expect_said(with(two_tets, "2 1000 0 0", "1 1000 0 0"), {"node 1 is given twice"});
  expect_said(with(two_tets, "3 4 2 0 1 1 2 3 4", "3 4 2 0 1 1 2 3"), {"fill.msh:18: ", "too few or too many"});
  expect_said(with(two_tets, "3 4 2 0 1 1 2 3 4", "3 4 2 0 1 1 2 3 4 5"), {"fill.msh:17: ", "too few or too many"});
  expect_said(with(two_tets, "3 4 2 0", "3 4 1000000 0"), {"fill.msh:17: ", "1000000 tags"});
  expect_said(with(two_tets, "3 4 2 0", "3 444 2 0"), {"fill.msh:17: ", "the kind 444"});
  expect_said(with(two_tets, "1 2 3 5", "1 2 3 " + std::string(2000000, '5')), {"555… (2000000 bytes)"});
  expect_said(two_tets + two_tets, {"several files in one"});
  expect_said(with(two_tets, "2.2 0 8", "2.2 0 4"), {"fill.msh:2: "});
}

TEST(MshFile, CutOffAnywhereIsAnError) {
  for (const std::string& text : {two_tets, one_tet_41, binary_22(false), binary_41(false)})
    for (std::size_t size = 0; size + 1 < text.size(); ++size) EXPECT_NE(error(text.substr(0, size)), "") << size;
}

TEST(MshFile, AnyByteMayBeAnother) {
  for (const std::string& text : {two_tets, one_tet_41, binary_22(false), binary_41(false)})
    for (std::size_t at = 0; at < text.size(); ++at)
      for (const char byte : {'\0', '\xff', '-', '9', ' ', '\n', '\x80'}) {
        std::string changed = text;
        changed[at] = byte;
        error(changed);  // an answer of either kind, and no crash
      }
}

TEST(MshFile, AFoldedMeshIsRefused) {
  expect_said(with(two_tets, "5 0 0 -1000", "5 9 9 2000"), {"on the same side of the face they share"});
}

/// Files that Gmsh and meshio wrote, where they are at hand.
TEST(MshFile, FilesOfGmshAndMeshio) {
  const std::filesystem::path folder = std::filesystem::path(VOUSSOIR_SOURCE_DIR) / "../shared/hunt/09-gmsh-meshio";
  if (!std::filesystem::exists(folder)) GTEST_SKIP() << folder << " is not there";
  for (const char* name : {"meshio_gmsh22_txt.msh", "meshio_gmsh22_bin.msh", "meshio_gmsh_txt.msh",
                           "meshio_gmsh_bin.msh", "part22.msh", "part41.msh"})
    EXPECT_NEAR(fill_volume(read_msh(folder / name)), 0.25, 1e-12) << name;
  EXPECT_NE(test::message_of<InputError>([&] { read_msh(folder / "tet10.msh"); }).find("of 10 nodes"),
            std::string::npos);
  EXPECT_NE(test::message_of<InputError>([&] {
              read_msh(folder / "skin_only.msh");
            }).find("its physical groups have surfaces only"),
            std::string::npos);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
