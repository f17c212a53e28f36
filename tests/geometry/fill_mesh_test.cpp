// The mesh of a deformable fill: surface, soundness, quality, its patches with stones, and meshes of bridges.
#include "geometry/fill_mesh.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "geometry/fill_gmsh.h"
#include "geometry/fill_import.h"
#include "geometry/fill_joints.h"
#include "geometry/fill_report.h"
#include "geometry/fill_sweep.h"
#include "geometry/generator.h"
#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

/// The unit cube in six tetrahedra around a diagonal, half of them numbered the wrong way round.
FillMesh unit_cube(const Vec3& corner = Vec3::Zero()) {
  FillMesh mesh;
  for (int i = 0; i < 8; ++i) mesh.nodes.push_back(corner + Vec3(i & 1, (i >> 1) & 1, (i >> 2) & 1));
  const int ways[6][2] = {{1, 3}, {1, 5}, {2, 3}, {2, 6}, {4, 5}, {4, 6}};
  for (const auto& w : ways) mesh.tets.push_back({0, w[0], w[1], 7});
  mesh.material.assign(6, 0);
  return mesh;
}

FillMesh finished_cube(const Vec3& corner = Vec3::Zero()) {
  FillMesh mesh = unit_cube(corner);
  orient_tets(mesh);
  find_surface(mesh);
  return mesh;
}

template <class Work>
std::string complaint(Work&& work) {
  try {
    work();
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

bool holds(const std::string& text, const std::string& part) {
  return text.find(part) != std::string::npos;
}

TEST(FillMesh, OrientsAndFindsTheSurface) {
  const FillMesh mesh = finished_cube();
  EXPECT_NO_THROW(check_fill(mesh, "the cube"));
  EXPECT_NEAR(fill_volume(mesh), 1.0, 1e-15);
  ASSERT_EQ(mesh.triangles.size(), 12u);
  EXPECT_TRUE(std::is_sorted(mesh.triangles.begin(), mesh.triangles.end()));
  double area = 0.0;
  for (std::int32_t t = 0; t < 12; ++t) {
    const Polygon triangle = triangle_polygon(mesh, t);
    area += polygon_area(triangle);
    EXPECT_GT(polygon_normal(triangle).dot(polygon_centroid(triangle) - Vec3(0.5, 0.5, 0.5)), 0.4);
  }
  EXPECT_NEAR(area, 6.0, 1e-14);
}

TEST(FillMesh, TheSurfaceDoesNotDependOnTheOrderOfTetrahedra) {
  FillMesh other = unit_cube();
  std::reverse(other.tets.begin(), other.tets.end());
  orient_tets(other);
  find_surface(other);
  EXPECT_EQ(other.triangles, finished_cube().triangles);
}

TEST(FillMesh, EachTriangleKnowsItsTetrahedron) {
  const FillMesh mesh = finished_cube();
  const std::vector<std::int32_t> tets = triangle_tets(mesh);
  ASSERT_EQ(tets.size(), mesh.triangles.size());
  for (std::size_t t = 0; t < tets.size(); ++t) {
    const auto& tet = mesh.tets[std::size_t(tets[t])];
    for (const std::int32_t k : mesh.triangles[t]) EXPECT_NE(std::find(tet.begin(), tet.end(), k), tet.end());
  }
}

TEST(FillMesh, QualityOfTheCube) {
  const FillQuality q = fill_quality(finished_cube());
  EXPECT_NEAR(q.volume, 1.0, 1e-15);
  EXPECT_NEAR(q.longest_edge, std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(q.shortest_edge, 1.0, 1e-15);
  EXPECT_NEAR(q.edge_ratio, std::sqrt(3.0), 1e-15);
  EXPECT_NEAR(q.smallest_angle, M_PI / 4.0, 1e-12);
  EXPECT_NEAR(q.smallest_height, std::sqrt(0.5), 1e-12);
}

TEST(FillMesh, PartsHangTogetherThroughNodes) {
  FillMesh two = finished_cube();
  const FillMesh other = finished_cube({5, 0, 0});
  two.nodes.insert(two.nodes.end(), other.nodes.begin(), other.nodes.end());
  for (auto tet : other.tets) {
    for (std::int32_t& k : tet) k += 8;
    two.tets.push_back(tet);
  }
  const std::vector<std::int32_t> parts = fill_parts(two);
  EXPECT_EQ(std::vector<std::int32_t>(parts.begin(), parts.begin() + 6), std::vector<std::int32_t>(6, 0));
  EXPECT_EQ(std::vector<std::int32_t>(parts.begin() + 6, parts.end()), std::vector<std::int32_t>(6, 1));
}

TEST(FillMesh, ErrorsSayWhere) {
  const auto error = [](auto&& change) {
    FillMesh mesh = finished_cube();
    change(mesh);
    return complaint([&] { check_fill(mesh, "fill.msh"); });
  };
  EXPECT_TRUE(holds(error([](FillMesh& m) { std::swap(m.tets[2][0], m.tets[2][1]); }),
                    "fill.msh: tetrahedron 2 at (0.500, 0.750, 0.250) m is inverted"));
  EXPECT_TRUE(holds(error([](FillMesh& m) { m.nodes[7] = Vec3(1, 1, 0); }), "is flat: its longest edge is"));
  EXPECT_TRUE(holds(error([](FillMesh& m) { m.nodes[3].y() = NAN; }), "node 3 is at (1, nan, 0)"));
  EXPECT_TRUE(holds(error([](FillMesh& m) { m.nodes.emplace_back(2, 2, 2); }), "node 8 at (2.000, 2.000, 2.000) m "));
  EXPECT_TRUE(
      holds(error([](FillMesh& m) { m.tets[1][2] = 8; }), "tetrahedron 1 has the node 8, but nodes count from 0 to 7"));
  const std::string third = error([](FillMesh& m) {
    m.nodes.emplace_back(0.5, 0.5, 3.0);
    m.tets.push_back({0, 7, 1, 8});  // on a face that two have already, or its twin on the other side
    if ((m.nodes[7] - m.nodes[0]).dot((m.nodes[1] - m.nodes[0]).cross(m.nodes[8] - m.nodes[0])) < 0.0)
      std::swap(m.tets.back()[0], m.tets.back()[1]);
    m.tets.push_back(m.tets.back());
  });
  EXPECT_TRUE(holds(third, "is shared by") || holds(third, "same side")) << third;
  EXPECT_TRUE(holds(error([](FillMesh& m) { m.tets.push_back(m.tets[0]); }), "tetrahedr"));
}

TEST(FillMesh, ThreeTetrahedraOnAFaceAndTwoOnOneSide) {
  FillMesh fan;
  fan.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0, 0, 2}, {0, 0, -1}};
  fan.tets = {{0, 1, 2, 3}, {0, 2, 1, 5}};
  EXPECT_NO_THROW(check_fill({{fan.nodes[0], fan.nodes[1], fan.nodes[2], fan.nodes[3], fan.nodes[5]},
                              {{0, 1, 2, 3}, {0, 2, 1, 4}},
                              {0, 0},
                              {}},
                             "two"));
  fan.tets.push_back({0, 1, 2, 4});
  EXPECT_TRUE(holds(complaint([&] { check_fill(fan, "fan"); }), "fan: the face of nodes 0, 1 and 2 is shared by"));
  FillMesh side;
  side.nodes = {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {0.1, 0.1, 2}};
  side.tets = {{0, 1, 2, 3}, {0, 1, 2, 4}};
  EXPECT_TRUE(holds(complaint([&] { check_fill(side, "side"); }), "on the same side of the face they share"));
}

TEST(FillMesh, AMissedVolumeIsAnError) {
  EXPECT_NO_THROW(check_volume(finished_cube(), 1.0005));
  EXPECT_TRUE(holds(complaint([] { check_volume(finished_cube(), 1.002); }), "has a volume of 1 m3"));
}

// ---- patches

/// Boxes of one material, the first of them fixed.
Assembly stones(const std::vector<std::pair<Vec3, Vec3>>& boxes) {
  Assembly assembly;
  assembly.materials = {{"stone", 2000.0, 4e9, 1.6e9, 0.0, 0.0, 0.5}, {"fill", 1500.0, 4e8, 1.6e8, 0.0, 2e4, 0.7}};
  for (const auto& [low, high] : boxes) {
    Block block;
    block.cells = {make_box(low, high)};
    block.fixed = assembly.blocks.empty();
    assembly.blocks.push_back(block);
  }
  finish_blocks(assembly);
  return assembly;
}

double covered(const Assembly& assembly, std::int64_t block) {
  double sum = 0.0;
  for (const FillJoint& joint : assembly.fill_joints) sum += joint.block == block ? joint.area : 0.0;
  return sum;
}

TEST(FillJoints, CoverExactlyWhatTouches) {
  // Two stones below, of which one is offset, and one beside that covers a part of the face y = 1.
  Assembly assembly =
      stones({{{-1, -1, -1}, {0.3, 2, 0}}, {{0.3, 0.25, -1}, {2, 2, 0}}, {{0.2, 1, 0.1}, {0.6, 2, 0.8}}});
  assembly.fill = finished_cube();
  const FillJointReport report = find_fill_joints(assembly);
  EXPECT_NEAR(covered(assembly, 0), 0.3, 1e-12);
  EXPECT_NEAR(covered(assembly, 1), 0.7 * 0.75, 1e-12);
  EXPECT_NEAR(covered(assembly, 2), 0.4 * 0.7, 1e-12);
  EXPECT_NEAR(report.surface, 6.0, 1e-12);
  EXPECT_NEAR(report.covered, 0.3 + 0.525 + 0.28, 1e-12);
  EXPECT_EQ(report.patches, std::int64_t(assembly.fill_joints.size()));
  EXPECT_EQ(report.closed_gaps, 0);
  for (const FillJoint& joint : assembly.fill_joints) {
    const Polygon triangle = triangle_polygon(assembly.fill, joint.triangle);
    EXPECT_NEAR(joint.normal.dot(polygon_normal(triangle)), -1.0, 1e-15);
    EXPECT_NEAR(polygon_normal(joint.polygon).dot(joint.normal), 1.0, 1e-12);
    EXPECT_NEAR(polygon_area(joint.polygon), joint.area, 1e-15);
    const Plane face = face_plane(assembly.blocks[std::size_t(joint.block)].cells[0], joint.face);
    for (const Vec3& p : joint.polygon) EXPECT_NEAR(face.normal.dot(p) - face.offset, 0.0, 1e-12);
  }
}

TEST(FillJoints, CloseGapsUpToTheTolerance) {
  Assembly assembly = stones({{{-1, -1, -1}, {2, 2, -5e-5}}});
  assembly.fill = finished_cube();
  const FillJointReport report = find_fill_joints(assembly);
  EXPECT_EQ(report.closed_gaps, report.patches);
  EXPECT_NEAR(report.largest_closed_gap, 5e-5, 1e-12);
  for (const FillJoint& joint : assembly.fill_joints) {
    for (const Vec3& p : joint.polygon) EXPECT_EQ(p.z(), 0.0);  // in the triangle's plane
  }
}

TEST(FillJoints, AFillThatTouchesNothingIsAnError) {
  Assembly assembly = stones({{{-1, -1, -1}, {2, 2, -0.01}}});
  assembly.fill = finished_cube();
  EXPECT_TRUE(
      holds(complaint([&] { find_fill_joints(assembly); }),
            "a part of the fill, from (0.000, 0.000, 0.000) to (1.000, 1.000, 1.000) m, does not touch the masonry"));
}

TEST(FillJoints, StonesInOneAnotherAreAnError) {
  Assembly assembly = stones({{{-1, -1, -1}, {2, 2, 0}}, {{0, 0, -1}, {1, 1, 0}}});
  assembly.fill = finished_cube();
  EXPECT_TRUE(holds(complaint([&] { find_fill_joints(assembly); }), "both cover the surface of the fill"));
}

TEST(FillImport, StiffnessIsAShareOfTheStones) {
  Assembly assembly = stones({{{-1, -1, -1}, {2, 2, 0}}});
  FillInterface interface;
  interface.share = 0.1;
  put_fill(assembly, finished_cube(), 1, interface);
  ASSERT_FALSE(assembly.fill_joints.empty());
  const FillJoint& joint = assembly.fill_joints.front();
  EXPECT_NEAR(joint.kn, 0.1 * 4e9 / 1.0, 1.0);  // dc: twice the half metre from the stone's centroid
  EXPECT_NEAR(joint.ks, 0.1 * 1.6e9 / 1.0, 1.0);
  const JointLaw& law = assembly.laws[std::size_t(joint.law)];
  EXPECT_NEAR(law.friction_angle, 35.0 * M_PI / 180.0, 1e-15);
  EXPECT_EQ(law.tension + law.cohesion + law.residual_cohesion, 0.0);
  EXPECT_EQ(assembly.fill.material.front(), 1);
  EXPECT_TRUE(holds(complaint([&] { put_fill(assembly, finished_cube(), 1, interface); }), "already has"));
}

// ---- sweeping

/// Two triangles of a unit square that reach across as given.
FillSection square(double y0, double y1, double other0, double other1) {
  return {{{0, 0, 0}, {1, 0, 0}, {1, 0, 1}, {0, 0, 1}}, {{{2, 0, 1}, y0, y1}, {{0, 2, 3}, other0, other1}}};
}

TEST(Sweep, IsItsOwnMirrorImage) {
  const FillMesh mesh = sweep(square(-1.0, 1.0, -1.0, 1.0), 2.0, 0.4);
  EXPECT_NO_THROW(check_fill(mesh, "the swept square"));
  EXPECT_NEAR(fill_volume(mesh), 2.0, 1e-15);
  // Six layers, as there is a middle: three steps in half a column of the first colour, four in the others.
  EXPECT_EQ(mesh.tets.size(), 2u * 2u * (3u + 4u + 4u));
  const auto corners = [&](bool mirrored) {
    std::vector<std::vector<std::array<double, 3>>> all;
    for (const auto& tet : mesh.tets) {
      auto& points = all.emplace_back();
      for (const std::int32_t k : tet) {
        const Vec3& p = mesh.nodes[std::size_t(k)];
        points.push_back({p.x(), mirrored ? 0.0 - p.y() : p.y(), p.z()});
      }
      std::sort(points.begin(), points.end());
    }
    std::sort(all.begin(), all.end());
    return all;
  };
  const auto plain = corners(false), mirrored = corners(true);
  ASSERT_EQ(plain.size(), mirrored.size());
  for (std::size_t i = 0; i < plain.size(); ++i) {
    for (std::size_t k = 0; k < 4; ++k) {
      for (std::size_t d = 0; d < 3; ++d) EXPECT_NEAR(plain[i][k][d], mirrored[i][k][d], 1e-12);
    }
  }
}

TEST(Sweep, PartsOfDifferentWidthShareTheirFaces) {
  const FillMesh mesh = sweep(square(-1.0, 1.0, -0.7, 0.7), 2.0, 0.5);
  EXPECT_NO_THROW(check_fill(mesh, "the stepped square"));
  EXPECT_NEAR(fill_volume(mesh), 0.5 * 2.0 + 0.5 * 1.4, 1e-15);
  double surface = 0.0;
  for (std::size_t t = 0; t < mesh.triangles.size(); ++t) {
    surface += polygon_area(triangle_polygon(mesh, std::int32_t(t)));
  }
  const double across = std::sqrt(2.0) * 0.6;  // of the wider part, beside the narrower one
  EXPECT_NEAR(surface, 2.0 * 2.0 + 2.0 * 1.4 + across + 2.0 * 0.5 * 2.0, 1e-12);
}

// ---- meshes of bridges

GeneratorInput bridge_input(const std::string& name, double edge, double scale) {
  GeneratorInput input = default_input(find_generator(name));
  input.values["spans"] = 1.0;
  input.values["fill_edge"] = edge;
  input.values["block_scale"] = scale;
  input.choices["backfill"] = "deformable";
  input.values["abutment_leaf_length"] = 1.5;  // of cs1: wing walls with fill between
  return input;
}

/// Area above height `h` over the centre of a polygon of n equal sides inscribed in a half circle, side by side.
double vault_above(double radius, int n, double h) {
  double area = 0.0;
  for (int i = 0; i < n; ++i) {
    const double a = M_PI * i / n, b = M_PI * (i + 1) / n;
    const double dx = radius * std::abs(std::cos(a) - std::cos(b));
    double p = radius * std::sin(a) - h, q = radius * std::sin(b) - h;
    if (p > q) std::swap(p, q);
    if (q <= 0.0) continue;
    area += p >= 0.0 ? 0.5 * (p + q) * dx : 0.5 * q * dx * q / (q - p);
  }
  return area;
}

struct Expected {
  double volume = 0.0, free = 0.0;  // m3; m2 of deck and end faces
};

/// cs1: one box from end to end over the backing, and one between the wing walls at each end.
Expected expect_cs1(const GeneratorInput& in, int voussoirs) {
  const double radius = 0.5 * in("clear_span") + in("ring_thickness"), top = radius + in("fill_over_crown");
  const double length = 2.0 * in("abutment_length") + in("clear_span");
  const double inner = in("width") - 2.0 * in("spandrel_thickness_top");
  const double wing = in("width") - 2.0 * in("wing_wall_thickness"), high = top - in("backing_height");
  Expected e;
  e.volume = inner * (length * high - vault_above(radius, voussoirs, in("backing_height"))) +
             2.0 * wing * (in("abutment_length") - in("abutment_leaf_length")) * in("abutment_height");
  e.free = length * inner + 2.0 * high * inner + 2.0 * wing * in("abutment_height");
  return e;
}

TEST(FillOfBridges, Cs1HasTheVolumeAndTheFreeSurfaceOfItsKeys) {
  const GeneratorInput input = bridge_input("cs1", 1.0, 2.5);
  const Assembly bridge = find_generator("cs1").build(input);
  const Expected expected = expect_cs1(input, 16);
  const FillQuality q = fill_quality(bridge.fill);
  EXPECT_NEAR(q.volume, expected.volume, 1e-9 * expected.volume);
  EXPECT_LE(q.longest_edge, 1.0 + 1e-9);
  EXPECT_GT(q.smallest_height, 0.05);
  double surface = 0.0, touched = 0.0;
  for (std::size_t t = 0; t < bridge.fill.triangles.size(); ++t) {
    surface += polygon_area(triangle_polygon(bridge.fill, std::int32_t(t)));
  }
  for (const FillJoint& joint : bridge.fill_joints) touched += joint.area;
  EXPECT_NEAR(surface - touched, expected.free, 1e-6);
  const std::vector<std::int32_t> parts = fill_parts(bridge.fill);
  EXPECT_EQ(*std::max_element(parts.begin(), parts.end()), 2);
  EXPECT_FALSE(fill_lines(bridge).empty());
}

TEST(FillOfBridges, AWallThatStepsBackGivesTheFillSteps) {
  GeneratorInput input = bridge_input("cs2", 1.0, 1.0);
  input.values["backing_height"] = 6.0;  // three courses of the walls above it, each thinner than the one below
  const Assembly bridge = find_generator("cs2").build(input);
  Box box;
  for (const Vec3& p : bridge.fill.nodes) box = {box.low.cwiseMin(p), box.high.cwiseMax(p)};
  EXPECT_NEAR(box.high.y(), 2.5, 1e-9);
  double below = 0.0;
  for (const Vec3& p : bridge.fill.nodes) {
    if (p.z() < box.low.z() + 1e-6) below = std::max(below, p.y());
  }
  EXPECT_LT(below, 2.4);
}

TEST(FillOfBridges, TetrahedraWithoutEndAreRefusedWithTheirNumber) {
  FillSpace space;
  space.boxes.push_back({Vec3(0, 0, 0), Vec3(100, 10, 10)});
  FillMeshing fine;
  fine.edge = 0.05;
  EXPECT_TRUE(holds(complaint([&] { mesh_fill(space, fine); }), "of 0.05 m needs about 2e+09 tetrahedra"));
}

TEST(FillOfBridges, TheSameBitsTwice) {
  const GeneratorInput input = bridge_input("cs1", 1.2, 2.5);
  const Assembly one = find_generator("cs1").build(input), two = find_generator("cs1").build(input);
  EXPECT_EQ(one.fill.nodes, two.fill.nodes);
  EXPECT_EQ(one.fill.tets, two.fill.tets);
  EXPECT_EQ(one.fill.triangles, two.fill.triangles);
  ASSERT_EQ(one.fill_joints.size(), two.fill_joints.size());
  for (std::size_t i = 0; i < one.fill_joints.size(); ++i) {
    ASSERT_EQ(one.fill_joints[i].polygon, two.fill_joints[i].polygon);
  }
}

TEST(FillOfBridges, PatchesTakeTheRulesOfRigidFill) {
  GeneratorInput input = bridge_input("cs1", 1.2, 2.0);
  input.choices["abutments"] = "restrained";
  const Assembly bridge = find_generator("cs1").build(input);
  std::map<Component, double> kn, ks;
  for (const FillJoint& joint : bridge.fill_joints) {
    const Component component = bridge.blocks[std::size_t(joint.block)].component;
    const bool fixed = bridge.blocks[std::size_t(joint.block)].fixed;
    const auto [at, first] = kn.try_emplace(component, joint.kn);
    EXPECT_NEAR(at->second, joint.kn, 1e-6 * joint.kn);
    ks.try_emplace(component, joint.ks);
    const JointLaw& law = bridge.laws[std::size_t(joint.law)];
    EXPECT_NEAR(law.friction_angle, (fixed ? 40.0 : 35.0) * M_PI / 180.0, 1e-12);
    EXPECT_EQ(law.cohesion, fixed ? 0.02e6 : 0.0);
    EXPECT_EQ(law.tension, 0.0);
  }
  const auto near = [](double value, double expected) { EXPECT_NEAR(value, expected, 1e-9 * expected); };
  near(kn.at(Component::arch), 0.2 * 8890e6);
  near(ks.at(Component::arch), 0.2 * 3560e6);
  near(kn.at(Component::spandrel), 0.2 * 5520e6);
  near(kn.at(Component::backing), 0.2 * 5520e6);
  near(kn.at(Component::abutment), 0.2 * 5310e6);
  near(kn.at(Component::base), 400e6 / 0.40);  // one nominal block of fill, at any block_scale
  near(kn.at(Component::restraint), 0.5 * 400e6 / 0.70);
  near(ks.at(Component::restraint), 0.5 * 160e6 / 0.70);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
