// What a collapse is called: one of a thing, and several.
#include <gtest/gtest.h>

#include "solver/statics/collapse.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

Assembly spandrels(std::size_t count) {
  Assembly assembly;
  assembly.blocks.resize(count);
  for (Block& block : assembly.blocks) block.component = Component::spandrel;
  return assembly;
}

Collapse of(const std::vector<std::int64_t>& blocks, bool fill) {
  Collapse c;
  c.found = true;
  c.loss.blocks = blocks, c.loss.fill = fill;
  c.loss.rest_stands = true;
  return c;
}

TEST(CollapseWords, CountMovingBlocks) {
  const Assembly assembly = spandrels(2);
  EXPECT_EQ(moving_part(assembly, of({0}, true).loss), "1 block of component spandrel and the fill around it");
  EXPECT_EQ(moving_part(assembly, of({0, 1}, true).loss), "2 blocks of component spandrel and the fill around them");
  Collapse c = of({0}, false);
  EXPECT_TRUE(
      collapse_headline(assembly, c).ends_with(" The rest stands if this part is held and its loads are removed."));
  c.loss.rest_stands = false;
  EXPECT_TRUE(
      collapse_headline(assembly, c).ends_with(" The rest falls even if this part is held and its loads are removed."));
}

TEST(CollapseWords, CountJointsOfAMechanism) {
  std::vector<MechanismJoint> mechanism(2);
  mechanism[1].slides = true;
  const Assembly assembly = spandrels(1);
  EXPECT_TRUE(mechanism_text(assembly, mechanism).starts_with("mechanism: 1 joint hinges, 1 slides\n"));
  mechanism.insert(mechanism.end(), 2, mechanism[0]);
  EXPECT_TRUE(mechanism_text(assembly, mechanism).starts_with("mechanism: 3 joints hinge, 1 slides\n"));
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
