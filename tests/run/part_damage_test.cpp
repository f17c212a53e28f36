// Damage by parts of a bridge, in numbers and words.
#include "tools/run/part_damage.h"

#include <gtest/gtest.h>

#include "tools/run/damage_words.h"

namespace voussoir {
namespace VOUSSOIR_FILE {

/// Three arch blocks in a row, and one of backfill on the second.
struct Row {
  Assembly assembly;
  Snapshot snapshot;

  Row() {
    for (int i = 0; i < 4; ++i) {
      Block block;
      block.component = i < 3 ? Component::arch : Component::backfill;
      block.part = i == 2 ? 1 : 0;
      assembly.blocks.push_back(block);
    }
    add(0, 1, 1.0), add(1, 2, 2.0), add(1, 3, 1.5);
  }
  void add(std::int64_t a, std::int64_t b, double x) {
    Joint joint;
    joint.a = a, joint.b = b, joint.area = 1.0;
    joint.polygon = {{x, 0, 0}, {x, 1, 0}, {x, 1, 1}, {x, 0, 1}};
    assembly.joints.push_back(joint);
    PatchSnapshot patch;
    patch.a = a, patch.b = b, patch.area = 1.0, patch.polygon = joint.polygon, patch.had_bond = true;
    for (Vec3& corner : patch.polygon) corner.z() += 100.0;  // where it has gone does not matter
    snapshot.patches.push_back(patch);
  }
};

TEST(DamageWords, ALengthThatRoundsToZeroIsLessThanTheLastDecimal) {
  EXPECT_EQ(mm_text(3.2e-3, 1), "3.2 mm");
  EXPECT_EQ(mm_text(6e-5, 1), "0.1 mm");
  EXPECT_EQ(mm_text(4e-5, 1), "less than 0.1 mm");
  EXPECT_EQ(mm_text(-4e-6, 2), "less than 0.01 mm");
  EXPECT_EQ(bound_text(3.2e-3, 1), "up to 3.2 mm");
  EXPECT_EQ(bound_text(0.0, 1), "less than 0.1 mm");
}

TEST(DamageWords, NoSentenceSpeaksOfZeroMillimetres) {
  const nlohmann::json opened = {{"largest_opening", 3e-3}, {"residual_opening", 1e-6}, {"largest_slip", 0.0}};
  EXPECT_EQ(
      damage_sentence(opened),
      "slight: joints opened by up to 3.0 mm (less than 0.01 mm still open), slid by less than 0.01 mm; nothing of "
      "the bonded joint area broken");
  const nlohmann::json slid = {{"largest_opening", 1e-6}, {"residual_opening", 0.0}, {"largest_slip", 0.02}};
  EXPECT_EQ(
      damage_sentence(slid),
      "negligible: joints opened by less than 0.01 mm, slid by up to 20 mm; nothing of the bonded joint area broken");
}

TEST(PartDamage, NamesThePartAndThePlaceAsBuilt) {
  Row row;
  row.snapshot.patches[0].largest_opening = 2e-3;
  row.snapshot.patches[1].largest_opening = 5e-3, row.snapshot.patches[1].bonded = 0.25;
  row.snapshot.patches[2].largest_opening = 9e-3;
  const nlohmann::json damage = part_damage_json(row.assembly, row.snapshot);
  ASSERT_EQ(damage.size(), 3u);
  EXPECT_TRUE(damage[0]["fill"].get<bool>()) << "joints with soil are told apart";
  EXPECT_EQ(part_words(damage[1]), "between arch 0 and arch 1");
  EXPECT_EQ(place_words(damage[1]["at"]), "at x = 2.00, y = 0.50, z = 0.50 m");
  EXPECT_NEAR(damage[1]["broken_share"].get<double>(), 0.75, 1e-12);
  EXPECT_EQ(part_words(damage[2]), "arch 0");
  EXPECT_FALSE(damage[2]["fill"].get<bool>());
}

TEST(PartDamage, WhatOnlySlidIsPlacedWhereItSlid) {
  Row row;
  row.snapshot.patches[1].largest_slip = 1e-3;
  const nlohmann::json damage = part_damage_json(row.assembly, row.snapshot);
  EXPECT_EQ(part_words(damage[0]), "between arch 0 and arch 1");
  EXPECT_EQ(damage[0]["at"][0], 2.0);
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir
