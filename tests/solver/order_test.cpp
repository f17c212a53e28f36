// In which order a model has the blocks of its assembly.
#include "tests/solver/models.h"

namespace voussoir::test {
namespace VOUSSOIR_FILE {

constexpr double edge = 0.5;  // m

/// Cubes along x, `across` by `across` of them side by side; the first stays where it is.
Assembly beam(int length, int across) {
  Assembly assembly = stone(2000.0, 1e8);
  for (int z = 0; z < across; ++z)
    for (int y = 0; y < across; ++y)
      for (int x = 0; x < length; ++x)
        add_box(assembly, edge * Vec3(x, y, z), edge * Vec3(x + 1, y + 1, z + 1), assembly.blocks.empty());
  finish_blocks(assembly);
  return assembly;
}

/// How far the order goes back along x, m.
double goes_back(const Assembly& assembly) {
  const Model model = build_model(assembly, undamped({0, 0, -9.81}));
  double farthest = -1e300, back = 0.0;
  for (const std::int64_t block : model.block_of_body) {
    const double x = assembly.blocks[std::size_t(block)].centroid.x();
    farthest = std::max(farthest, x);
    back = std::max(back, farthest - x);
  }
  return back;
}

/// Tiles that go ahead of each other have eight slabs in a cache: slabs of three blocks' size, thinner where many stand
/// side by side, and of 1.4 whatever stands there.
TEST(OrderOfBlocks, SlabsAreThinWhereManyStandSideBySide) {
  EXPECT_NEAR(goes_back(beam(40, 4)), 2.0 * edge, 1e-9) << "16 side by side: three blocks";
  EXPECT_NEAR(goes_back(beam(31, 18)), 1.0 * edge, 1e-9) << "324: two";
  EXPECT_NEAR(goes_back(beam(31, 30)), 1.0 * edge, 1e-9) << "900: more than 640, but never thinner than 1.4 blocks";
}

}  // namespace VOUSSOIR_FILE
}  // namespace voussoir::test
