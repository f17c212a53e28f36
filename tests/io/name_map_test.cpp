// What objects of a drawing are, by their names: the table itself.
#include "io/case/name_map.h"

#include <gtest/gtest.h>

#include "solver/base/error.h"
#include "tests/folder.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

using test::Folder;

const Material usual = {"stone", 2000.0, 4e9, 1.6e9, 0.0, 0.0, 0.5};

NameMap read(const std::string& text) {
  const Folder folder;
  return read_name_map(folder.write("names.toml", text), usual);
}

std::string message(const std::string& text) {
  return test::message_of<InputError>([&] { read(text); });
}

TEST(NameMap, Patterns) {
  for (const auto& [name, pattern, whether] :
       std::initializer_list<std::tuple<const char*, const char*, bool>>{{"arch", "arch", true},
                                                                         {"arch1", "arch", false},
                                                                         {"arch1", "arch*", true},
                                                                         {"arch", "arch*", true},
                                                                         {"big arch", "*arch", true},
                                                                         {"big arches", "*arch", false},
                                                                         {"a_b_c", "a*c", true},
                                                                         {"a_b_c", "*_*_*", true},
                                                                         {"a_b", "*_*_*", false},
                                                                         {"aab", "*ab", true},
                                                                         {"abab", "*ab", true},
                                                                         {"ab", "a*b*", true},
                                                                         {"", "*", true},
                                                                         {"", "", true},
                                                                         {"x", "", false},
                                                                         {"aaa", "aa*aa", false},
                                                                         {"xayb", "*a*b", true},
                                                                         {"b2_b3", "*_b*", true}})
    EXPECT_EQ(fits_pattern(name, pattern), whether) << name << " " << pattern;
  // Stars do not multiply the work.
  const std::string stars(60, '*');
  std::string pattern;
  for (const char c : stars) pattern += std::string("a") + c;
  EXPECT_FALSE(fits_pattern(std::string(20000, 'a'), pattern + "b"));
}

TEST(NameMap, LaterRowsTakePrecedenceAndGroupsAddUp) {
  const NameMap map = read(R"(
[names]
"*" = {component = "wall", part = 3, fixed = false}
"arch*" = {component = "arch", material = "vault", group = ["all arches", "spandrel y-"]}
"arch_5" = {part = 0, group = "keystone 0"}
"corbel_*_*" = {block = "corbel *", not_convex = "cut"}
[layers]
"Base" = {component = "base", fixed = true}
[materials.vault]
density = 2200
friction_angle = 35
)");
  std::vector<bool> used(map.rows.size());
  const NameRow key = meaning_of(map, "arch_5", "Vault", used);
  EXPECT_EQ(key.component, Component::arch);
  EXPECT_EQ(key.part, 0);
  EXPECT_EQ(key.material, "vault");
  EXPECT_EQ(key.fixed, false);
  EXPECT_EQ(key.groups, (std::vector<std::string>{"all arches", "spandrel y-", "keystone 0"}));
  EXPECT_EQ(meaning_of(map, "corbel_7_left", "", used).block, "corbel 7");
  EXPECT_EQ(meaning_of(map, "corbel_7_left", "", used).not_convex, NotConvex::cut);
  // Names come after layers.
  const NameRow base = meaning_of(map, "plinth", "Base", used);
  EXPECT_EQ(base.component, Component::wall);
  EXPECT_EQ(base.fixed, false);
  EXPECT_EQ(std::count(used.begin(), used.end(), true), 5);
  ASSERT_EQ(map.materials.size(), 1u);
  EXPECT_EQ(map.materials[0].density, 2200.0);
  EXPECT_EQ(map.materials[0].youngs_modulus, 4e9);
}

TEST(NameMap, WrongWordsAreNamedWithTheKnownOnes) {
  const auto says = [](const std::string& text, std::vector<std::string> pieces) {
    const std::string said = message(text);
    pieces.push_back("names.toml:");
    for (const std::string& piece : pieces) EXPECT_NE(said.find(piece), std::string::npos) << said;
  };
  says("[names]\n\"a*\" = {component = \"keystone\"}\n", {"'component'", "keystone", "arch", "spandrel", "parapet"});
  says("[names]\n\"a*\" = {component = \"arhc\"}\n", {"arhc", "arch"});
  says("[names]\n\"a*\" = {componet = \"arch\"}\n", {"componet", "component"});
  says("[names]\n\"a*\" = {part = -1}\n", {"'part'"});
  says("[names]\n\"a*\" = {fixed = 1}\n", {"'fixed'"});
  says("[names]\n\"a*\" = {group = \"a/b\"}\n", {"'group'", "a/b"});
  says("[names]\n\"a*\" = {group = \"\"}\n", {"'group'"});
  says("[names]\n\"a*\" = {block = \"x*y*\"}\n", {"'block'", "at most as many *"});
  says("[names]\n\"a*\" = {not_convex = \"melt\"}\n", {"melt", "refuse"});
  says("[nams]\n\"a*\" = {part = 1}\n", {"nams"});
  says("[names]\n", {"[names]"});
  says("[names]\n\"a*\" = 3\n", {"a*"});
  says("[names]\n\"a\" = {part = 1}\n[materials.x]\ndensity = -1\n", {"density"});
}

TEST(NameMap, ComesBackFromItsText) {
  NameMap map;
  map.object_groups = false;
  map.materials = {{"vault \"old\"", 2203.7, 1e10 / 3.0, 1.1e9, 1e5 / 7.0, 2e5, 0.6108652381980153, 0.1}};
  NameRow row;
  row.pattern = "a \"b\" \\ *";
  row.component = Component::backing;
  row.part = 7;
  row.material = map.materials[0].name;
  row.groups = {"keystone 0", "x"};
  row.fixed = true;
  row.block = "b*";
  row.not_convex = NotConvex::hull;
  NameRow layer;
  layer.pattern = "L";
  layer.layer = true;
  layer.fixed = false;
  map.rows = {layer, row};
  const NameMap back = read(text_of(map));
  EXPECT_FALSE(back.object_groups);
  ASSERT_EQ(back.rows.size(), 2u);
  EXPECT_TRUE(back.rows[0].layer);
  EXPECT_EQ(back.rows[0].fixed, false);
  EXPECT_EQ(back.rows[1].pattern, row.pattern);
  EXPECT_EQ(back.rows[1].component, row.component);
  EXPECT_EQ(back.rows[1].part, row.part);
  EXPECT_EQ(back.rows[1].material, row.material);
  EXPECT_EQ(back.rows[1].groups, row.groups);
  EXPECT_EQ(back.rows[1].fixed, row.fixed);
  EXPECT_EQ(back.rows[1].block, row.block);
  EXPECT_EQ(back.rows[1].not_convex, row.not_convex);
  ASSERT_EQ(back.materials.size(), 1u);
  const Material &a = map.materials[0], &b = back.materials[0];
  EXPECT_EQ(a.name, b.name);
  for (const auto member : {&Material::density, &Material::youngs_modulus, &Material::shear_modulus,
                            &Material::tensile_strength, &Material::cohesion, &Material::friction_angle})
    EXPECT_EQ(a.*member, b.*member);
  EXPECT_NEAR(a.dilation_angle, b.dilation_angle, 1e-16);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
