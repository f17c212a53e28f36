// A symmetric bridge is made of symmetric stones: which slivers join which stones does not hang on rounding.
#include <algorithm>
#include <array>

#include "tests/geometry/bridges.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

/// How many blocks each end of a component has, and each side.
std::array<std::int64_t, 4> halves(const Assembly& assembly, Component component) {
  Box box;
  for (const Block& block : assembly.blocks) {
    const Box own = block_box(block);
    box.low = box.low.cwiseMin(own.low), box.high = box.high.cwiseMax(own.high);
  }
  const Vec3 middle = 0.5 * (box.low + box.high);
  std::array<std::int64_t, 4> count = {};
  for (const Block& block : assembly.blocks) {
    if (block.component != component) continue;
    const Vec3 d = block.centroid - middle;
    for (int axis = 0; axis < 2; ++axis)
      if (std::abs(d[axis]) > 1e-6) ++count[std::size_t(2 * axis + (d[axis] > 0.0))];
  }
  return count;
}

TEST(Symmetry, SliversOfASymmetricBridgeAreJoinedAlike) {
  for (const double side : {8.0, 9.0}) {
    GeneratorInput in = with_entries(3, 1);
    in.values.at("span.1.clear_span") = in.values.at("span.3.clear_span") = side;
    in.values.at("span.2.clear_span") = 10.0;
    const Assembly assembly = find_generator("bridge").build(in);
    for (const Component component : {Component::abutment, Component::arch, Component::backing, Component::spandrel}) {
      const auto [left, right, front, back] = halves(assembly, component);
      EXPECT_EQ(left, right) << component_names()[std::size_t(component)] << ", spans of " << side << " m";
      EXPECT_EQ(front, back) << component_names()[std::size_t(component)] << ", spans of " << side << " m";
      EXPECT_GT(left, 0);
    }
  }
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
