// Blocks written for other programs come back as they were.
#include <gtest/gtest.h>

#include <numeric>

#include "io/case/case.h"
#include "io/vtk/export_blocks.h"
#include "io/vtk/import.h"
#include "solver/base/json_file.h"
#include "solver/effects/effect.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::Folder;

Assembly built(const std::string& keys) {
  return make_assembly(parse_case("[bridge]\n" + keys, "case.toml", CaseUse::geometry));
}

double sum_of(const Assembly& assembly, double (*of)(const Block&)) {
  double sum = 0.0;
  for (const Block& block : assembly.blocks) sum += of(block);
  return sum;
}

void expect_same(const Assembly& a, const Assembly& b) {
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (std::size_t i = 0; i < a.blocks.size(); ++i) {
    const Block &p = a.blocks[i], &q = b.blocks[i];
    ASSERT_EQ(p.cells.size(), q.cells.size()) << i;
    EXPECT_EQ(p.component, q.component) << i;
    EXPECT_EQ(p.part, q.part) << i;
    EXPECT_EQ(p.fixed, q.fixed) << i;
    EXPECT_EQ(a.materials[std::size_t(p.material)].name, b.materials[std::size_t(q.material)].name) << i;
    EXPECT_NEAR(p.mass, q.mass, 1e-9 * p.mass) << i;
  }
  EXPECT_EQ(a.groups, b.groups);
  const auto mass = [](const Block& block) { return block.mass; };
  EXPECT_NEAR(sum_of(a, mass), sum_of(b, mass), 1e-9 * sum_of(a, mass));
  ASSERT_EQ(a.joints.size(), b.joints.size());
  for (std::size_t i = 0; i < a.joints.size(); ++i) {
    EXPECT_EQ(a.joints[i].a, b.joints[i].a);
    EXPECT_EQ(a.joints[i].b, b.joints[i].b);
    EXPECT_NEAR(a.joints[i].area, b.joints[i].area, 1e-9 * a.joints[i].area) << i;
  }
  EXPECT_NEAR(covered_area(a), covered_area(b), 1e-9 * covered_area(a));
  ASSERT_EQ(a.materials.size(), b.materials.size());
  for (std::size_t m = 0; m < a.materials.size(); ++m) {
    EXPECT_EQ(a.materials[m].name, b.materials[m].name);
    for (const auto member : {&Material::density, &Material::youngs_modulus, &Material::shear_modulus,
                              &Material::tensile_strength, &Material::cohesion, &Material::friction_angle})
      EXPECT_EQ(a.materials[m].*member, b.materials[m].*member);
  }
}

Assembly back(const ExportedBlocks& exported, const char* name) {
  const Folder folder;
  ImportOptions options;
  options.map = read_name_map(folder.write("names.toml", text_of(exported.map)), options.material);
  options.keep_fixed = true;
  return import_blocks(folder.write(name, exported.text), options).assembly;
}

TEST(Export, ABridgeOfThreeArchesComesBack) {
  const Assembly bridge = built("generator = \"cs2\"\nblock_scale = 3\n");
  ASSERT_GT(bridge.blocks.size(), 200u);
  ASSERT_TRUE(
      std::any_of(bridge.blocks.begin(), bridge.blocks.end(), [](const Block& b) { return b.cells.size() > 1; }));
  ASSERT_TRUE(bridge.groups.contains("keystone 0"));
  const Assembly other = back(export_obj(bridge), "bridge.obj");
  expect_same(bridge, other);
  // What effects can act on is known by components, parts and groups.
  for (const Effect& effect : effects()) {
    if (!effect.places) continue;
    EXPECT_EQ(effect.places(bridge), effect.places(other)) << effect.name;
  }
  expect_same(bridge, back(export_compas(bridge), "bridge.json"));
}

TEST(Export, NamesCarryComponentPartBlockAndCell) {
  const Assembly arch = built("generator = \"arch\"\n");
  const ExportedBlocks obj = export_obj(arch);
  EXPECT_NE(obj.text.find("g arch_0\no arch_0_b"), std::string::npos);
  EXPECT_NE(obj.text.find("_c0\n"), std::string::npos);
  const nlohmann::json json = parse_json(export_compas(arch).text, "arch.json");
  EXPECT_EQ(json["dtype"], "compas_assembly.datastructures/Assembly");
  const auto& nodes = json["data"]["graph"]["data"]["node"];
  EXPECT_EQ(nodes.size(), arch.blocks.size());
  EXPECT_EQ(nodes["0"]["is_support"], arch.blocks[0].fixed);
  EXPECT_EQ(nodes["0"]["block"]["data"]["vertex"].size(), arch.blocks[0].cells[0].vertices.size());
}

/// Effects leave materials of one name; an imported bridge has groups by objects.
TEST(Export, MaterialsOfOneNameAndSingleBlocksThatDiffer) {
  Assembly arch = built("generator = \"arch\"\n");
  arch.materials.push_back(arch.materials[0]);
  arch.materials.back().density *= 2.0;
  arch.blocks[3].material = std::int32_t(arch.materials.size()) - 1;
  arch.blocks[4].fixed = true;
  arch.groups["object a"] = {2, 5};
  finish_blocks(arch);
  const Assembly other = back(export_obj(arch), "arch.obj");
  EXPECT_EQ(other.blocks[3].mass, arch.blocks[3].mass);
  EXPECT_TRUE(other.blocks[4].fixed);
  EXPECT_EQ(other.groups, arch.groups);
  EXPECT_EQ(other.materials.back().name, arch.materials[0].name + " (2)");
}

TEST(Export, WhatIsLeftOutIsSaid) {
  Assembly arch = built("generator = \"arch\"\n");
  arch.fill.nodes.resize(4);
  arch.fill.tets.push_back({0, 1, 2, 3});
  arch.sensors.push_back({});
  arch.effects = {"added_mass deck = 1"};
  arch.laws.push_back({});
  arch.laws.back().kind = JointLaw::Kind::tie;
  arch.joints.back().law = std::int32_t(arch.laws.size()) - 1;
  arch.groups["nobody"] = {};
  std::string all;
  for (const std::string& note : export_obj(arch).notes) all += note + "\n";
  for (const char* piece :
       {"joints are not written", "1 tie is", "1 tetrahedron", "1 sensor is", "added_mass", "nobody"})
    EXPECT_NE(all.find(piece), std::string::npos) << piece << "\n" << all;
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
